// How well vertices agree by their distances to landmarks and their curvature: what all matching is made of.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "geodesics/geodesics.h"
#include "geodesics/shortcuts.h"
#include "surface/curvature.h"
#include "surface/surface.h"
#include "util/parallel.h"

namespace ga_symmetry {

// How distances weigh: 1 / (d^2 + near2)^(power/2), in units; and the curvature's mean squared difference, against
// that of the distances in units^2. Later steps trust near landmarks more, because what is left to correct is local and
// the error of a distance grows with it; and curvature less, because it leads to the right place from afar but is
// rough where distances agree.
struct Weighting {
  float near2, power, curvature;
};
constexpr Weighting kCoarse{0.02f, 2.f, 0.012f}, kFine{0.005f, 3.f, 0.003f};

// Features of the vertices as points to be matched: vertex-major, so that one comparison is one contiguous pass.
struct Features {
  int distances = 0;  // that many come first, then the curvature
  int dimension = 0;
  std::vector<float> source, target;              // n x dimension: d(v, from) against d(c, to)
  std::vector<float> source_slack, target_slack;  // how much they may differ from that; empty = not at all
  const float* of(const std::vector<float>& data, int v) const {
    return &data[static_cast<std::size_t>(v) * dimension];
  }
};

// Where there are shortcuts, distances are moved to the middle of what they may be.
inline void loosen(Features& f, const DistanceFields& fields, const Shortcuts& shortcuts, float unit, int first,
                   std::vector<float>& middle, std::vector<float>& slack) {
  slack.resize(middle.size(), 0);
  for (Eigen::Index i = 0; i < fields.rows(); ++i) {
    const auto half = shortcuts.slack(fields.row(i).data());
    for (int v = 0; v < static_cast<int>(fields.cols()); ++v) {
      const std::size_t at = static_cast<std::size_t>(v) * f.dimension + first + i;
      slack[at] = half(v) / unit;
      middle[at] -= slack[at];
    }
  }
}

inline Features make_features(const DistanceFields& from, const DistanceFields& to, const CurvatureFeatures& curvature,
                              float unit, bool both_ways, const Shortcuts* shortcuts, int threads) {
  const int landmarks = static_cast<int>(from.rows()), n = static_cast<int>(from.cols());
  Features f;
  f.distances = (both_ways ? 2 : 1) * landmarks;
  f.dimension = f.distances + kCurvatureFeatures;
  f.source.resize(static_cast<std::size_t>(n) * f.dimension);
  f.target.resize(f.source.size());
  const float scale = 1 / unit;
  constexpr int kBlock = 64;  // transposed in blocks that fit the cache
  parallel_for((n + kBlock - 1) / kBlock, threads, [&](int block, int) {
    const int begin = block * kBlock, end = std::min(n, begin + kBlock);
    for (int i = 0; i < landmarks; ++i)
      for (int v = begin; v < end; ++v) {
        float* source = &f.source[static_cast<std::size_t>(v) * f.dimension];
        float* target = &f.target[static_cast<std::size_t>(v) * f.dimension];
        const float a = from(i, v) * scale, b = to(i, v) * scale;
        source[i] = a, target[i] = b;
        if (both_ways) source[landmarks + i] = b, target[landmarks + i] = a;
      }
  });
  if (shortcuts && !shortcuts->none()) {
    loosen(f, from, *shortcuts, unit, 0, f.source, f.source_slack);
    loosen(f, to, *shortcuts, unit, 0, f.target, f.target_slack);
    if (both_ways) {
      loosen(f, to, *shortcuts, unit, landmarks, f.source, f.source_slack);
      loosen(f, from, *shortcuts, unit, landmarks, f.target, f.target_slack);
    }
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
    std::fill(weight_.begin() + features.distances, weight_.end(), weighting.curvature / kCurvatureFeatures);
  }

  /// Look for the partner of a vertex.
  void look_at(int v) {
    look_for(features_.of(features_.source, v));
    if (!features_.source_slack.empty()) slack_ = features_.of(features_.source_slack, v);
  }
  /// Look for the place with these features. @param wanted  of Features::dimension; used until the next call
  void look_for(const float* wanted) {
    source_ = wanted;
    slack_ = nullptr;
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
    const auto difference = Row(source_, d) - Row(features_.of(features_.target, c), d);
    const Row weight(weight_.data(), d);
    if (!slack_) return (difference.square() * weight).sum();
    const auto slack = Row(slack_, d) + Row(features_.of(features_.target_slack, c), d);
    return ((difference.abs() - slack).max(0.f).square() * weight).sum();
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
  const float *source_ = nullptr, *slack_ = nullptr;
  std::vector<float> weight_;
};

// The landmarks nearest to a vertex: where its search may start.
inline std::vector<int> nearest_landmarks(const DistanceFields& fields, int v) {
  std::vector<int> order(fields.rows());
  std::iota(order.begin(), order.end(), 0);
  const auto last = order.begin() + std::min<std::ptrdiff_t>(3, fields.rows());
  std::partial_sort(order.begin(), last, order.end(),
                    [&](int a, int b) { return fields(a, v) != fields(b, v) ? fields(a, v) < fields(b, v) : a < b; });
  order.erase(last, order.end());
  return order;
}

}  // namespace ga_symmetry
