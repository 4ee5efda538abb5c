// SPDX-License-Identifier: GPL-3.0-or-later
// Breaks a mesh the way the meshes that people have are broken, and keeps the truth. What breaks is drawn at random, so
// it is never symmetric. What shapes lack or have too much is in sample_meshes/generator/damage.h.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "ga_symmetry/evaluation.h"
#include "ga_symmetry/mesh.h"
#include "util/random.h"

namespace ga_symmetry::damage {

/// A mesh, whole at first, and where each of its vertices comes from.
struct Damaged {
  TriangleMesh mesh;
  std::vector<int> origin;   ///< per vertex: the vertex of the whole mesh that it is a copy of; -1 = it is new
  std::vector<int> nearest;  ///< the same; of a new one on an edge or a fin an end of the edge; -1 = debris
  std::vector<int> partner;  ///< per vertex: its true partner, before `finish` as a vertex of the whole mesh, then as
                             ///< one of this, of several copies any; a new one on an edge has that of an end of the
                             ///< edge; -1 = debris, tips of fins, and what has lost its counterpart
  std::vector<int> truth;    ///< per vertex of the whole mesh: its partner, -1 = unknown

  /// The first vertex that is a copy, or -1.
  int copy_of(int whole_vertex) const;
};

/// @param truth  per vertex: its partner; -1 = unknown
Damaged whole(const TriangleMesh& mesh, const std::vector<int>& truth);

/// As textures do: faces in so many charts, each with its own copies of the vertices on its border.
void split_seams(Damaged& d, int charts, Random& random);
/// The same, and the copies are apart by what six digits round.
void split_seams_apart(Damaged& d, int charts, Random& random);
/// Into the pieces between random planes, along edges.
/// @param gap  between both copies of a vertex, over the mean length of edges; 0 = both at one place
void cut(Damaged& d, int planes, double gap, Random& random);
/// Takes away the faces that random planes go through.
void remove_strips(Damaged& d, int planes, Random& random);
/// Triangles that stand on edges of two faces.
void add_fins(Damaged& d, int count, Random& random);
/// Faces again, every other one turned over.
void repeat_faces(Damaged& d, int count, Random& random);
/// Closed, but with faces without area: every other one with two corners at one place, else a needle along an edge.
void add_zero_area(Damaged& d, int count, Random& random);
/// Turns faces over.
void flip_faces(Damaged& d, double share, Random& random);
/// Gives faces vertices of their own.
void loosen_faces(Damaged& d, double share, Random& random);
/// Tetrahedra and flakes of two faces that float in and around the box, 0.3 to 1.5 % of its diagonal large.
void add_debris(Damaged& d, int pieces, Random& random);
/// Vertices in the middle of an edge that only one of its two faces has.
void add_junctions(Damaged& d, int count, Random& random);
/// Moves every coordinate at random by up to `size`.
void add_noise(Damaged& d, double size, Random& random);

/// Takes away what lies beyond a random plane, as of a scan that does not reach so far; of the rest the largest part
/// stays.
/// @param share  of the vertices that are beyond
void cut_off(Damaged& d, double share, Random& random);
/// Takes away what lies in balls around random vertices; of the rest the largest part stays.
/// @param share  of the vertices in each ball
void bite(Damaged& d, int balls, double share, Random& random);

/// Drops vertices of no face, shuffles vertices, faces and corners, and sets `partner`.
void finish(Damaged& d, Random& random);

/// One damage of usual strength.
struct Kind {
  std::string name;
  void (*apply)(Damaged&, Random&);
};
/// Each alone; the last is all at once.
const std::vector<Kind>& kinds();
/// Those that take away a part of the shape and with it its symmetry; none of `kinds()`.
const std::vector<Kind>& partial_kinds();

/// A whole mesh with one damage, finished. The same seed gives the same mesh.
Damaged damaged(const TriangleMesh& mesh, const std::vector<int>& truth, const Kind& kind, std::uint64_t seed);

/// A map of the damaged mesh as one of the whole: what is measured there can be compared with a map of the whole
/// itself.
/// @param partner  per vertex of the damaged mesh: its partner, -1 = none
/// @return per vertex of the whole mesh: the partner of its first copy; -1 = none, or debris
std::vector<int> map_of_whole(const Damaged& d, const std::vector<int>& partner);
/// The truth about vertices of the whole mesh of which copies are left, and copies of their partners.
Truth truth_of_whole(const Damaged& d);
/// Share of the damaged mesh's vertices with a true partner that have a partner.
double coverage(const Damaged& d, const std::vector<int>& partner);

}  // namespace ga_symmetry::damage
