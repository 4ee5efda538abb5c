// SPDX-License-Identifier: GPL-3.0-or-later
// The images of landmarks under a symmetry, and how they are made exact.
#pragma once
#include <vector>

#include "ga_symmetry/context.h"
#include "matching/matching.h"

namespace ga_symmetry {

/// Moves the image of each landmark, but those that are fixed, to the vertex whose distances to the other images are
/// most like the landmark's own distances to the others, and whose curvature is; near landmarks count more. By descent
/// over edges, from where the image is.
/// @throws Cancelled
Images refine_images(const Matching& matching, Images start, int threads, const Context& context = {});

/// Weight of the curvature where images are nearly right. From farther off it leads to the wrong place.
constexpr double kAdjustCurvature = 0.006;

struct AdjustOptions {
  int steps = 12;        ///< at most, [0, 100]
  double curvature = 0;  ///< its weight beside the distances, >= 0
};

/// Moves all images together to where their mutual distances agree best: what each alone cannot correct, a limb turned
/// about its axis or pulled along it. Damped Gauss-Newton steps (Levenberg 1944, Marquardt 1963) on the stress; the
/// derivative of a geodesic distance is its direction in the tangent plane. The stress never rises.
/// @throws Cancelled
Images adjust_images(const Matching& matching, Images start, const AdjustOptions& options, int threads,
                     const Context& context = {});

/// What adjust_images lowers: the mean over landmarks of the weighted mean squared differences of their distances, each
/// capped, and of the curvature; units^2.
double image_stress(const Matching& matching, const Images& images, double curvature_weight);

/// Where some vertices' partners are by the landmarks, and how well all their distances and their curvature agree
/// there.
struct Probes {
  std::vector<int> partner;
  std::vector<float> error;  ///< mean squared, in units^2
};
/// @param vertices  to find the partners of
Probes match_probes(const Matching& matching, const Images& images, const std::vector<int>& vertices);

}  // namespace ga_symmetry
