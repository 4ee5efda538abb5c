// SPDX-License-Identifier: GPL-3.0-or-later
// Walking over a surface's edges.
#pragma once
#include "surface/surface.h"

namespace ga_symmetry {

/// Calls visit(w) for each neighbour w of a vertex, once each; on a one-sided surface, whose faces do not all turn the
/// same way, twice for a neighbour across an inner edge.
template <class Visit>
void for_each_neighbor(const Surface& surface, int vertex, const Visit& visit) {
  for (int i = surface.first_corner[vertex]; i < surface.first_corner[vertex + 1]; ++i) {
    const int corner = surface.corner_at[i];
    visit(surface.triangle[next_corner(corner)]);
    // At the border the last neighbour of a fan follows no corner.
    if (surface.opposite[next_corner(corner)] < 0 || !surface.orientable)
      visit(surface.triangle[previous_corner(corner)]);
  }
}

}  // namespace ga_symmetry
