// From the partners of the samples to a partner for every vertex.
#pragma once
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/geodesics.h"
#include "ga_symmetry/result.h"
#include "ga_symmetry/surface.h"

namespace ga_symmetry {

/// Landmarks: the symmetry takes vertex `from[i]` to vertex `to[i]`.
struct Landmarks {
  std::vector<int> from, to;
};

struct DenseOptions {
  int rounds = 4;            ///< in each the landmarks' partners are found anew, [1, 20]
  bool both_ways = true;     ///< a reflection also takes `to` to `from`
};

struct DenseMap {
  std::vector<int> partner;          ///< per vertex: its partner
  std::vector<double> residual;      ///< per vertex: mean relative squared error of its distances, >= 0
  std::vector<SurfacePoint> point;   ///< per vertex: the partner on a face; surface vertices
  Landmarks landmarks;               ///< refined
  DistanceFields to_field;           ///< landmarks x vertices: fields of the refined landmarks.to
};

/// partner(v) is the vertex whose distances to the landmarks' partners are most like those of v to the landmarks; near
/// landmarks count more. Found by descent on the mesh from where the partners of v's neighbours stand, so its cost is
/// linear in the vertices.
/// @param fields  distance fields of landmarks.from, landmarks x vertices
/// @param fixed   that many landmarks at the end are given and not refined (the user's references)
/// @throws Cancelled
DenseMap make_dense_map(const Surface& surface, const GeodesicSolver& solver, const Landmarks& landmarks,
                        const DistanceFields& fields, int fixed, const DenseOptions& options, int threads,
                        const Context& context = {});

}  // namespace ga_symmetry
