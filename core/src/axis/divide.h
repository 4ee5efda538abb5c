// SPDX-License-Identifier: GPL-3.0-or-later
// The sides and the axis of a reflection, from how much nearer each vertex is to the left.
#pragma once
#include <vector>

#include "ga_symmetry/result.h"
#include "surface/surface.h"

namespace ga_symmetry {

struct Division {
  std::vector<int> side;                        ///< per vertex: +1 left, 0 on the axis, -1 right
  std::vector<std::vector<SurfacePoint>> axis;  ///< polylines on the faces, longest first; closed ones repeat a point
};

/// Partners are on opposite sides: of the left-right function the part counts that the symmetry turns into its
/// negative. Where the sides of a shape differ, the middle of its distances is not the axis. Each side is one piece
/// where that can be (connect_sides); the axis is between them.
/// @param left_right  per vertex, > 0 nearer to the left
/// @param partner     per vertex, -1 = none
Division divide(const Surface& surface, const std::vector<float>& left_right, const std::vector<int>& partner);

}  // namespace ga_symmetry
