// SPDX-License-Identifier: GPL-3.0-or-later
#include "search/joint.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "search/local_search.h"

namespace ga_symmetry {

JointProblem::JointProblem(const Sites& sites, const Surface& surface, SymmetryKind kind, const Anchors& anchors,
                           const JointOptions& options)
    : options_(options),
      cost_(sites, kind, make_unary_costs(sites, surface.unit(), anchors, options),
            make_cost_weights(options, kind, surface.orientable)),
      anchors_(anchor_pairs(sites, anchors)) {
  variation_.turn_probability = options.turn_probability;
  variation_.ruin_probability = options.ruin_probability;
  variation_.mutation_probability = options.mutation_probability;
  for (const SitePair& anchor : anchors_) variation_.references.push_back(anchor.sample);
}

double JointProblem::evaluate(SampleMap& map, int /*worker*/) const {
  improve(cost_, map, options_.outlier_z);
  return cost_.score(map);
}

double JointProblem::best(const Population<SampleMap>& population) const {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& individual : population) least = std::min(least, individual.cost);
  return least;
}

Population<SampleMap> JointProblem::vary(const Population<SampleMap>& parents, const std::vector<double>& z_errors,
                                         Random& random) const {
  return ga_symmetry::vary(cost_, variation_, parents, z_errors, random);
}

Population<SampleMap> JointProblem::replace(Population<SampleMap> parents, Population<SampleMap> children) const {
  return restricted_tournament(cost_.sites(), std::move(parents), std::move(children));
}

JointResult search_joint(const JointProblem& problem, Random& random, int threads, const Context& context,
                         std::vector<SampleMap> seeds, const Enough& enough) {
  constexpr double kSeeded = 0.5;        // progress
  constexpr int kStallGenerations = 20;  // half the default number of generations; with 10 two maps of 22 stop half way
  constexpr double kDistinct = 0.04;     // units: also maps that differ in a limb alone, for the choice among them
  constexpr int kSurvivors = 30;         // as many as `rank` may ask for
  constexpr int kAsked = 5;          // whether it is enough after so many generations, and again after twice as many
  constexpr std::size_t kShown = 3;  // maps to be judged by
  constexpr double kDistinctAsked = 0.1;  // units between them: more than a limb
  const JointOptions& options = problem.options();
  const Sites& sites = problem.cost().sites();
  Population<SampleMap> population =
      seed_population(problem.cost(), {seed_pairs(problem.cost(), problem.anchors()), std::move(seeds)},
                      options.population, options.outlier_z, threads, context.part(0, kSeeded));
  GeneticOptions genetic;
  genetic.max_generations = options.max_generations;
  genetic.stall_generations = kStallGenerations;
  genetic.threads = threads;
  const auto tell = [&](const GenerationLog& log) {
    context.report(kSeeded + (1 - kSeeded) * log.generation / std::max(1, options.max_generations), "search");
  };
  int next = kAsked;
  const auto asked = [&](int generation, const Population<SampleMap>& present) {
    if (!enough || generation < next || generation >= options.max_generations) return false;
    next *= 2;
    Population<SampleMap> now = present;
    sort_by_cost(now);
    std::vector<SampleMap> best;
    for (auto& individual : distinct(sites, now, kDistinctAsked, kShown)) best.push_back(std::move(individual.genome));
    return enough(best);
  };
  GeneticRun<SampleMap> run = evolve(problem, std::move(population), genetic, random, context, {tell}, {asked});
  JointResult result;
  result.log = std::move(run.log);
  result.stop = run.stop;
  sort_by_cost(run.population);
  for (auto& survivor : distinct(sites, run.population, kDistinct, kSurvivors)) {
    if (!std::isfinite(survivor.cost)) continue;
    result.maps.push_back(std::move(survivor.genome));
    result.scores.push_back(survivor.cost);
  }
  return result;
}

}  // namespace ga_symmetry
