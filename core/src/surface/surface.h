// SPDX-License-Identifier: GPL-3.0-or-later
// Edge-manifold, oriented surfaces as flat arrays: what every stage after the door works on.
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
  std::vector<int> mesh_vertex;     ///< per vertex: the first vertex of the mesh that came in that stands there
  std::vector<int> surface_vertex;  ///< per vertex of the mesh that came in: its vertex here, -1 = on no face
  std::vector<double> vertex_area;  ///< per vertex: a third of the faces around it
  int mesh_vertices = 0;            ///< vertices of the mesh that came in
  double area = 0;                  ///< total
  bool orientable = true;
  bool closed = true;
  int branching = 0;               ///< edges of more than two faces, which were cut into sheets
  int flipped = 0;                 ///< faces that were turned round to match their neighbours
  std::vector<std::string> notes;  ///< what was done to the mesh to get here, a few words each

  int vertices() const { return static_cast<int>(first_corner.size()) - 1; }
  int triangles() const { return static_cast<int>(triangle.size() / 3); }
  const double* point(int v) const { return &position[3 * static_cast<std::size_t>(v)]; }
  /// Length unit in which costs and thresholds are expressed: sqrt(area).
  double unit() const;
  /// Distance between two vertices through space.
  double edge_length(int a, int b) const;
  double face_area(int f) const;
};

/// Next and previous corner around the same face.
inline int next_corner(int c) { return c % 3 == 2 ? c - 2 : c + 1; }
inline int previous_corner(int c) { return c % 3 == 0 ? c + 2 : c - 1; }

/// The door, for any triangle mesh: vertices at one place become one, faces without area and repeated ones are dropped,
/// edges of more than two faces are cut into sheets, faces are oriented alike. It may still be in several parts.
/// @param largest_component  keep the largest part only, by area and vertices
/// @throws InvalidMesh  in one line with the remedy: no faces, a coordinate that is not finite, an index out of range,
/// no
///         extent
/// @throws Cancelled
Surface make_surface(const TriangleMesh& mesh, bool largest_component = false, const Context& context = {});

/// The surface of faces that are known to be in order: every index in range, no face without area, all hanging
/// together. Vertex v stays vertex v. Edges of more than two faces are cut into sheets. @throws Cancelled
Surface surface_of(std::vector<double> position, std::vector<int> triangle, const Context& context = {});

}  // namespace ga_symmetry
