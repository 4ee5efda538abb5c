#include "ga_symmetry/dense_map.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "ga_symmetry/errors.h"
#include "ga_symmetry/parallel.h"
#include "ga_symmetry/sites.h"

namespace ga_symmetry {
namespace {

// How distances weigh: 1 / (d^2 + near2)^(power/2), in units. Later rounds trust near landmarks more, because what is
// left to correct is local, and the error of a distance grows with it.
struct Weighting {
  float near2, power;
};
constexpr Weighting kCoarse{0.02f, 2.f}, kFine{0.005f, 3.f};
// Of the curvature's mean squared difference, against that of the distances in units^2.
constexpr float kCurvatureWeight = 0.012f;

// Features of the vertices as points to be matched: vertex-major, so that one comparison is one contiguous pass.
struct Features {
  int distances = 0;  // that many come first, then the curvature
  int dimension = 0;
  std::vector<float> source, target;  // n x dimension: d(v, from) against d(c, to)
  const float* of(const std::vector<float>& data, int v) const {
    return &data[static_cast<std::size_t>(v) * dimension];
  }
};

Features make_features(const DistanceFields& from, const DistanceFields& to, const CurvatureFeatures& curvature,
                       float unit, bool both_ways) {
  const int landmarks = static_cast<int>(from.rows()), n = static_cast<int>(from.cols());
  Features f;
  f.distances = (both_ways ? 2 : 1) * landmarks;
  f.dimension = f.distances + kCurvatureFeatures;
  f.source.resize(static_cast<std::size_t>(n) * f.dimension);
  f.target.resize(f.source.size());
  const float scale = 1 / unit;
  constexpr int kBlock = 64;  // transposed in blocks that fit the cache
  for (int v0 = 0; v0 < n; v0 += kBlock)
    for (int i = 0; i < landmarks; ++i)
      for (int v = v0; v < std::min(n, v0 + kBlock); ++v) {
        float* source = &f.source[static_cast<std::size_t>(v) * f.dimension];
        float* target = &f.target[static_cast<std::size_t>(v) * f.dimension];
        const float a = from(i, v) * scale, b = to(i, v) * scale;
        source[i] = a, target[i] = b;
        if (both_ways) source[landmarks + i] = b, target[landmarks + i] = a;
      }
  for (int v = 0; v < n; ++v)
    for (int k = 0; k < kCurvatureFeatures; ++k) {
      const std::size_t at = static_cast<std::size_t>(v) * f.dimension + f.distances + k;
      f.source[at] = f.target[at] = curvature(v, k);
    }
  return f;
}

class Matcher {
 public:
  Matcher(const Surface& surface, const Features& features, Weighting weighting)
      : surface_(surface), features_(features), weighting_(weighting), weight_(features.dimension) {
    std::fill(weight_.begin() + features.distances, weight_.end(), kCurvatureWeight / kCurvatureFeatures);
  }

  void look_at(int v) {
    source_ = features_.of(features_.source, v);
    float sum = 0;
    for (int i = 0; i < features_.distances; ++i) {
      const float x = source_[i] * source_[i] + weighting_.near2;
      sum += weight_[i] = weighting_.power == 2.f ? 1 / x : 1 / (x * std::sqrt(x));
    }
    for (int i = 0; i < features_.distances; ++i) weight_[i] /= sum;
  }
  float error(int c) const {
    using Row = Eigen::Map<const Eigen::ArrayXf>;
    const int d = features_.dimension;
    return ((Row(source_, d) - Row(features_.of(features_.target, c), d)).square() * Row(weight_.data(), d)).sum();
  }
  /// Walks downhill over edges. @return the local minimum
  int descend(int c, float& least) {
    least = error(c);
    for (bool moved = true; moved;) {
      moved = false;
      const int center = c;
      for (int i = surface_.first_corner[center]; i < surface_.first_corner[center + 1]; ++i)
        for (int w : {surface_.triangle[next_corner(surface_.corner_at[i])],
                      surface_.triangle[previous_corner(surface_.corner_at[i])]}) {
          if (w == c) continue;
          const float e = error(w);
          if (e < least || (e == least && w < c)) least = e, c = w, moved = true;
        }
    }
    return c;
  }
  const std::vector<float>& weight() const { return weight_; }
  const float* source() const { return source_; }

 private:
  const Surface& surface_;
  const Features& features_;
  const Weighting weighting_;
  const float* source_ = nullptr;
  std::vector<float> weight_;
};

template <class Body>
void for_each_vertex(const Surface& surface, const Features& features, Weighting weighting, int threads,
                     const Context& context, const Body& body) {
  constexpr int kBlock = 256;
  const int n = surface.vertices();
  parallel_for((n + kBlock - 1) / kBlock, threads, [&](int block, int) {
    if (context.cancelled()) throw Cancelled();
    Matcher matcher(surface, features, weighting);
    for (int v = block * kBlock; v < std::min(n, (block + 1) * kBlock); ++v) {
      matcher.look_at(v);
      body(v, matcher);
    }
  });
}

// The landmarks nearest to a vertex: where its search may start.
std::vector<int> nearest_landmarks(const DistanceFields& fields, int v) {
  std::vector<int> order(fields.rows());
  std::iota(order.begin(), order.end(), 0);
  const auto last = order.begin() + std::min<std::ptrdiff_t>(3, fields.rows());
  std::partial_sort(order.begin(), last, order.end(),
                    [&](int a, int b) { return fields(a, v) != fields(b, v) ? fields(a, v) < fields(b, v) : a < b; });
  order.erase(last, order.end());
  return order;
}

// Every vertex starts at the images of its nearest landmarks, then at the partners of its neighbours.
void match(const Surface& surface, const Features& features, const Landmarks& landmarks, const DistanceFields& fields,
           DenseMap& map, int threads, const Context& context) {
  const int n = surface.vertices();
  map.partner.assign(n, -1);
  map.residual.assign(n, INFINITY);
  const auto try_from = [&](Matcher& matcher, int v, int start) {
    float e;
    const int c = matcher.descend(start, e);
    if (e < map.residual[v]) map.residual[v] = e, map.partner[v] = c;
  };
  for_each_vertex(surface, features, kFine, threads, context, [&](int v, Matcher& matcher) {
    for (int i : nearest_landmarks(fields, v)) try_from(matcher, v, landmarks.to[i]);
  });
  for (int pass = 0; pass < 2; ++pass) {
    const std::vector<int> before = map.partner;  // so that the order of vertices and threads does not matter
    for_each_vertex(surface, features, kFine, threads, context, [&](int v, Matcher& matcher) {
      for (int i = surface.first_corner[v]; i < surface.first_corner[v + 1]; ++i) {
        const int start = before[surface.triangle[next_corner(surface.corner_at[i])]];
        if (start != map.partner[v] && matcher.error(start) < 4 * map.residual[v]) try_from(matcher, v, start);
      }
    });
  }
}

// The point on the faces around `c` whose interpolated features match best.
SurfacePoint on_face(const Surface& surface, const Features& features, const Matcher& matcher, int c) {
  SurfacePoint best{{c, c, c}, {1, 0, 0}};
  const int dimension = features.dimension;
  const float* origin = features.of(features.target, c);
  double least = matcher.error(c);
  for (int i = surface.first_corner[c]; i < surface.first_corner[c + 1]; ++i) {
    const int a = surface.triangle[next_corner(surface.corner_at[i])];
    const int b = surface.triangle[previous_corner(surface.corner_at[i])];
    const float *fa = features.of(features.target, a), *fb = features.of(features.target, b);
    double aa = 0, ab = 0, bb = 0, ra = 0, rb = 0, rr = 0;
    for (int k = 0; k < dimension; ++k) {
      const double w = matcher.weight()[k], r = matcher.source()[k] - origin[k], x = fa[k] - origin[k],
                   y = fb[k] - origin[k];
      aa += w * x * x, ab += w * x * y, bb += w * y * y, ra += w * r * x, rb += w * r * y, rr += w * r * r;
    }
    const auto consider = [&](double s, double t) {
      if (s < 0 || t < 0 || s + t > 1) return;
      const double e = rr - 2 * (s * ra + t * rb) + s * s * aa + 2 * s * t * ab + t * t * bb;
      if (e < least) least = e, best = {{c, a, b}, {1 - s - t, s, t}};
    };
    const double determinant = aa * bb - ab * ab;
    if (determinant > 1e-12 * aa * bb) consider((ra * bb - rb * ab) / determinant, (rb * aa - ra * ab) / determinant);
    if (aa > 0) consider(std::clamp(ra / aa, 0.0, 1.0), 0);
    if (bb > 0) consider(0, std::clamp(rb / bb, 0.0, 1.0));
    const double along = aa - 2 * ab + bb;  // on the edge a-b: origin moved to a
    if (along > 0) {
      const double t = std::clamp(((rb - ra) - (ab - aa)) / along, 0.0, 1.0);
      consider(1 - t, t);
    }
  }
  return best;
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

RefinedLandmarks refine_landmarks(const Surface& surface, const GeodesicSolver& solver, RefinedLandmarks start,
                                  const DistanceFields& fields, const CurvatureFeatures& curvature,
                                  const RefineOptions& options, int threads, const Context& context) {
  RefinedLandmarks out = std::move(start);
  const float unit = static_cast<float>(surface.unit());
  std::vector<int>& to = out.landmarks.to;
  const int movable = static_cast<int>(to.size()) - options.fixed;
  for (int round = 0; round < options.rounds; ++round) {
    const Features features = make_features(fields, out.to_field, curvature, unit, options.reflection);
    Matcher matcher(surface, features, options.fine ? kFine : kCoarse);
    std::vector<int> moved, sources;
    for (int i = 0; i < movable; ++i) {
      matcher.look_at(out.landmarks.from[i]);
      float e;
      const int better = matcher.descend(to[i], e);
      if (better == to[i]) continue;
      to[i] = better;
      moved.push_back(i);
      sources.push_back(better);
    }
    if (moved.empty()) break;
    const DistanceFields field = solver.fields(sources, threads, context);
    for (std::size_t k = 0; k < moved.size(); ++k) out.to_field.row(moved[k]) = field.row(static_cast<int>(k));
  }
  return out;
}

Probes match_probes(const Surface& surface, const RefinedLandmarks& refined, const DistanceFields& fields,
                    const CurvatureFeatures& curvature, const std::vector<int>& vertices, bool reflection) {
  const Features features =
      make_features(fields, refined.to_field, curvature, static_cast<float>(surface.unit()), reflection);
  Matcher matcher(surface, features, kFine);
  Probes out;
  for (int v : vertices) {
    matcher.look_at(v);
    float least = INFINITY;
    int partner = v;
    for (int i : nearest_landmarks(fields, v)) {
      float error;
      const int c = matcher.descend(refined.landmarks.to[i], error);
      if (error < least) least = error, partner = c;
    }
    out.partner.push_back(partner);
    out.error.push_back(least);
  }
  return out;
}

DenseMap make_dense_map(const Surface& surface, const RefinedLandmarks& refined, const DistanceFields& fields,
                        const CurvatureFeatures& curvature, bool reflection, int threads, const Context& context) {
  DenseMap map;
  const Features features =
      make_features(fields, refined.to_field, curvature, static_cast<float>(surface.unit()), reflection);
  match(surface, features, refined.landmarks, fields, map, threads, context);
  map.point.resize(surface.vertices());
  map.uncertainty.resize(surface.vertices());
  for_each_vertex(surface, features, kFine, threads, context, [&](int v, Matcher& matcher) {
    map.point[v] = on_face(surface, features, matcher, map.partner[v]);
    map.uncertainty[v] =
        static_cast<float>(position_uncertainty(surface, features, matcher, map.partner[v], map.residual[v]));
  });
  return map;
}

}  // namespace ga_symmetry
