// SPDX-License-Identifier: GPL-3.0-or-later
#include "search/sites.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "ga_symmetry/errors.h"
#include "surface/curvature.h"
#include "util/parallel.h"

namespace ga_symmetry {
namespace {

// What tells sites apart: the average distance, and of geodesic discs around each how large they are and how curved.
Table disc_descriptors(const Surface& s, const DistanceFields& field, int threads,
                       std::vector<float>& average_distance) {
  // Radii in units, each about half as large again: from the spacing of samples to most of the surface. Curvature says
  // more of near places, where the weight falls smoothly to 0 at the radius, so that no feature depends on one vertex.
  constexpr double kDiscs[] = {0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.4, 2.0};
  constexpr double kCurvature[] = {0.12, 0.25, 0.5};
  constexpr int kSizes = std::size(kDiscs), kCurvatures = std::size(kCurvature);
  constexpr int kFeatures = 1 + kSizes + 2 * kCurvatures;
  const int count = static_cast<int>(field.rows()), n = s.vertices();
  const std::vector<double> curvature = integrated_mean_curvature(s);
  const double unit = s.unit();
  Table out(count, kFeatures);
  average_distance.resize(count);
  parallel_for(count, threads, [&](int i, int) {
    double mean = 0, disc[kSizes] = {}, weight[kCurvatures] = {}, bent[kCurvatures] = {}, rough[kCurvatures] = {};
    for (int v = 0; v < n; ++v) {
      const double d = field(i, v) / unit, area = s.vertex_area[v];
      mean += d * area;
      for (int k = 0; k < kSizes; ++k) disc[k] += d < kDiscs[k] ? area : 0;
      for (int k = 0; k < kCurvatures; ++k) {
        const double t = 1 - d / kCurvature[k];
        if (t <= 0) continue;
        const double w = t * t * (1 + 2 * d / kCurvature[k]);
        weight[k] += w * area;
        bent[k] += w * curvature[v];
        rough[k] += w * std::abs(curvature[v]);
      }
    }
    average_distance[i] = static_cast<float>(mean / s.area);
    int f = 0;
    out(i, f++) = average_distance[i];
    for (double x : disc) out(i, f++) = static_cast<float>(std::sqrt(x / s.area));
    for (int k = 0; k < kCurvatures; ++k) {
      const double scale = weight[k] > 0 ? unit * kCurvature[k] / weight[k] : 0;
      out(i, f++) = static_cast<float>(bent[k] * scale);
      out(i, f++) = static_cast<float>(rough[k] * scale);
    }
  });
  for (int k = 0; k < kFeatures; ++k) {
    auto column = out.col(k).array();
    column -= column.mean();
    column /= std::max(1e-6f, std::sqrt(column.square().mean()));  // a sphere's features are all the same
  }
  return out;
}

std::vector<int> nearest_samples(const Sites& sites, int sample, int count) {
  std::vector<int> order(sites.samples);
  std::iota(order.begin(), order.end(), 0);
  order.erase(order.begin() + sample);
  count = std::min<int>(count, static_cast<int>(order.size()));
  std::partial_sort(order.begin(), order.begin() + count, order.end(), [&](int a, int b) {
    const float da = sites.distance(sample, a), db = sites.distance(sample, b);
    return da != db ? da < db : a < b;
  });
  order.resize(count);
  return order;
}

// What follows from the distances.
void relate(Sites& s, int neighbors) {
  s.nearest_sample.resize(s.count());
  for (int k = 0; k < s.count(); ++k) s.distance.row(k).head(s.samples).minCoeff(&s.nearest_sample[k]);
  for (int i = 0; i < s.samples; ++i) s.neighbors.push_back(nearest_samples(s, i, neighbors));
  s.observers.resize(s.samples);
  for (int i = 0; i < s.samples; ++i)
    for (int j : s.neighbors[i]) s.observers[j].push_back(i);
  s.near.resize(s.count());
  for (int k = 0; k < s.count(); ++k) {
    const auto distance = s.distance.row(k);
    for (int j = 0; j < s.count(); ++j)
      if (distance[j] <= kNearRadius) s.near[k].push_back(j);
    std::stable_sort(s.near[k].begin(), s.near[k].end(), [&](int a, int b) { return distance[a] < distance[b]; });
  }
}

std::vector<int> extremal_samples(const Sites& sites) {
  const auto is_extremum = [&](int i, float sign) {
    return std::all_of(sites.neighbors[i].begin(), sites.neighbors[i].end(),
                       [&](int j) { return sign * sites.average_distance[i] >= sign * sites.average_distance[j]; });
  };
  std::vector<int> tips;
  int center = 0;
  for (int i = 0; i < sites.samples; ++i) {
    if (is_extremum(i, 1)) tips.push_back(i);
    if (sites.average_distance[i] < sites.average_distance[center]) center = i;
  }
  std::stable_sort(tips.begin(), tips.end(),
                   [&](int a, int b) { return sites.average_distance[a] > sites.average_distance[b]; });
  constexpr std::size_t kMaxTips = 14;  // more are noise of a rough surface; pairs of tips are what costs
  if (tips.size() > kMaxTips) tips.resize(kMaxTips);
  tips.push_back(center);
  return tips;
}

Table slacks(const Landmarks& spaced, const Shortcuts& shortcuts) {
  const int count = static_cast<int>(spaced.vertex.size());
  Table out(count, count);
  for (int i = 0; i < count; ++i) {
    const auto slack = shortcuts.slack(spaced.field.row(i).data());
    for (int j = 0; j < count; ++j) out(i, j) = slack(spaced.vertex[j]);
  }
  return (out + out.transpose()) / 2;
}

}  // namespace

Sites make_sites(const Surface& surface, const GeodesicSolver& solver, const SiteCounts& counts, int threads,
                 const Shortcuts& shortcuts, const Context& context) {
  Sites s;
  const int count = std::min(counts.sites, surface.vertices());
  s.samples = std::min(counts.samples, count);
  Landmarks spaced = evenly_spaced_samples(surface, solver, count, threads, context);
  const float unit = static_cast<float>(surface.unit());
  s.distance = symmetric_distances(spaced) / unit;
  if (!shortcuts.none()) {
    s.slack = slacks(spaced, shortcuts) / unit;
    s.distance -= s.slack;
  }
  s.vertex = std::move(spaced.vertex);
  s.field = std::move(spaced.field);
  std::tie(s.cosine, s.sine) = directions(surface, s.vertex, s.field, threads);
  s.descriptor = disc_descriptors(surface, s.field, threads, s.average_distance);
  s.nearest = nearest_source(s.field);
  relate(s, counts.neighbors);
  s.extremal = extremal_samples(s);
  return s;
}

Sites coarsened(const Sites& fine, int samples, int sites) {
  const int count = std::min(sites, fine.count());
  Sites s;
  s.samples = std::min({samples, fine.samples, count});
  s.vertex.assign(fine.vertex.begin(), fine.vertex.begin() + count);
  s.distance = fine.distance.topLeftCorner(count, count);
  if (fine.slack.size() > 0) s.slack = fine.slack.topLeftCorner(count, count);
  s.cosine = fine.cosine.topLeftCorner(count, count);
  s.sine = fine.sine.topLeftCorner(count, count);
  relate(s, static_cast<int>(fine.neighbors[0].size()));
  return s;
}

}  // namespace ga_symmetry
