// SPDX-License-Identifier: GPL-3.0-or-later
// From the partners of the samples to a partner for every vertex.
#pragma once
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/result.h"
#include "matching/matching.h"

namespace ga_symmetry {

/// All vertices are the surface's.
struct DenseMap {
  std::vector<int> partner;         ///< per vertex: its partner
  std::vector<float> residual;      ///< per vertex: how badly distances and curvature agree there, as Probes::error
  std::vector<float> uncertainty;   ///< per vertex: how far off the partner may be by that residual, in units
  std::vector<SurfacePoint> point;  ///< per vertex: the partner on a face
  std::vector<int> by_distances;    ///< per vertex: the partner before spectral refinement
};

struct DenseMapOptions {
  bool local_refinement = true;  ///< fit discs of the surface where they are taken: registration.h, turned_parts.h
  bool noise_filter = true;  ///< average over neighbours by how much distances to a vertex's partner are off: what is
                             ///< left is the pose's, not the vertex's; partners then are where that leads
  bool spectral_refinement = true;  ///< go by eigenfunctions before and after that: spectral.h
};

/// partner(v) is the vertex whose distances to the landmarks' images are most like those of v to the landmarks, and
/// whose curvature is most like v's; near landmarks count more. Found by descent over edges from where the partners of
/// near landmarks and of v's neighbours stand, so the work is linear in the vertices.
/// @throws Cancelled
DenseMap make_dense_map(const Matching& matching, const Images& images, const DenseMapOptions& options, int threads,
                        const Context& context = {});

}  // namespace ga_symmetry
