// SPDX-License-Identifier: GPL-3.0-or-later
// What vcglib does for the generator.
#pragma once
#include "mesh.h"
#include "util/random.h"

namespace samples {

/// The same surface in triangles with edges of about `edge`; the border keeps its place.
Mesh isotropic_remesh(const Mesh& mesh, double edge, int rounds);

/// The same surface with so many vertices, by quadrics; the border stays about where it is.
Mesh decimated(const Mesh& mesh, int vertices);

/// Flips up to `share` of the edges, drawn at random, where the surface is nearly flat and the new triangles are good.
void flip_edges(Mesh& mesh, double share, ga_symmetry::Random& random);

/// Faces that cut another face.
int self_intersections(const Mesh& mesh);

/// For each query the nearest of `points`.
std::vector<int> nearest(const std::vector<Vec3>& points, const std::vector<Vec3>& queries);

}  // namespace samples
