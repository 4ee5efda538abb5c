// SPDX-License-Identifier: GPL-3.0-or-later
// What a renderer draws of a mesh, as one list of faces: vertices at one place are one, and no face is without area.
#pragma once
#include <string>
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/mesh.h"

namespace ga_symmetry {

/// Squared distance of two points through space.
inline double squared_distance(const double* a, const double* b) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

struct WeldedMesh {
  std::vector<double> position;    ///< x,y,z per place; the box of the faces fits the unit cube, its corner is 0
  std::vector<int> triangle;       ///< three places per face, all different; no face twice
  std::vector<int> place;          ///< per vertex of the mesh: its place, -1 = no face uses it
  std::vector<int> vertex;         ///< per place: the first vertex of the mesh that stands there
  std::vector<std::string> notes;  ///< what was done, a few words each

  int places() const { return static_cast<int>(position.size() / 3); }
  int triangles() const { return static_cast<int>(triangle.size() / 3); }
  const double* point(int p) const { return &position[3 * static_cast<std::size_t>(p)]; }
};

/// Welds vertices of equal coordinates, then those on a border that are much nearer to each other than their edges are
/// long: seams of textures, and of parts that were exported one by one. A face without area whose corners are all
/// different, a needle, goes to the faces beside it, so that no gap opens. Nothing is moved.
/// @throws InvalidMesh  in one line with the remedy: no faces, a coordinate that is not finite, an index out of range,
/// no
///         extent, more than 2^31 - 1 corners
/// @throws Cancelled
WeldedMesh weld(const TriangleMesh& mesh, const Context& context = {});

/// Keeps the part that is largest by area and vertices, the product of both shares; its share is noted.
void keep_largest(WeldedMesh& mesh);

/// Parts of a mesh: faces that share a place, directly or over others. @return per face: its part, numbered from 0 in
/// the order of first faces
std::vector<int> face_parts(const std::vector<int>& triangle, int places, int& count);

}  // namespace ga_symmetry
