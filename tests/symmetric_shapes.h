// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes with one symmetry known by construction, and a few plain ones of other topology.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "ga_symmetry/mesh.h"

namespace ga_symmetry::shapes {

/// Radius 1, centred at 0: an icosahedron subdivided `level` times; 10 * 4^level + 2 vertices, mirrored in x, y and z.
TriangleMesh icosphere(int level);

/// Radii 1 and `tube` around the z axis; around * along vertices, both >= 3.
TriangleMesh torus(int around, int along, double tube = 0.4);

/// The unit square in the plane z = 0, open; columns * rows vertices, both >= 2.
TriangleMesh grid(int columns, int rows);

/// A mesh with one symmetry, and its truth.
struct Symmetric {
  TriangleMesh mesh;
  std::vector<int> partner;   ///< per vertex: its true partner; itself on the axis
  std::array<int, 2> axis{};  ///< two vertices on the axis, far apart
  std::array<int, 2> pair{};  ///< left and right, far from the axis
};

/// A body with a head, a tail, two arms and two legs: a sphere with bumps, mirrored vertex by vertex in x. Nothing else
/// of it is symmetric: the head and the tail are its only limbs on the axis, and it has a front and a back.
/// 10 * 4^level + 2 vertices.
Symmetric creature(int level);

/// Bends the body sideways, by `curvature` (1/length; the creature is about 4 long): what was a mirror image is none
/// any more, and lengths change by up to curvature * half its width.
Symmetric bent(Symmetric shape, double curvature);

/// New index of each vertex, at random.
std::vector<int> random_permutation(int n, std::uint64_t seed);

/// Vertex v becomes permutation[v]; faces in another order, too, starting at another corner.
TriangleMesh renumbered(const TriangleMesh& mesh, const std::vector<int>& permutation);
Symmetric renumbered(const Symmetric& shape, const std::vector<int>& permutation);

/// Renumbered at random: no index trick passes.
Symmetric shuffled(const Symmetric& shape, std::uint64_t seed);

/// Rotated by a fixed angle about an oblique axis, scaled, then moved.
TriangleMesh moved(TriangleMesh mesh, double scale);

}  // namespace ga_symmetry::shapes
