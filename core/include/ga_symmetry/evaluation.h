// SPDX-License-Identifier: GPL-3.0-or-later
// How good a partner map is, where the truth is known.
#pragma once
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/mesh.h"
#include "ga_symmetry/partners.h"

namespace ga_symmetry {

/// Lines {v, w}: the true partner of vertex v is vertex w. A vertex may be missing or listed more than once.
using Truth = std::vector<std::array<int, 2>>;

/// Lengths are over sqrt(area) of the whole mesh. The error of a truth line {v, w} is the geodesic distance from w to
/// v's partner; it is 1 where v has no partner or the partner cannot be reached.
struct Evaluation {
  double mean = 1;            ///< mean error
  double corr = 0;            ///< share of lines with an error below correspondence_radius
  double coverage = 0;        ///< share of vertices with a partner
  double involution = 0;      ///< share of vertices whose partner's partner is nearer than correspondence_radius
  std::size_t lines = 0;      ///< truth lines measured
  std::vector<int> vertex;    ///< per line measured: its v
  std::vector<double> error;  ///< per line measured
};

/// sqrt(1 / (20 pi)). Source: Kim, Lipman, Chen, Funkhouser, Moebius transformations for global intrinsic symmetry
/// analysis, 2010.
extern const double correspondence_radius;

/// Measures about 1000 truth lines and 200 vertices, evenly spread.
///
/// Distances are not GeodesicSolver's, which the methods measured here work with, but those of plain first-order fast
/// marching (Kimmel & Sethian 1998, without splitting obtuse triangles): figures of different programs can be compared
/// only by one definition, and this is the usual one. It overestimates short distances, so means are up to 8 % higher
/// than by more exact ones.
/// @param mesh      of the truth and of the maps
/// @param truth     not empty
/// @param partners  maps, each per vertex: its partner, -1 = none. The work is nearly the same for many as for one
/// @param threads   0 = all cores; never changes the figures
/// @param context   progress and cancelling
/// @return one for each map
/// @throws InvalidMesh    if a triangle names a vertex that does not exist
/// @throws InvalidOption  if the truth is empty, or it or a partner is out of range
/// @throws Cancelled
std::vector<Evaluation> evaluate_partners(const TriangleMesh& mesh, const Truth& truth,
                                          const std::vector<std::vector<int>>& partners, int threads = 0,
                                          const Context& context = {});
/// Of one map.
Evaluation evaluate_partners(const TriangleMesh& mesh, const Truth& truth, const std::vector<int>& partner,
                             int threads = 0);

/// Reads lines `v w`, 0-based. @throws FileError
Truth read_truth(const std::string& path);

}  // namespace ga_symmetry
