// Landmarks: vertices whose images under the symmetry carry everything else; and how the images are made exact.
#pragma once
#include <vector>

#include "ga_symmetry/context.h"
#include "geodesics/geodesics.h"
#include "geodesics/shortcuts.h"
#include "surface/curvature.h"
#include "surface/surface.h"

namespace ga_symmetry {

/// The symmetry takes vertex `from[i]` to vertex `to[i]`.
struct Landmarks {
  std::vector<int> from, to;
};

/// Landmarks with the distance fields of their images.
struct RefinedLandmarks {
  Landmarks landmarks;
  DistanceFields to_field;  ///< landmarks x vertices: distance fields of landmarks.to
};

struct RefineOptions {
  int rounds = 1;          ///< of refine_landmarks, [0, 20]; in each all images are found anew, given the others
  int steps = 12;          ///< of adjust_landmarks, [0, 100]
  double curvature = 0;    ///< its weight in adjust_landmarks, >= 0
  int fixed = 0;           ///< that many landmarks at the end are exact and stay (the user's references)
  bool reflection = true;  ///< a reflection also takes `to` to `from`, and mirrors directions
  const Shortcuts* shortcuts = nullptr;  ///< through what is missing; null = nothing is
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

/// Moves all images together to where their mutual distances agree best: what each alone cannot correct, a limb turned
/// about its axis or pulled along it. Damped Gauss-Newton steps (Levenberg 1944, Marquardt 1963) on the stress of the
/// landmarks; the derivative of a geodesic distance is its direction in the tangent plane. Parameters as
/// refine_landmarks. The stress never rises.
/// @throws Cancelled
RefinedLandmarks adjust_landmarks(const Surface& surface, const GeodesicSolver& solver, RefinedLandmarks start,
                                  const DistanceFields& fields, const CurvatureFeatures& curvature,
                                  const RefineOptions& options, int threads, const Context& context = {});

/// What adjust_landmarks lowers: the mean over landmarks of the weighted mean squared differences of their distances,
/// each capped, and of the curvature; units^2.
double landmark_stress(const Surface& surface, const RefinedLandmarks& refined, const DistanceFields& fields,
                       const CurvatureFeatures& curvature, const RefineOptions& options);

/// Where some vertices' partners are by the landmarks, and how well all their distances and their curvature agree
/// there.
struct Probes {
  std::vector<int> partner;
  std::vector<float> error;  ///< mean squared, in units^2
};
/// @param vertices  to find the partners of
/// @param options   `reflection` and `shortcuts` of them
Probes match_probes(const Surface& surface, const RefinedLandmarks& refined, const DistanceFields& fields,
                    const CurvatureFeatures& curvature, const std::vector<int>& vertices, const RefineOptions& options);

}  // namespace ga_symmetry
