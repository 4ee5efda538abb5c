// SPDX-License-Identifier: GPL-3.0-or-later
// Vertices as points to be matched: their distances to the landmarks, and their curvature.
#pragma once
#include <vector>

#include "matching/matching.h"

namespace ga_symmetry {

/// Vertex-major, so that one comparison is one contiguous pass. A vertex's partner is the vertex whose target features
/// are most like its source features.
struct Features {
  int distances = 0;  ///< that many come first, in units; then the curvature
  int dimension = 0;
  std::vector<float> trust;           ///< per distance: how much its landmark's image may be relied on, (0, 1]
  std::vector<float> source, target;  ///< vertices x dimension: d(v, landmarks) against d(c, images)
  std::vector<float> source_slack, target_slack;  ///< how much they may differ from that; empty = not at all
  const float* of(const std::vector<float>& data, int v) const {
    return &data[static_cast<std::size_t>(v) * dimension];
  }
};

/// For a reflection, which takes images to landmarks, too, both distances count in both directions.
/// Where there are shortcuts, distances are in the middle of what they may be.
Features make_features(const Matching& matching, const Images& images, int threads);
/// The same as if nothing of the surface were missing: among places near to each other all distances to a landmark have
/// nearly the same detour, and slack would only blur which is best.
Features make_tight_features(const Matching& matching, const Images& images, int threads);

}  // namespace ga_symmetry
