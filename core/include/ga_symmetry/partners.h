// The partners of a mesh's vertices as they are kept between runs: in files, in MeshLab's attributes, in arrays.
#pragma once
#include <string>
#include <vector>

#include "ga_symmetry/triangle_mesh.h"

namespace ga_symmetry {

struct Partners {
  std::vector<int> partner;     ///< per vertex: its partner's index, -1 = none
  std::vector<double> fitness;  ///< per vertex: >= 0, 0 is perfect
  std::vector<int> side;        ///< per vertex: +1 left, 0 on the axis, -1 right; all 0 for a rotation
};

/// Reads what write_result wrote. `.json`: only for the mesh it was made for, told by its checksum. Any other name is a
/// CSV whose header names at least `vertex` and `partner`; every vertex once, in any order. Without the columns
/// `fitness` and `side` those stay empty.
/// @throws FileError
Partners read_partners(const std::string& path, const TriangleMesh& mesh);

/// Checks that the partners can be those of this mesh: one entry a vertex, every partner a vertex or -1, fitness >= 0,
/// side -1, 0 or 1, and vertices that share an edge with partners nearer to each other than two vertices at random.
/// @throws InvalidOption
void check_partners(const Partners& partners, const TriangleMesh& mesh);

/// Both: reads partners with all columns, and checks them. @throws FileError
Partners read_checked_partners(const std::string& path, const TriangleMesh& mesh);

}  // namespace ga_symmetry
