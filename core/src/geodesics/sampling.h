// SPDX-License-Identifier: GPL-3.0-or-later
// Samples of a surface, and the distance fields that start at them.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "ga_symmetry/context.h"
#include "geodesics/geodesics.h"
#include "surface/surface.h"
#include "util/random.h"

namespace ga_symmetry {

/// Farthest point sampling, by any distance: every further sample is the vertex farthest from those before it (ties:
/// the earlier of `allowed`), so the first k of N samples are the k samples.
/// @param allowed  vertices to choose from, all different
/// @param first    the first sample, one of them
/// @param count    samples, >= 1; fewer where fewer are allowed
/// @param nearest  (vertex) -> how far the nearest sample is
/// @param add      (vertex) adds a sample to what `nearest` knows
/// Source: Eldar et al. 1997.
template <class Nearest, class Add>
std::vector<int> farthest_points(const std::vector<int>& allowed, int first, int count, const Nearest& nearest,
                                 const Add& add) {
  std::vector<int> out{first};
  const std::size_t last = std::min(allowed.size(), static_cast<std::size_t>(count));
  while (out.size() < last) {
    add(out.back());
    out.push_back(
        *std::max_element(allowed.begin(), allowed.end(), [&](int a, int b) { return nearest(a) < nearest(b); }));
  }
  return out;
}

/// The same by geodesic distance, on a part of a surface. The first is the allowed vertex farthest from the allowed one
/// of the largest area: an end of the part, whatever the numbering.
/// @return  empty if no vertex is allowed
/// @throws Cancelled
std::vector<int> farthest_points(const Surface& surface, const GeodesicSolver& solver, const std::vector<int>& allowed,
                                 int count, const Context& context = {});

/// Evenly spaced: farthest point sampling by geodesic distance. The first is an end of a long geodesic of the surface,
/// whatever the pose and the numbering of the vertices.
/// @param count  samples, [1, vertices]
/// @param threads  0 = all cores; speed only, never results
/// @throws InvalidOption  if count is out of range
/// @throws Cancelled
Landmarks evenly_spaced_samples(const Surface& surface, const GeodesicSolver& solver, int count, int threads,
                                const Context& context = {});

/// Random vertices without repetition, each with a probability proportional to the area around it.
/// @param count  samples, [1, vertices]
/// @throws InvalidOption  if count is out of range
/// Source: Efraimidis & Spirakis 2006.
std::vector<int> uniform_sample_vertices(const Surface& surface, int count, Random& random);

/// samples x samples distances; the mean of both directions, hence exactly symmetric, and 0 on the diagonal.
Eigen::MatrixXf symmetric_distances(const Landmarks& samples);

/// Per vertex: the row of the field that is smallest there, so which source is nearest (ties: the lower row). The
/// patches of figure 1 of *Finding Intrinsic Points on 3D Models with Using Genetic Algorithms*.
std::vector<int> nearest_source(const DistanceFields& fields);

}  // namespace ga_symmetry
