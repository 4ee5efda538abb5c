// SPDX-License-Identifier: GPL-3.0-or-later
// How long the paper's genetic algorithm and its rivals take to find pairs of samples: the paper's table 1 and
// figure 2.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "search/pairs.h"

namespace ga_symmetry::comparison {

/// The samples of a mesh, and the fitness of the reference pair: what the paper's algorithm starts from.
struct PairsScene {
  PairSamples samples;
  std::array<AxisDistances, 2> reference_pair;  ///< of l and r
};
/// @param count  samples on both sides together; fewer where a side has fewer vertices
/// @throws InvalidMesh, InvalidOption, Cancelled
PairsScene make_pairs_scene(const TriangleMesh& mesh, const References& references, int count, int threads,
                            const Context& context);

/// One run of evolve_pairs, generation by generation.
struct Evolution {
  std::vector<GenerationLog> log;
  std::vector<double> seconds;  ///< processor time since the start, at the end of each generation
  StopReason stop = StopReason::max_generations;
};
Evolution watch_pairs(const PairSamples& samples, const PairsOptions& options, double success_threshold,
                      std::uint64_t seed, const Context& context);

/// First generation from which on the best is within 5 % of the whole fall to the last; the log is not empty.
int convergence_generation(const std::vector<GenerationLog>& log);

/// One search, on one thread, stopped at a quality.
struct Duration {
  std::string search;      ///< naive, kdtree, scan or genetic
  double quality = 0;      ///< asked for: mean fitness over the optimum's, less 1; 0 = the optimum itself
  bool reached = true;     ///< else stopped at the limit of generations
  double seconds = 0;      ///< processor time of the search alone: distances and samples are the same for all
  double evaluations = 0;  ///< pairs whose fitness was computed, at most; 0 = not known
  int generations = 0;     ///< genetic only
  double fitness = 0;      ///< mean reached
};

/// All searches in turn on the same samples. `naive` and `kdtree` find the optimum. `scan` is the naive search made as
/// lazy as the genetic one: candidates in random order for all references at once, stopped as soon as their mean
/// reaches the quality. `genetic` runs up to 1000 generations with the given options.
std::vector<Duration> measure_durations(const PairSamples& samples, const PairsOptions& options, std::uint64_t seed,
                                        const Context& context);

/// Qualities at which scan and genetic are stopped.
constexpr double kQualities[] = {1.0, 0.5, 0.05};

}  // namespace ga_symmetry::comparison
