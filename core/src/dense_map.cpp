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

// Features of the vertices as points to be matched: vertex-major, so that one comparison is one contiguous pass.
struct Features {
  int dimension = 0;
  std::vector<float> source, target;  // n x dimension: d(v, from) against d(c, to)
  const float* of(const std::vector<float>& data, int v) const { return &data[static_cast<std::size_t>(v) * dimension]; }
};

Features make_features(const DistanceFields& from, const DistanceFields& to, float unit, bool both_ways) {
  const int landmarks = static_cast<int>(from.rows()), n = static_cast<int>(from.cols());
  Features f;
  f.dimension = (both_ways ? 2 : 1) * landmarks;
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
  return f;
}

class Matcher {
 public:
  Matcher(const Surface& surface, const Features& features, Weighting weighting)
      : surface_(surface), features_(features), weighting_(weighting), weight_(features.dimension) {}

  void look_at(int v) {
    source_ = features_.of(features_.source, v);
    float sum = 0;
    for (int i = 0; i < features_.dimension; ++i) {
      const float x = source_[i] * source_[i] + weighting_.near2;
      sum += weight_[i] = weighting_.power == 2.f ? 1 / x : 1 / (x * std::sqrt(x));
    }
    for (float& w : weight_) w /= sum;
  }
  float error(int c) const {
    const float* target = features_.of(features_.target, c);
    float sum = 0;
    for (int i = 0; i < features_.dimension; ++i) {
      const float e = source_[i] - target[i];
      sum += e * e * weight_[i];
    }
    return sum;
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

// The nearest landmarks of each vertex: where its search may start.
std::vector<std::array<int, 3>> nearest_landmarks(const DistanceFields& fields) {
  const int n = static_cast<int>(fields.cols()), count = static_cast<int>(fields.rows());
  std::vector<std::array<int, 3>> nearest(n, {-1, -1, -1});
  std::vector<std::array<float, 3>> at(n, {INFINITY, INFINITY, INFINITY});
  for (int i = 0; i < count; ++i)
    for (int v = 0; v < n; ++v) {
      float d = fields(i, v);
      int label = i;
      for (int k = 0; k < 3; ++k)
        if (d < at[v][k]) std::swap(d, at[v][k]), std::swap(label, nearest[v][k]);
    }
  return nearest;
}

// One round of matching: every vertex starts at the partners of its nearest landmarks, then at those of its neighbours.
void match(const Surface& surface, const Features& features, Weighting weighting, const Landmarks& landmarks,
           const std::vector<std::array<int, 3>>& nearest, std::vector<int>& partner, std::vector<double>& residual,
           int threads, const Context& context) {
  const int n = surface.vertices();
  constexpr int kBlock = 256;
  std::vector<float> least(n);
  const auto for_blocks = [&](const auto& body) {
    parallel_for((n + kBlock - 1) / kBlock, threads, [&](int block, int) {
      if (context.cancelled()) throw Cancelled();
      Matcher matcher(surface, features, weighting);
      for (int v = block * kBlock; v < std::min(n, (block + 1) * kBlock); ++v) {
        matcher.look_at(v);
        body(v, matcher);
      }
    });
  };
  const bool first = partner.empty();
  partner.resize(n, -1);
  for_blocks([&](int v, Matcher& matcher) {
    float best = INFINITY;
    int at = -1;
    const auto from = [&](int start) {
      float e;
      const int c = matcher.descend(start, e);
      if (e < best) best = e, at = c;
    };
    if (!first) from(partner[v]);
    for (int i : nearest[v])
      if (i >= 0) from(landmarks.to[i]);
    partner[v] = at;
    least[v] = best;
  });
  for (int pass = 0; pass < 2; ++pass) {
    const std::vector<int> before = partner;  // so that the order of vertices and threads does not matter
    for_blocks([&](int v, Matcher& matcher) {
      for (int i = surface.first_corner[v]; i < surface.first_corner[v + 1]; ++i) {
        const int start = before[surface.triangle[next_corner(surface.corner_at[i])]];
        if (start == partner[v] || matcher.error(start) >= 4 * least[v]) continue;
        float e;
        const int c = matcher.descend(start, e);
        if (e < least[v]) least[v] = e, partner[v] = c;
      }
    });
  }
  residual.assign(least.begin(), least.end());
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
    if (determinant > 1e-12 * aa * bb)
      consider((ra * bb - rb * ab) / determinant, (rb * aa - ra * ab) / determinant);
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

}  // namespace

DenseMap make_dense_map(const Surface& surface, const GeodesicSolver& solver, const Landmarks& landmarks,
                        const DistanceFields& fields, int fixed, const DenseOptions& options, int threads,
                        const Context& context) {
  DenseMap map;
  map.landmarks = landmarks;
  const float unit = static_cast<float>(surface.unit());
  const std::vector<std::array<int, 3>> nearest = nearest_landmarks(fields);
  const int free_landmarks = static_cast<int>(landmarks.from.size()) - fixed;
  for (int round = 0; round < options.rounds; ++round) {
    DistanceFields to = solver.fields(map.landmarks.to, threads, context);
    const Features features = make_features(fields, to, unit, options.both_ways);
    const Weighting weighting = round + 2 < options.rounds ? kCoarse : kFine;
    match(surface, features, weighting, map.landmarks, nearest, map.partner, map.residual, threads, context);
    if (round + 1 < options.rounds) {
      for (int i = 0; i < free_landmarks; ++i) map.landmarks.to[i] = map.partner[map.landmarks.from[i]];
      continue;
    }
    map.to_field = std::move(to);
    map.point.resize(surface.vertices());
    constexpr int kBlock = 256;
    const int n = surface.vertices();
    parallel_for((n + kBlock - 1) / kBlock, threads, [&](int block, int) {
      Matcher matcher(surface, features, weighting);
      for (int v = block * kBlock; v < std::min(n, (block + 1) * kBlock); ++v) {
        matcher.look_at(v);
        map.point[v] = on_face(surface, features, matcher, map.partner[v]);
      }
    });
  }
  return map;
}

}  // namespace ga_symmetry
