// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid registration of discs: whatever the pose, a hand, a nose, a piece of a back keep their shape, and fit where
// their counterpart is.
#pragma once
#include "ga_symmetry/context.h"
#include "matching/matching.h"
#include "matching/spectral.h"

namespace ga_symmetry {

/// Moves partners to where the shape around them fits. The geodesic disc around each landmark is laid where the map
/// takes it by the best rigid motion, which is then fitted to the surface there by iterative closest points, from point
/// to plane (Chen & Medioni 1992); where the shape does not tell, round a limb or along it, the map does. A vertex
/// goes where the motions of the discs that it lies in take it, those that fit well first.
/// @param map  near the truth: what is farther off than some 0.05 units is not found
/// @throws Cancelled
SurfaceMap register_discs(const Matching& matching, SurfaceMap map, int threads, const Context& context = {});

}  // namespace ga_symmetry
