// SPDX-License-Identifier: GPL-3.0-or-later
// The joint search: one individual is a partner for every sample at once.
#pragma once
#include <functional>
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/options.h"
#include "ga_symmetry/result.h"
#include "geodesics/anchors.h"
#include "search/genetic.h"
#include "search/map_cost.h"
#include "search/sample_map.h"
#include "search/seeding.h"
#include "search/variation.h"
#include "util/random.h"

namespace ga_symmetry {

/// Cost, local search, variation and replacement, put together as `evolve` asks for them.
class JointProblem {
 public:
  /// @param sites  must outlive this
  JointProblem(const Sites& sites, const Surface& surface, SymmetryKind kind, const Anchors& anchors,
               const JointOptions& options);

  const MapCost& cost() const { return cost_; }
  const JointOptions& options() const { return options_; }
  const std::vector<SitePair>& anchors() const { return anchors_; }

  /// Improves the map by local search. @return its score
  double evaluate(SampleMap& map, int worker) const;
  double best(const Population<SampleMap>& population) const;
  Population<SampleMap> vary(const Population<SampleMap>& parents, const std::vector<double>& z_errors,
                             Random& random) const;
  Population<SampleMap> replace(Population<SampleMap> parents, Population<SampleMap> children) const;

 private:
  JointOptions options_;  // a copy: callers may pass a temporary
  MapCost cost_;
  std::vector<SitePair> anchors_;
  VariationOptions variation_;
};

struct JointResult {
  std::vector<SampleMap> maps;  ///< distinct survivors, lowest score first
  std::vector<double> scores;   ///< of the maps
  std::vector<GenerationLog> log;
  StopReason stop = StopReason::max_generations;
};

/// Whether the best distinct maps so far, lowest cost first, make further generations needless.
using Enough = std::function<bool(const std::vector<SampleMap>& best)>;

/// Seeds coherent maps, evolves them, and returns the distinct survivors.
/// @param seeds   further whole maps to start from
/// @param enough  asked after 5 generations, 10, 20 and so on, but for the last; empty = never
/// @throws Cancelled
JointResult search_joint(const JointProblem& problem, Random& random, int threads, const Context& context = {},
                         std::vector<SampleMap> seeds = {}, const Enough& enough = {});

}  // namespace ga_symmetry
