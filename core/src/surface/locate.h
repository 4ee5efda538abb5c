// SPDX-License-Identifier: GPL-3.0-or-later
// Where the vertices of a mesh stand on a surface of the same shape.
#pragma once
#include <array>
#include <vector>

#include "ga_symmetry/result.h"
#include "surface/surface.h"

namespace ga_symmetry {

/// The nearest point of the surface for every vertex of the mesh, by distance through space; of two that are about as
/// near, as on both sides of a thin sheet, the one that faces the same way.
/// @return per vertex of the mesh: surface vertices and weights
std::vector<SurfacePoint> locate(const Surface& mesh, const Surface& surface, int threads);

/// Sum of the normals of the faces around each vertex, weighted by area.
std::vector<std::array<double, 3>> vertex_normals(const std::vector<double>& position,
                                                  const std::vector<int>& triangle);

}  // namespace ga_symmetry
