// Samples of a surface, and the distance fields that start at them.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "ga_symmetry/context.h"
#include "geodesics/geodesics.h"
#include "surface/surface.h"
#include "util/random.h"

namespace ga_symmetry {

/// Sample vertices with the distance field of each: the fields are the expensive part, so they are kept.
struct Samples {
  std::vector<int> vertex;  ///< surface vertex of each sample, all different
  DistanceFields distance;  ///< samples x vertices: row i is the field of vertex[i], unit of the surface
};

/// Evenly spaced: every further sample is the vertex farthest from those before it (ties: the lower index), so the
/// first k of N samples are the k samples. The first is an end of a long geodesic of the surface, whatever the pose and
/// the numbering of the vertices.
/// @param count  samples, [1, vertices]
/// @param threads  0 = all cores; speed only, never results
/// @throws InvalidOption  if count is out of range
/// @throws Cancelled
/// Source: Eldar et al. 1997, with geodesic distance.
Samples evenly_spaced_samples(const Surface& surface, const GeodesicSolver& solver, int count, int threads,
                              const Context& context = {});

/// Random vertices without repetition, each with a probability proportional to the area around it.
/// @param count  samples, [1, vertices]
/// @throws InvalidOption  if count is out of range
/// Source: Efraimidis & Spirakis 2006.
std::vector<int> uniform_sample_vertices(const Surface& surface, int count, Random& random);

/// The same with their distance fields. @throws InvalidOption, Cancelled
Samples uniform_samples(const Surface& surface, const GeodesicSolver& solver, int count, Random& random, int threads,
                        const Context& context = {});

/// samples x samples distances; the mean of both directions, hence exactly symmetric, and 0 on the diagonal.
Eigen::MatrixXf symmetric_distances(const Samples& samples);

/// Nearest sample of each vertex (its number, not its vertex; ties: the lower one): the patches of the paper's
/// figure 1.
std::vector<int> sample_patches(const Samples& samples);

}  // namespace ga_symmetry
