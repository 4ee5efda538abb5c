// SPDX-License-Identifier: GPL-3.0-or-later
// What there is to draw of a symmetry that is known: links between partners, and the axis.
#pragma once
#include <array>
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/mesh.h"
#include "ga_symmetry/partners.h"
#include "ga_symmetry/result.h"

namespace ga_symmetry {

/// Evenly spread pairs: every further one starts at the vertex farthest from the starts before it, of those on the left
/// (of all, where there are no sides) that have a partner other than themselves. So the first k of N are the k pairs.
/// @param mesh     any; a mesh of several components counts by its largest
/// @param partners  of that mesh
/// @param count    pairs, >= 1; fewer where there are not so many
/// @param context  progress and cancelling
/// @throws InvalidOption  if count < 1, or as check_partners
/// @throws InvalidMesh    as make_surface with the largest component
/// @throws Cancelled
std::vector<SymmetricPair> spread_pairs(const TriangleMesh& mesh, const Partners& partners, int count,
                                        const Context& context = {});

/// The axis as polylines on the faces, longest first, nothing shorter than a twentieth of the whole; a closed one
/// repeats its first point. Where the distances to evenly spread vertices of the left and to their partners are equal:
/// a smooth line, though each single partner is off by a little. On a surface without a border it leaves one piece on
/// each side: one closed line, or as many as the surface has handles, and one more.
/// @param mesh, partners  as in spread_pairs
/// @param threads  0 = all cores, [0, 256]; speed only
/// @param context  progress and cancelling
/// @throws as spread_pairs; InvalidOption too if there are no sides, as after a rotation
std::vector<std::vector<SurfacePoint>> axis_lines(const TriangleMesh& mesh, const Partners& partners, int threads,
                                                  const Context& context = {});

/// Where a point on a face is.
std::array<double, 3> position_of(const TriangleMesh& mesh, const SurfacePoint& point);
/// Interpolates values given at the vertices.
double value_at(const std::vector<double>& values, const SurfacePoint& point);

}  // namespace ga_symmetry
