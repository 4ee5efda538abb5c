// SPDX-License-Identifier: GPL-3.0-or-later
// Heads that were turned about their necks.
#pragma once
#include "ga_symmetry/context.h"
#include "matching/matching.h"
#include "matching/spectral.h"

namespace ga_symmetry {

/// Turns parts back that a map has turned: what distances hardly tell, as all points of a head are as far from the
/// body whichever way it looks, the shape does. Around landmarks where small discs fit badly to where the map takes
/// them, a larger one is turned to twelve angles and fitted each time. The best is taken if it, and the small discs in
/// it, fit twice as well as before: bent tails and limbs fit better as a whole when they are turned, not in their
/// pieces.
/// @return  whether anything was turned
/// @throws Cancelled
bool turn_parts_back(const Matching& matching, SurfaceMap& map, int threads, const Context& context = {});

}  // namespace ga_symmetry
