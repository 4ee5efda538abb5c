// SPDX-License-Identifier: GPL-3.0-or-later
// Everything that the joint search looks up about the sites it may choose from: tables, no geometry in its loops.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "ga_symmetry/context.h"
#include "geodesics/sampling.h"
#include "geodesics/shortcuts.h"
#include "surface/surface.h"
#include "surface/tangent_plane.h"

namespace ga_symmetry {

/// Radius, in units, in which local search looks for a better site: two to three times what lies between samples, if
/// they are a hundred. Maps that are farther off come from seeds, mates and `recreate`.
constexpr float kNearRadius = 0.25f;

/// Evenly spaced sites; the first `samples` of them are the genes' own points, all are candidates for partners.
/// Lengths are divided by the surface's unit.
struct Sites {
  int samples = 0;
  std::vector<int> vertex;  ///< per site
  DistanceFields field;     ///< sites x vertices, unit of the surface
  Table distance;           ///< sites x sites, symmetric; where parts are missing, the middle of what it may be
  Table slack;              ///< sites x sites: how much the distance may differ from that; empty = nowhere
  Table cosine, sine;       ///< sites x sites: direction at the row's site towards the column's, in its tangent plane
  Table descriptor;         ///< sites x features, each scaled to standard deviation 1
  std::vector<float> average_distance;      ///< per site: average geodesic distance to the surface
  std::vector<int> nearest_sample;          ///< per site
  std::vector<int> nearest;                 ///< per vertex: its nearest site
  std::vector<std::vector<int>> neighbors;  ///< per sample: its nearest samples, nearest first
  std::vector<std::vector<int>> observers;  ///< per sample: the samples that have it among their neighbors
  std::vector<std::vector<int>> near;       ///< per site: the sites within kNearRadius, itself first, nearest first
  std::vector<int> extremal;  ///< samples where the average distance has a local maximum (tips, farthest first), and
                              ///< its minimum

  int count() const { return static_cast<int>(vertex.size()); }
};

/// How far a map moves a point, [0,1): near 1 where its partner is plainly not itself. Any shape is its own identity,
/// so agreement is evidence only where points are moved. @param squared_distance  from point to partner, in units^2
inline double moved_share(double squared_distance) {
  constexpr double kPlainly = 0.01;  // a tenth of a unit: between neighbouring samples
  return squared_distance / (squared_distance + kPlainly);
}

/// How many; fewer where the surface has fewer vertices.
struct SiteCounts {
  int samples = 0;    ///< >= 2
  int sites = 0;      ///< >= samples
  int neighbors = 0;  ///< of a sample, >= 1
};

/// @throws Cancelled
/// Extremal points of the average geodesic distance: Kim et al. 2010.
Sites make_sites(const Surface& surface, const GeodesicSolver& solver, const SiteCounts& counts, int threads,
                 const Shortcuts& shortcuts = {}, const Context& context = {});

/// The first of the sites alone, with their distances and directions but without fields, descriptors and tips.
Sites coarsened(const Sites& fine, int samples, int sites);

}  // namespace ga_symmetry
