// SPDX-License-Identifier: GPL-3.0-or-later
// From a shape's field to triangles: the fundamental piece of a symmetric mesh, or a mesh that knows no symmetry.
#pragma once
#include "mesh.h"
#include "shapes.h"

namespace samples {

/// A triangle mesh of the shape's fundamental piece, open along its seams, with as many vertices as make the whole
/// shape have about `shape.vertices`. Seam vertices lie exactly on the seam planes; where the two seams are images of
/// each other, so are their vertices.
Mesh fundamental_piece(const Shape& shape);

/// A closed mesh of the whole shape, about `shape.vertices`, made without regard to its symmetry.
Mesh whole(const Shape& shape);

}  // namespace samples
