// A checked, connected, edge-manifold surface as flat arrays: what every stage after the door works on.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/mesh.h"

namespace ga_symmetry {

/// Corner c = 3 * face + k is the k-th vertex of a face; it also names the face's edge opposite to it.
struct Surface {
  std::vector<double> position;     ///< x,y,z per vertex
  std::vector<int> triangle;        ///< vertex of each corner; faces consistently oriented where `orientable`
  std::vector<int> first_corner;    ///< vertices + 1: range of `corner_at` that holds a vertex's corners
  std::vector<int> corner_at;       ///< corners grouped by vertex
  std::vector<int> opposite;        ///< per corner: the corner across its edge, -1 at the border
  std::vector<int> mesh_vertex;     ///< per vertex: its index in the mesh that came in
  std::vector<double> vertex_area;  ///< per vertex: a third of the faces around it
  int mesh_vertices = 0;            ///< vertices of the mesh that came in
  double area = 0;                  ///< total
  bool orientable = true;
  bool closed = true;
  std::vector<std::string> warnings;  ///< what was left out, one line each

  int vertices() const { return static_cast<int>(first_corner.size()) - 1; }
  int triangles() const { return static_cast<int>(triangle.size() / 3); }
  const double* point(int v) const { return &position[3 * static_cast<std::size_t>(v)]; }
  /// Length unit in which costs and thresholds are expressed: sqrt(area).
  double unit() const;
  /// Distance between two vertices through space.
  double edge_length(int a, int b) const;
};

/// Next and previous corner around the same face.
inline int next_corner(int c) { return c % 3 == 2 ? c - 2 : c + 1; }
inline int previous_corner(int c) { return c % 3 == 0 ? c + 2 : c - 1; }

/// The door: checks and compacts. Vertices that no face uses are left out, with a warning.
/// @param largest_component  keep the component of the largest area instead of refusing several
/// @throws InvalidMesh  in one line with the remedy: no faces, fewer than 20 used vertices, a coordinate that is not
///         finite, an index out of range, a zero-area face, an edge with more than two faces, several
///         components, more than 20000 faces around a vertex
/// @throws Cancelled
Surface make_surface(const TriangleMesh& mesh, bool largest_component = false, const Context& context = {});

}  // namespace ga_symmetry
