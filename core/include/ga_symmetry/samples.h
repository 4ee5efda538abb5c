// SPDX-License-Identifier: GPL-3.0-or-later
// Evenly spaced vertices of a mesh, and the patches around them.
#pragma once
#include <string>
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/mesh.h"

namespace ga_symmetry {

/// Samples and the patches around them.
struct SpacedSamples {
  std::vector<int> vertex;  ///< the samples: mesh vertices, all different
  std::vector<int> patch;   ///< per mesh vertex: the number of its nearest sample, -1 where no face is
  std::string surface;      ///< what was done inside to measure on the mesh, in one line; "" = nothing
};

/// Farthest point sampling by geodesic distance: every further sample is the vertex farthest from those before it, so
/// the first k of N are the k samples. The first is an end of a long geodesic, whatever the pose and the numbering.
/// @param mesh     of any connected surface
/// @param count    samples, [1, vertices that faces use]
/// @param largest_component  leave all other parts out
/// @param threads  0 = all cores, [0, 256]; speed only
/// @param context  progress and cancelling
/// @throws InvalidMesh    as find_symmetry
/// @throws InvalidOption  if count is out of range
/// @throws Cancelled
/// Source: Eldar et al. 1997, with geodesic distance.
SpacedSamples spaced_samples(const TriangleMesh& mesh, int count, bool largest_component = false, int threads = 0,
                             const Context& context = {});

}  // namespace ga_symmetry
