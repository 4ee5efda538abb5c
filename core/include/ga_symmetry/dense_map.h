// From the partners of the samples to a partner for every vertex.
#pragma once
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/curvature.h"
#include "ga_symmetry/geodesics.h"
#include "ga_symmetry/result.h"
#include "ga_symmetry/surface.h"

namespace ga_symmetry {

/// Landmarks: the symmetry takes vertex `from[i]` to vertex `to[i]`.
struct Landmarks {
  std::vector<int> from, to;
};

/// Landmarks whose images have been moved to where their mutual distances agree best.
struct RefinedLandmarks {
  Landmarks landmarks;
  DistanceFields to_field;  ///< landmarks x vertices: distance fields of landmarks.to
};

struct RefineOptions {
  bool fine = false;       ///< near landmarks count even more: for images that are nearly right
  int rounds = 2;          ///< in each all images are found anew, given the others, [0, 20]
  int fixed = 0;           ///< that many landmarks at the end are exact and stay (the user's references)
  bool reflection = true;  ///< a reflection also takes `to` to `from`, and mirrors directions
};

/// Moves the image of each landmark to the vertex whose distances to the other images are most like the landmark's own
/// distances to the others, and whose curvature is; near landmarks count more. By descent on the mesh, from where the
/// image is.
/// @param fields     distance fields of landmarks.from, landmarks x vertices
/// @param curvature  of all vertices
/// @param start      the landmarks and the fields of their images
/// @throws Cancelled
RefinedLandmarks refine_landmarks(const Surface& surface, const GeodesicSolver& solver, RefinedLandmarks start,
                                  const DistanceFields& fields, const CurvatureFeatures& curvature,
                                  const RefineOptions& options, int threads, const Context& context = {});

/// Where some vertices' partners are by the landmarks, and how well all their distances and their curvature agree
/// there.
struct Probes {
  std::vector<int> partner;
  std::vector<float> error;  ///< mean squared, in units^2
};
/// @param vertices  to find the partners of
Probes match_probes(const Surface& surface, const RefinedLandmarks& refined, const DistanceFields& fields,
                    const CurvatureFeatures& curvature, const std::vector<int>& vertices, bool reflection);

struct DenseMap {
  std::vector<int> partner;         ///< per vertex: its partner
  std::vector<float> residual;      ///< per vertex: as Probes::error
  std::vector<float> uncertainty;   ///< per vertex: how far off the partner may be by that residual, in units
  std::vector<SurfacePoint> point;  ///< per vertex: the partner on a face; surface vertices
};

/// partner(v) is the vertex whose distances to the landmarks' images are most like those of v to the landmarks, and
/// whose curvature is most like v's; near landmarks count more. Found by descent on the mesh from where the partners of
/// near landmarks and of v's neighbours stand, so the work is linear in the vertices.
/// @throws Cancelled
DenseMap make_dense_map(const Surface& surface, const RefinedLandmarks& refined, const DistanceFields& fields,
                        const CurvatureFeatures& curvature, bool reflection, int threads, const Context& context = {});

}  // namespace ga_symmetry
