// SPDX-License-Identifier: GPL-3.0-or-later
// Gaps between parts: a body that was cut, a glove that ends before the sleeve does.
#pragma once
#include "surface/surface.h"

namespace ga_symmetry {

/// Closes gaps between rims that face each other with strips of triangles, the narrowest places first. A rim is a
/// closed line of border edges; two places of one rim that are near along it do not face each other. Holes of a face or
/// two in a sheet with a longer rim are left alone. Sheets that lie wrong side up beside others are turned over first.
/// @param mesh     with orientation, or nothing is done
/// @param reach    how wide a gap may be, a length
/// @param[out] to  the surface with the strips; its vertices and faces are those of `mesh`, some turned
///                 over. Untouched if there are none
/// @return how many triangles were added
/// @throws Cancelled
int sew(const Surface& mesh, double reach, Surface& to, const Context& context);

}  // namespace ga_symmetry
