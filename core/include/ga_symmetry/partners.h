// SPDX-License-Identifier: GPL-3.0-or-later
// The partners of a mesh's vertices as they are kept between runs: in files, in MeshLab's attributes, in arrays.
#pragma once
#include <vector>

#include "ga_symmetry/mesh.h"

namespace ga_symmetry {

/// Partner, fitness and side of every vertex.
struct Partners {
  std::vector<int> partner;     ///< per vertex: its partner's index, -1 = none
  std::vector<double> fitness;  ///< per vertex: >= 0, 0 is perfect, dimensionless
  std::vector<int> side;        ///< per vertex: +1 left, 0 on the axis, -1 right; all 0 for a rotation
};

/// Checks that the partners can be those of this mesh: one entry a vertex, every partner a vertex or -1, fitness >= 0,
/// side -1, 0 or 1, and vertices that share an edge with partners nearer to each other than two vertices at random.
/// @throws InvalidOption
void check_partners(const Partners& partners, const TriangleMesh& mesh);

}  // namespace ga_symmetry
