// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/dense_map.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "ga_symmetry/errors.h"
#include "matching/face_point.h"
#include "matching/matcher.h"
#include "matching/registration.h"
#include "matching/spectral.h"
#include "matching/turned_parts.h"
#include "surface/neighbors.h"
#include "util/parallel.h"

namespace ga_symmetry {
namespace {

template <class Body>
void for_each_vertex(const Surface& surface, const Features& features, Weighting weighting, int threads,
                     const Context& context, const Body& body) {
  constexpr int kBlock = 256;
  const int n = surface.vertices();
  parallel_blocks(n, kBlock, threads, [&](int begin, int end, int worker) {
    if (worker == 0) context.advance(static_cast<double>(begin) / n);  // the calling thread
    if (context.cancelled()) throw Cancelled();
    Matcher matcher(surface, features, weighting);
    for (int v = begin; v < end; ++v) {
      matcher.look_at(v);
      body(v, matcher);
    }
  });
}

// Every vertex starts at its partner if it has one, else at the images of its nearest landmarks, then at the partners
// of its neighbours.
void match(const Matching& m, const Images& images, const Features& features, DenseMap& map, int threads,
           const Context& context) {
  const Surface& surface = m.surface;
  const int n = surface.vertices();
  const std::vector<int> start = std::move(map.partner);
  map.partner.assign(n, -1);
  map.residual.assign(n, INFINITY);
  const auto try_from = [&](Matcher& matcher, int v, int from) {
    float e;
    const int c = matcher.descend(from, e);
    if (e < map.residual[v]) map.residual[v] = e, map.partner[v] = c;
  };
  for_each_vertex(surface, features, kFine, threads, context.part(0, 0.6), [&](int v, Matcher& matcher) {
    if (start.empty())
      for (int i : nearest_landmarks(m.landmarks.field, v)) try_from(matcher, v, images.vertex[i]);
    else
      try_from(matcher, v, start[v]);
  });
  for (int pass = 0; pass < 2; ++pass) {
    const std::vector<int> before = map.partner;  // so that the order of vertices and threads does not matter
    const Context part = context.part(0.6 + 0.2 * pass, 0.8 + 0.2 * pass);
    for_each_vertex(surface, features, kFine, threads, part, [&](int v, Matcher& matcher) {
      for_each_neighbor(surface, v, [&](int w) {
        const int from = before[w];
        if (from != map.partner[v] && matcher.error(from) < 4 * map.residual[v]) try_from(matcher, v, from);
      });
    });
  }
}

// How far off the features are at the partners, smoothed over the surface: n x dimension.
std::vector<float> smooth_differences(const Surface& surface, const Features& features, const std::vector<int>& partner,
                                      int threads, const Context& context) {
  constexpr int kRounds = 5;
  const int n = surface.vertices(), dimension = features.dimension;
  std::vector<float> now(static_cast<std::size_t>(n) * dimension), next(now.size());
  const auto row = [&](std::vector<float>& data, int v) {
    return Eigen::Map<Eigen::ArrayXf>(&data[static_cast<std::size_t>(v) * dimension], dimension);
  };
  using Row = Eigen::Map<const Eigen::ArrayXf>;
  for (int v = 0; v < n; ++v)
    row(now, v) =
        Row(features.of(features.target, partner[v]), dimension) - Row(features.of(features.source, v), dimension);
  constexpr int kBlock = 256;
  for (int round = 0; round < kRounds; ++round) {
    parallel_blocks(n, kBlock, threads, [&](int begin, int end, int) {
      if (context.cancelled()) throw Cancelled();
      for (int v = begin; v < end; ++v) {
        auto mean = row(next, v);
        mean = row(now, v);
        int count = 1;
        for_each_neighbor(surface, v, [&](int w) { mean += row(now, w), ++count; });
        mean /= static_cast<float>(count);
      }
    });
    now.swap(next);
  }
  return now;
}

// How far the best point may be off, by the residual: Gauss-Newton's estimate of the position's deviation, from the
// change of the features over the face.
double position_uncertainty(const Surface& surface, const Features& features, const Matcher& matcher, int c,
                            double residual) {
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  const float* origin = features.of(features.target, c);
  const int first = surface.first_corner[c], last = surface.first_corner[c + 1];
  for (int i = first; i < last; ++i) {
    const int a = surface.triangle[next_corner(surface.corner_at[i])];
    const int b = surface.triangle[previous_corner(surface.corner_at[i])];
    const double la = surface.edge_length(c, a) / surface.unit(), lb = surface.edge_length(c, b) / surface.unit();
    const double lab = surface.edge_length(a, b) / surface.unit();
    const double x = (la * la + lb * lb - lab * lab) / (2 * la),
                 y = std::sqrt(std::max(1e-12 * la * la, lb * lb - x * x));
    const float *fa = features.of(features.target, a), *fb = features.of(features.target, b);
    double gxx = 0, gxy = 0, gyy = 0;  // frames of different faces differ; only the trace and determinant matter below
    for (int k = 0; k < features.dimension; ++k) {
      const double w = matcher.weight()[k], dx = (fa[k] - origin[k]) / la, dy = ((fb[k] - origin[k]) - dx * x) / y;
      gxx += w * dx * dx, gxy += w * dx * dy, gyy += w * dy * dy;
    }
    const double half = (gxx + gyy) / 2, apart = std::sqrt((gxx - gyy) * (gxx - gyy) / 4 + gxy * gxy);
    information(0, 0) += (half + apart) / (last - first);
    information(1, 1) += std::max(0.0, half - apart) / (last - first);
  }
  return std::sqrt(residual * (1 / std::max(1e-3, information(0, 0)) + 1 / std::max(1e-3, information(1, 1))));
}

}  // namespace

DenseMap make_dense_map(const Matching& m, const Images& images, const DenseMapOptions& options, int threads,
                        const Context& context) {
  DenseMap map;
  const Features features = make_tight_features(m, images, threads);
  match(m, images, features, map, threads, context.part(0, 0.3));
  std::vector<float> wanted;  // per vertex: the features of its partner
  if (options.noise_filter) {
    wanted = smooth_differences(m.surface, features, map.partner, threads, context);
    for (std::size_t k = 0; k < wanted.size(); ++k) wanted[k] += features.source[k];
  }
  SurfaceMap refined;
  refined.point.resize(m.surface.vertices());
  for_each_vertex(m.surface, features, kFine, threads, context.part(0.35, 0.4), [&](int v, Matcher& matcher) {
    if (options.noise_filter) {
      float error;
      matcher.look_for(features.of(wanted, v));
      map.partner[v] = matcher.descend(map.partner[v], error);
    }
    refined.point[v] = nearest_on_faces(
        m.surface, [&](int c) { return features.of(features.target, c); }, features.dimension, matcher.weight().data(),
        matcher.source(), map.partner[v]);
  });
  map.by_distances = refined.partner = std::move(map.partner);
  if (options.spectral_refinement) {
    const SpectralRefinement spectral(m.surface, threads, context);
    refined = spectral.refine(m, std::move(refined), kFewFunctions, threads, context.part(0.5, 0.7));
    if (options.local_refinement) {
      refined = register_discs(m, std::move(refined), threads, context.part(0.7, 0.8));
      if (turn_parts_back(m, refined, threads, context))
        refined = register_discs(m, std::move(refined), threads, context.part(0.8, 0.85));
      refined = spectral.refine(m, std::move(refined), kAllFunctions, threads, context.part(0.85, 0.95));
    }
  } else if (options.local_refinement) {
    refined = register_discs(m, std::move(refined), threads, context.part(0.4, 0.95));
  }
  map.partner = std::move(refined.partner), map.point = std::move(refined.point);
  map.uncertainty.resize(m.surface.vertices());
  for_each_vertex(m.surface, features, kFine, threads, context.part(0.95, 1), [&](int v, Matcher& matcher) {
    map.residual[v] = matcher.error(map.partner[v]);
    map.uncertainty[v] =
        static_cast<float>(position_uncertainty(m.surface, features, matcher, map.partner[v], map.residual[v]));
  });
  return map;
}

}  // namespace ga_symmetry
