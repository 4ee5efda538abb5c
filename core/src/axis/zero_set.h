// SPDX-License-Identifier: GPL-3.0-or-later
// Where a function on a surface changes its sign.
#pragma once
#include <vector>

#include "ga_symmetry/result.h"
#include "surface/surface.h"

namespace ga_symmetry {

/// The function's zero set as polylines on the faces, longest first; a closed one repeats its first point.
/// @param function  per vertex; 0 counts as negative
/// @param shortest  polylines of a smaller share of the total length are left out, [0,1]
std::vector<std::vector<SurfacePoint>> zero_set(const Surface& surface, const std::vector<float>& function,
                                                double shortest);

}  // namespace ga_symmetry
