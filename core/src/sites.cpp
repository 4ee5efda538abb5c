#include "ga_symmetry/sites.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "ga_symmetry/curvature.h"
#include "ga_symmetry/errors.h"
#include "ga_symmetry/parallel.h"

namespace ga_symmetry {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Corner of `v` from which its fan of faces can be walked counter-clockwise without leaving anything behind.
int first_fan_corner(const Surface& s, int v) {
  int start = s.corner_at[s.first_corner[v]];
  for (int i = s.first_corner[v]; i < s.first_corner[v + 1]; ++i)
    if (s.opposite[previous_corner(s.corner_at[i])] < 0) start = s.corner_at[i];
  return start;
}

struct RingVertex {
  int vertex;
  Eigen::Vector2d at;  // flattened
};

// The one-ring of v in the plane: lengths kept, angles stretched to a full turn (not at the border).
std::vector<RingVertex> flattened_ring(const Surface& s, int v) {
  std::vector<RingVertex> ring;
  std::vector<double> angle;
  const int start = first_fan_corner(s, v), limit = s.first_corner[v + 1] - s.first_corner[v];
  const Eigen::Vector3d p(s.point(v));
  double turn = 0;
  bool open = false;
  int corner = start;
  for (int i = 0; i < limit; ++i) {
    const int a = s.triangle[next_corner(corner)], b = s.triangle[previous_corner(corner)];
    ring.push_back({a, Eigen::Vector2d::Zero()});
    angle.push_back(turn);
    const Eigen::Vector3d u = Eigen::Vector3d(s.point(a)) - p, w = Eigen::Vector3d(s.point(b)) - p;
    turn += std::acos(std::clamp(u.dot(w) / (u.norm() * w.norm()), -1.0, 1.0));
    const int across = s.opposite[next_corner(corner)];
    if (across < 0) {
      open = true;
      ring.push_back({b, Eigen::Vector2d::Zero()});
      angle.push_back(turn);
      break;
    }
    // The neighbour's corner at v: faces are oriented alike where the surface is orientable.
    corner = s.triangle[next_corner(across)] == v ? next_corner(across) : previous_corner(across);
    if (corner == start) break;
  }
  const double stretch = open ? 1 : 2 * kPi / turn;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const double length = s.edge_length(v, ring[i].vertex);
    ring[i].at = {length * std::cos(angle[i] * stretch), length * std::sin(angle[i] * stretch)};
  }
  return ring;
}

// Averages over geodesic discs around each site: how large they are, and how curved.
Table disc_descriptors(const Surface& s, const DistanceFields& field, int threads, std::vector<float>& centricity) {
  constexpr double kDiscs[] = {0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.4, 2.0};  // radii / unit
  constexpr double kCurvature[] = {0.12, 0.25, 0.5};
  constexpr int kFeatures = 1 + 8 + 2 * 3;
  const int count = static_cast<int>(field.rows()), n = s.vertices();
  const std::vector<double> curvature = integrated_mean_curvature(s);
  const double unit = s.unit();
  Table out(count, kFeatures);
  centricity.resize(count);
  parallel_for(count, threads, [&](int i, int) {
    double mean = 0, disc[8] = {}, weight[3] = {}, bent[3] = {}, rough[3] = {};
    for (int v = 0; v < n; ++v) {
      const double d = field(i, v) / unit, area = s.vertex_area[v];
      mean += d * area;
      for (int k = 0; k < 8; ++k) disc[k] += d < kDiscs[k] ? area : 0;
      for (int k = 0; k < 3; ++k) {
        const double t = 1 - d / kCurvature[k];
        if (t <= 0) continue;
        const double w = t * t * (1 + 2 * d / kCurvature[k]);
        weight[k] += w * area;
        bent[k] += w * curvature[v];
        rough[k] += w * std::abs(curvature[v]);
      }
    }
    centricity[i] = static_cast<float>(mean / s.area);
    int f = 0;
    out(i, f++) = centricity[i];
    for (double x : disc) out(i, f++) = static_cast<float>(std::sqrt(x / s.area));
    for (int k = 0; k < 3; ++k) {
      const double scale = weight[k] > 0 ? unit * kCurvature[k] / weight[k] : 0;
      out(i, f++) = static_cast<float>(bent[k] * scale);
      out(i, f++) = static_cast<float>(rough[k] * scale);
    }
  });
  for (int k = 0; k < kFeatures; ++k) {
    auto column = out.col(k).array();
    column -= column.mean();
    column /= std::max(1e-6f, std::sqrt(column.square().mean()));
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

std::vector<int> extremal_samples(const Sites& sites) {
  const auto is_extremum = [&](int i, float sign) {
    return std::all_of(sites.neighbors[i].begin(), sites.neighbors[i].end(),
                       [&](int j) { return sign * sites.centricity[i] >= sign * sites.centricity[j]; });
  };
  std::vector<int> tips;
  int center = 0;
  for (int i = 0; i < sites.samples; ++i) {
    if (is_extremum(i, 1)) tips.push_back(i);
    if (sites.centricity[i] < sites.centricity[center]) center = i;
  }
  std::stable_sort(tips.begin(), tips.end(), [&](int a, int b) { return sites.centricity[a] > sites.centricity[b]; });
  constexpr std::size_t kMaxTips = 14;  // more are noise of a rough surface; pairs of tips are what costs
  if (tips.size() > kMaxTips) tips.resize(kMaxTips);
  tips.push_back(center);
  return tips;
}

}  // namespace

std::pair<Table, Table> directions(const Surface& surface, const std::vector<int>& vertices,
                                   const DistanceFields& fields, int threads) {
  const int count = static_cast<int>(vertices.size()), sources = static_cast<int>(fields.rows());
  std::pair<Table, Table> out{Table::Zero(count, sources), Table::Zero(count, sources)};
  parallel_for(count, threads, [&](int i, int) {
    const int v = vertices[i];
    const std::vector<RingVertex> ring = flattened_ring(surface, v);
    // Least squares gradient, neighbours weighted by 1 / length^2.
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    for (const RingVertex& r : ring) normal += r.at * r.at.transpose() / r.at.squaredNorm();
    const Eigen::Matrix2d inverse = (normal + 1e-6 * normal.trace() * Eigen::Matrix2d::Identity()).inverse();
    for (int j = 0; j < sources; ++j) {
      if (fields(j, v) == 0) continue;
      Eigen::Vector2d right(0, 0);
      for (const RingVertex& r : ring) right += r.at * ((fields(j, r.vertex) - fields(j, v)) / r.at.squaredNorm());
      const Eigen::Vector2d towards = -(inverse * right);
      const double length = towards.norm();
      if (!(length > 0)) continue;
      out.first(i, j) = static_cast<float>(towards[0] / length);
      out.second(i, j) = static_cast<float>(towards[1] / length);
    }
  });
  return out;
}

Sites make_sites(const Surface& surface, const GeodesicSolver& solver, int samples, int sites, int neighbors,
                 int threads, const Context& context) {
  Sites s;
  const int count = std::min(sites, surface.vertices());
  s.samples = std::min(samples, count);
  Samples spaced = evenly_spaced_samples(surface, solver, count, threads, context);
  const float unit = static_cast<float>(surface.unit());
  s.distance = symmetric_distances(spaced) / unit;
  s.vertex = std::move(spaced.vertex);
  s.field = std::move(spaced.distance);
  std::tie(s.cosine, s.sine) = directions(surface, s.vertex, s.field, threads);
  s.descriptor = disc_descriptors(surface, s.field, threads, s.centricity);
  s.nearest_sample.resize(count);
  for (int k = 0; k < count; ++k) s.distance.row(k).head(s.samples).minCoeff(&s.nearest_sample[k]);
  for (int i = 0; i < s.samples; ++i) s.neighbors.push_back(nearest_samples(s, i, neighbors));
  s.extremal = extremal_samples(s);
  return s;
}

}  // namespace ga_symmetry
