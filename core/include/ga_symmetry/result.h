// What a run returns: everything that a caller would otherwise compute again.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "ga_symmetry/partners.h"

namespace ga_symmetry {

enum class SymmetryKind { reflection, rotation };
enum class StopReason { success_threshold, converged, max_generations };
const char* to_string(SymmetryKind kind);
const char* to_string(StopReason reason);

/// A point on a face of the input mesh: `weight[k]` belongs to vertex `vertex[k]`; weights >= 0, sum 1.
struct SurfacePoint {
  std::array<int, 3> vertex{-1, -1, -1};
  std::array<double, 3> weight{0, 0, 0};
};

/// One generation of the genetic search.
struct GenerationLog {
  int generation = 0;
  double best = 0;       ///< lowest cost so far; never rises
  double mean = 0;       ///< mean of the finite costs of the population
  double diversity = 0;  ///< share of distinct individuals, (0,1]
};

/// A pair of evenly spaced samples found symmetric; mesh vertex indices.
struct SymmetricPair {
  int vertex = -1;
  int partner = -1;
  double fitness = 0;
};

/// One distinct symmetry that the search found.
struct FoundSymmetry {
  SymmetryKind kind = SymmetryKind::reflection;
  int order = 2;     ///< applied so often it is the identity; 2 for a reflection, 0 if it does not come back
  int rank = 1;      ///< 1 for the best of its kind, as Options::rank
  double score = 0;  ///< cost at vertex resolution, >= 0, lower is better
};

/// Seconds of one stage, in the order in which the stages ran.
struct StageTime {
  std::string stage;
  double seconds = 0;
};

/// Result of find_symmetry. Vertex indices are those of the TriangleMesh that was given.
struct Result {
  Partners partners;                        ///< the fitness of a vertex without partner is the largest found
  std::vector<SurfacePoint> partner_point;  ///< per vertex: the partner as a point on a face (vertex -1 = none)

  SymmetryKind kind = SymmetryKind::reflection;
  int order = 2;
  std::vector<SymmetricPair> pairs;                 ///< the samples and their partners
  std::vector<std::vector<SurfacePoint>> axis;      ///< polylines on the surface; a closed one repeats its first point
  std::vector<FoundSymmetry> symmetries;            ///< distinct ones of this kind, best first
  double confidence = 1;                            ///< [0,1]: how far the best is ahead of the runner-up
  std::vector<int> axis_references;                 ///< as used
  std::vector<std::array<int, 2>> pair_references;  ///< as used

  double mean_fitness = 0;  ///< over vertices with a partner
  int matched = 0;          ///< vertices with a partner
  std::vector<GenerationLog> log;
  StopReason stop = StopReason::max_generations;
  std::vector<StageTime> seconds;
  std::vector<std::string> warnings;  ///< one line each, for the user
  std::uint64_t seed = 1;
};

}  // namespace ga_symmetry
