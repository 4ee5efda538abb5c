// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/features.h"

#include <algorithm>
#include <cmath>

#include "util/parallel.h"

namespace ga_symmetry {
namespace {

// Moves distances to the middle of what they may be.
void loosen(Features& f, const DistanceFields& fields, const Shortcuts& shortcuts, float unit, int first,
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

// How much each landmark may be relied on, by how far off its distances to the others are: one whose counterpart is
// missing goes anywhere, and draws its neighbours along. The median, so that the rest is not blamed.
std::vector<float> trust_of(const Matching& m, const Images& images) {
  // From there on it counts half or less. Smaller ones took what poses change for it: whole meshes were matched worse.
  constexpr float kOff = 0.1f;    // units
  constexpr float kOrdinary = 4;  // times the median of all
  const int count = m.count();
  const auto median = [](std::vector<float> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  };
  std::vector<float> off(count), differences(count);
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j)
      differences[j] =
          std::abs(m.landmarks.field(j, m.landmarks.vertex[i]) - images.field(j, images.vertex[i])) / m.unit();
    off[i] = median(differences);
  }
  if (count == 0) return off;
  const float scale = std::max(kOff, kOrdinary * median(off));
  for (int i = 0; i < count; ++i) {
    const float x = off[i] / scale, plus = 1 + x * x;
    off[i] = i < m.movable() ? 1 / (plus * plus) : 1;  // references are the user's word
  }
  return off;
}

}  // namespace

Features make_tight_features(const Matching& m, const Images& images, int threads) {
  const DistanceFields &from = m.landmarks.field, &to = images.field;
  const int landmarks = m.count(), n = m.surface.vertices();
  Features f;
  f.distances = (m.reflection ? 2 : 1) * landmarks;
  f.dimension = f.distances + kCurvatureFeatures;
  f.source.resize(static_cast<std::size_t>(n) * f.dimension);
  f.target.resize(f.source.size());
  f.trust = trust_of(m, images);
  if (m.reflection) f.trust.insert(f.trust.end(), f.trust.begin(), f.trust.end());
  const float scale = 1 / m.unit();
  constexpr int kBlock = 64;  // transposed in blocks that fit the cache
  parallel_blocks(n, kBlock, threads, [&](int begin, int end, int) {
    for (int i = 0; i < landmarks; ++i)
      for (int v = begin; v < end; ++v) {
        float* source = &f.source[static_cast<std::size_t>(v) * f.dimension];
        float* target = &f.target[static_cast<std::size_t>(v) * f.dimension];
        const float a = from(i, v) * scale, b = to(i, v) * scale;
        source[i] = a, target[i] = b;
        if (m.reflection) source[landmarks + i] = b, target[landmarks + i] = a;
      }
  });
  for (int v = 0; v < n; ++v)
    for (int k = 0; k < kCurvatureFeatures; ++k) {
      const std::size_t at = static_cast<std::size_t>(v) * f.dimension + f.distances + k;
      f.source[at] = f.target[at] = m.curvature(v, k);
    }
  return f;
}

Features make_features(const Matching& m, const Images& images, int threads) {
  Features f = make_tight_features(m, images, threads);
  if (m.shortcuts.none()) return f;
  loosen(f, m.landmarks.field, m.shortcuts, m.unit(), 0, f.source, f.source_slack);
  loosen(f, images.field, m.shortcuts, m.unit(), 0, f.target, f.target_slack);
  if (m.reflection) {
    loosen(f, images.field, m.shortcuts, m.unit(), m.count(), f.source, f.source_slack);
    loosen(f, m.landmarks.field, m.shortcuts, m.unit(), m.count(), f.target, f.target_slack);
  }
  return f;
}

}  // namespace ga_symmetry
