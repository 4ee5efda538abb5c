// SPDX-License-Identifier: GPL-3.0-or-later
// The plain triangle mesh that enters and leaves the core, and the door for any vcglib mesh.
#pragma once
#include <vector>

namespace ga_symmetry {

/// A triangle mesh as it stands in its file: nothing checked, nothing removed.
struct TriangleMesh {
  std::vector<double> position;  ///< x,y,z per vertex, any length unit
  std::vector<int> triangle;     ///< three vertex indices per face
  /// Number of vertices.
  int vertices() const { return static_cast<int>(position.size() / 3); }
  /// Number of faces.
  int triangles() const { return static_cast<int>(triangle.size() / 3); }
};

/// Any vcglib triangle mesh as flat arrays. Vertex i of the result is slot i of `m.vert`; slots of deleted vertices
/// stay, referenced by no triangle, so indices mean the same on both sides. Reads only.
template <class VcgMesh>
TriangleMesh to_triangle_mesh(const VcgMesh& m) {
  TriangleMesh out;
  out.position.reserve(3 * m.vert.size());
  for (const auto& v : m.vert)
    for (int k = 0; k < 3; ++k) out.position.push_back(v.IsD() ? 0.0 : static_cast<double>(v.cP()[k]));
  out.triangle.reserve(3 * m.face.size());
  for (const auto& f : m.face)
    if (!f.IsD())
      for (int k = 0; k < 3; ++k) out.triangle.push_back(static_cast<int>(f.cV(k) - m.vert.data()));
  return out;
}

}  // namespace ga_symmetry
