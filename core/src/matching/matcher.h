// SPDX-License-Identifier: GPL-3.0-or-later
// How well vertices agree by their distances to landmarks and their curvature: what all matching is made of.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "matching/features.h"
#include "surface/neighbors.h"

namespace ga_symmetry {

// How distances weigh: 1 / (d^2 + near2)^(power/2), in units; and the curvature's mean squared difference, against
// that of the distances in units^2. Later steps trust near landmarks more, because what is left to correct is local and
// the error of a distance grows with it; and curvature less, because it leads to the right place from afar but is
// rough where distances agree.
struct Weighting {
  float near2, power, curvature;
};
constexpr Weighting kCoarse{0.02f, 2.f, 0.012f}, kFine{0.005f, 3.f, 0.003f};

// Looks for the vertex that matches best.
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
      sum += weight_[i] = features_.trust[i] * (weighting_.power == 2.f ? 1 / x : 1 / (x * std::sqrt(x)));
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
      for_each_neighbor(surface_, c, [&](int w) {
        const float e = error(w);
        if (e < least || (e == least && w < c)) least = e, c = w, moved = true;
      });
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
