// SPDX-License-Identifier: GPL-3.0-or-later
// One closed surface around everything: what the search works on where a mesh is not one surface itself.
#pragma once
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/mesh.h"

namespace ga_symmetry {

struct Wrap {
  TriangleMesh mesh;   ///< closed, connected, edge-manifold, outside out
  double spacing = 0;  ///< of the grid; the wrap runs at this distance from the faces
  int bridged = 0;     ///< gaps that were bridged
};

/// The outer boundary of all points within a distance from the faces (an offset surface, by marching cubes on a grid).
/// Parts nearer to each other than twice that are one then; where gaps are left, parts that are neighbours are joined
/// over the whole zone in which they are about as near to each other as they come, so that a symmetric shape is joined
/// symmetrically. What lies inside is not seen. Time and memory grow with the faces and with the grid, which does not.
/// @param position   x,y,z per vertex
/// @param triangle   faces, as they are: unconnected, crossing, turned against each other
/// @param spacing    of the grid, unit of the positions; at least 1/250 of the extent is used
/// @throws Cancelled
Wrap wrap(const std::vector<double>& position, const std::vector<int>& triangle, double spacing,
          const Context& context = {});

}  // namespace ga_symmetry
