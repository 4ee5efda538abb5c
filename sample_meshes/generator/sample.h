// SPDX-License-Identifier: GPL-3.0-or-later
// A posed mesh with its truth: mixed up, checked, and written.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "mesh.h"
#include "util/random.h"

namespace samples {

struct Sample {
  std::string name;
  Mesh mesh;                              ///< posed
  std::vector<Vec3> rest;                 ///< where each vertex is at rest
  std::vector<int> partner;               ///< per vertex; -1: it has no counterpart
  std::vector<std::vector<int>> mirrors;  ///< further symmetries, same form
  bool exact = true;                      ///< the truth maps vertices onto vertices, not only near them
  bool closed = true;
  bool assembled = false;  ///< as people have meshes: of parts, with seams or debris; its parts were checked before
  std::array<int, 4> refs{-1, -1, -1, -1};  ///< those to write; -1 = the best there are
  int order = 2;                            ///< the truth, followed so often, leads back
};

/// Draws a new order of vertices, of faces, and of the corners of each face.
void shuffle(Sample& sample, ga_symmetry::Random& random);

/// Throws unless it is one manifold, oriented surface that does not cut itself.
void check_surface(const Sample& sample);
/// Two fixed points far apart, and a pair as far from them, or from the axis, as possible.
std::array<int, 4> references(const Sample& sample);

/// Checks the promises of the README on the coordinates as written, writes NAME.off, .truth, .refs, and .affected or
/// .mirrors where they apply, and prints one line of figures.
void write(Sample sample, const std::string& folder);

}  // namespace samples
