// SPDX-License-Identifier: GPL-3.0-or-later
// The choice among the maps that survive the search: which is the symmetry, and which are other symmetries.
#pragma once
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/result.h"
#include "matching/matching.h"
#include "matching/refinement.h"
#include "search/joint.h"
#include "search/sites.h"

namespace ga_symmetry {

/// Distance, in units, by which a map may pass by the references: poses move them by some 0.01.
constexpr double kReferenceSlack = 0.03;

/// A map of the samples that may be the symmetry.
struct Candidate {
  Images images;              ///< of the landmarks
  int order = 0;              ///< applied so often it is the identity, 0 = not within twelve times
  double score = 0;           ///< >= 0, lower is better
  double off_references = 0;  ///< how far it is from where the references go: units, >= 0
};

/// The plane that comes nearest to a map.
struct Mirrored {
  MirrorPlane plane;  ///< fitted to the surface, unless it is far off
  double away = 0;  ///< root mean square distance from mirrored points to their partners, each capped at 0.2, in units
};
/// @param partners  of the vertices
Mirrored mirrored_by(const Matching& matching, const std::vector<int>& vertices,
                     const std::vector<SurfacePoint>& partners);

/// The images of the samples under a map, then those of the references.
Images images_of(const SampleMap& map, const Sites& sites, const Landmarks& reference_images);

/// How badly distances, curvature and descriptors agree under a map: root mean square over the sites, which are as good
/// as evenly spaced vertices, and relative to how far it moves them. Any shape is its own identity, and a thin one is
/// nearly its own mirror image from front to back: agreement is evidence only where points are moved. To move all of
/// them proves no more than to move most, as a reflection does; or an animal would be mirrored head to tail.
/// @return  >= 0, +inf if nothing is moved
double disagreement(const Matching& matching, const Sites& sites, const Images& images);

/// Share of the surface, by area, whose image lies wrong side up: a reflection turns faces over, a rotation does not.
/// Half flips and maps from front to back have much of it, whatever distances say. What has no counterpart, and goes
/// somewhere near its rim, is left out of both.
/// @param probes  of all vertices @return  [0, 1]
double wrongly_turned(const Matching& matching, const Probes& probes);

/// Whether two maps take the samples to the same places, but for noise.
bool same_symmetry(const Matching& matching, const Sites& sites, const Images& a, const Images& b);

/// Whether one map takes the samples back to where the other has taken them from, but for noise.
bool inverse_symmetries(const Matching& matching, const Sites& sites, const Images& a, const Images& b);

/// The maps as the search has left them, scored by their disagreement; +inf where references go elsewhere.
std::vector<Candidate> candidates_of(const Matching& matching, const Sites& sites, const std::vector<SampleMap>& maps,
                                     const Landmarks& reference_images, int threads);

enum class Refine {
  contenders,  ///< the best few, and of them those that may be the best: enough to know which is
  all
};
/// The maps at vertex resolution, best first, without the identity and those that are the same symmetry as a better
/// one. A rotation and its inverse are one, turned counter-clockwise as the samples stand, seen from the positive end
/// of the coordinate axis that is nearest to what it turns about, unless references say which way.
/// @throws Cancelled
std::vector<Candidate> rank_maps(const Matching& matching, const Sites& sites, const std::vector<SampleMap>& maps,
                                 const Landmarks& reference_images, Refine refine, int threads,
                                 const Context& context = {});

/// The chance that the best is right, [0,1], by how far it is ahead of the runner-up and of what is no symmetry at all.
double confidence_of(const std::vector<Candidate>& ranking);

}  // namespace ga_symmetry
