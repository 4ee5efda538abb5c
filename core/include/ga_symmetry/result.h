// SPDX-License-Identifier: GPL-3.0-or-later
// What a run returns: everything that a caller would otherwise compute again.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "ga_symmetry/partners.h"

namespace ga_symmetry {

/// What a symmetry does to the surface's orientation.
enum class SymmetryKind {
  reflection,  ///< turns it over, as left and right hand
  rotation,    ///< keeps it
  any,         ///< of what is searched for, never of what is found: a reflection where one fits, else the better kind
};
/// Why a genetic search ended.
enum class StopReason {
  success_threshold,  ///< as good as the given pair, or a map that fits plainly
  converged,          ///< no better for long
  max_generations,    ///< the limit of generations was reached
};
/// As it stands in files and messages.
const char* to_string(SymmetryKind kind);
/// As it stands in files and messages.
const char* to_string(StopReason reason);

/// A point on a face of the input mesh: `weight[k]` belongs to vertex `vertex[k]`; weights >= 0, sum 1.
struct SurfacePoint {
  std::array<int, 3> vertex{-1, -1, -1};  ///< the face's corners, of the mesh; -1 = no point
  std::array<double, 3> weight{0, 0, 0};  ///< barycentric coordinates
};

/// One generation of the genetic search.
struct GenerationLog {
  int generation = 0;    ///< counted from 0
  double best = 0;       ///< lowest cost so far; never rises
  double mean = 0;       ///< mean of the finite costs of the population
  double diversity = 0;  ///< share of distinct individuals, (0,1]
};

/// A pair of evenly spaced samples found symmetric; mesh vertex indices.
struct SymmetricPair {
  int vertex = -1;     ///< of the mesh
  int partner = -1;    ///< of the mesh
  double fitness = 0;  ///< >= 0, 0 is perfect
};

/// One distinct symmetry that the search found.
struct FoundSymmetry {
  SymmetryKind kind = SymmetryKind::reflection;  ///< whether it turns the surface over
  int order = 2;     ///< applied so often it is the identity; 2 for a reflection, 0 if it does not come back
  int rank = 1;      ///< 1 for the best of its kind, as Options::rank
  double score = 0;  ///< cost at vertex resolution, >= 0, lower is better
};

/// Seconds of one stage, in the order in which the stages ran.
struct StageTime {
  std::string stage;   ///< its name
  double seconds = 0;  ///< wall clock
};

/// Result of find_symmetry. Vertex indices are those of the TriangleMesh that was given.
struct Result {
  Partners partners;                        ///< the fitness of a vertex without partner is the largest found
  std::vector<SurfacePoint> partner_point;  ///< per vertex: the partner as a point on a face (vertex -1 = none)

  SymmetryKind kind = SymmetryKind::reflection;     ///< of the symmetry found
  int order = 2;                                    ///< as in FoundSymmetry
  std::vector<SymmetricPair> pairs;                 ///< the samples and their partners
  std::vector<std::vector<SurfacePoint>> axis;      ///< polylines on the surface; a closed one repeats its first point
  std::vector<FoundSymmetry> symmetries;            ///< distinct ones of this kind, best first
  double confidence = 1;                            ///< [0,1]: the chance that the map is right
  std::vector<int> axis_references;                 ///< as used
  std::vector<std::array<int, 2>> pair_references;  ///< as used

  double mean_fitness = 0;                        ///< over vertices with a partner
  int matched = 0;                                ///< vertices with a partner
  std::vector<GenerationLog> log;                 ///< of the genetic search
  StopReason stop = StopReason::max_generations;  ///< why that ended
  std::vector<StageTime> seconds;                 ///< per stage, in order
  std::string surface;                ///< what was done inside to search the mesh, in one line; "" = nothing
  std::vector<std::string> warnings;  ///< one line each, for the user
  std::uint64_t seed = 1;             ///< as used
};

}  // namespace ga_symmetry
