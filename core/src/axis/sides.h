// SPDX-License-Identifier: GPL-3.0-or-later
// The two sides of a reflection.
#pragma once
#include <vector>

#include "geodesics/geodesics.h"
#include "surface/surface.h"

namespace ga_symmetry {

/// How much nearer each vertex is to the left than to the right: over all landmark pairs, the difference of its
/// distances to the right and the left one; near pairs count more. 0 on the axis of a perfect symmetry.
/// @param from, to  landmarks and their images, as many
/// @param left  landmark that is on the left, or -1: the pair that is farthest apart is labelled left to right
/// @return per vertex, > 0 left
std::vector<float> left_right_function(const Surface& surface, const Landmarks& from, const Landmarks& to,
                                       int left = -1);

/// +1 where the function is positive, -1 where negative, 0 on the axis: of an edge that crosses it the nearer end.
std::vector<int> sides(const Surface& surface, const std::vector<float>& function);

/// Makes each side of a left-right function one piece. Along its axis a reflection cuts a closed connected surface into
/// two pieces at most, which it swaps (Weichold 1883); a torus' axis has two closed lines and still leaves two. So a
/// further piece is noise: it is joined to its side, or goes over to the other side, whichever changes the sign of less
/// of the function (absolute value times area); smallest first. Pieces at a border stay: what lies beyond it may have
/// joined them.
/// @return  how often the surface was searched for pieces: a few times, however many there are
int connect_sides(const Surface& surface, std::vector<float>& function);

}  // namespace ga_symmetry
