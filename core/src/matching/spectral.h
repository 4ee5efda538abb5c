// SPDX-License-Identifier: GPL-3.0-or-later
// Spectral refinement: what distances to landmarks cannot tell, the smooth functions on the surface can.
#pragma once
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

/// Spectral upsampling (ZoomOut, Melzi et al. 2019), from many functions to more: the map is written as a matrix of the
/// eigenfunctions, made smooth by that, and read again as the places where they agree best; by descent over edges from
/// where it was, so that nothing jumps to elsewhere. A reflection is its own inverse, its matrix symmetric.
/// @throws Cancelled
SurfaceMap spectral_refinement(const Matching& matching, SurfaceMap map, int threads, const Context& context = {});

}  // namespace ga_symmetry
