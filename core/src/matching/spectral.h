// SPDX-License-Identifier: GPL-3.0-or-later
// Spectral refinement: what distances to landmarks cannot tell, the smooth functions on the surface can.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/result.h"
#include "matching/matching.h"

namespace ga_symmetry {

/// A partner for every vertex, and where it is on a face.
struct SurfaceMap {
  std::vector<int> partner;
  std::vector<SurfacePoint> point;
};

constexpr int kFewFunctions = 40, kAllFunctions = 160;

/// Spectral upsampling (ZoomOut, Melzi et al. 2019), from many functions to more: the map is written as a matrix of the
/// eigenfunctions, made smooth by that, and read again as the places where they agree best; by descent over edges from
/// where it was, so that nothing jumps to elsewhere. A reflection is its own inverse, its matrix symmetric.
class SpectralRefinement {
 public:
  /// Computes the eigenfunctions of the surface, which maps may share. @throws Cancelled
  explicit SpectralRefinement(const Surface& surface, int threads, const Context& context = {});

  /// @param matching  of the same surface
  /// @param from      so many functions at first, then more: kFewFunctions for a map that is rough, kAllFunctions for
  ///                  one that has been refined, where fewer would undo what distances have corrected since
  /// @return          the map as it is where the surface has too few vertices
  /// @throws Cancelled
  SurfaceMap refine(const Matching& matching, SurfaceMap map, int from, int threads, const Context& context = {}) const;

 private:
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Rows functions_;  // vertices x functions, the lowest first
};

}  // namespace ga_symmetry
