// SPDX-License-Identifier: GPL-3.0-or-later
// The genetic loop that both searches share, and the operators that do not depend on what a genome is.
#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/errors.h"
#include "ga_symmetry/result.h"
#include "util/parallel.h"
#include "util/random.h"

namespace ga_symmetry {

template <class Genome>
struct Individual {
  Genome genome;
  double cost = std::numeric_limits<double>::infinity();  ///< >= 0, or +inf = impossible
  bool evaluated = false;                                 ///< a copy that keeps its cost is not evaluated again
};
template <class Genome>
using Population = std::vector<Individual<Genome>>;

struct GeneticOptions {
  int max_generations = 100;     ///< generations after the initial one, >= 0
  int stall_generations = 30;    ///< converged after so many generations without a lower best, >= 1
  double success_threshold = 0;  ///< success when the best is at or below, >= 0
  int threads = 0;               ///< 0 = all cores; speed only, never results
  int grain = 1;                 ///< individuals that a thread takes at a time, >= 1: more where evaluation is cheap
};

template <class Genome>
struct GeneticRun {
  Population<Genome> population;   ///< the last one, evaluated
  std::vector<GenerationLog> log;  ///< initial population first
  StopReason stop = StopReason::max_generations;
};

template <class Genome>
std::vector<double> costs_of(const Population<Genome>& population) {
  std::vector<double> costs;
  costs.reserve(population.size());
  for (const auto& individual : population) costs.push_back(individual.cost);
  return costs;
}

/// Mean of the finite values; +inf if there is none.
inline double finite_mean(const std::vector<double>& values) {
  double sum = 0;
  int count = 0;
  for (double x : values)
    if (std::isfinite(x)) sum += x, ++count;
  return count ? sum / count : std::numeric_limits<double>::infinity();
}

/// (value - mean) / standard deviation over the finite values (population formula); 0 where they are all equal, +inf
/// for a value that is not finite.
inline std::vector<double> z_scores(const std::vector<double>& values) {
  const double mean = finite_mean(values);
  std::vector<double> squares;
  for (double x : values) squares.push_back((x - mean) * (x - mean));
  double deviation = std::sqrt(finite_mean(squares));
  if (deviation <= 1e-12 * std::abs(mean)) deviation = 0;  // rounding of the mean of equal values
  std::vector<double> z;
  for (double x : values)
    z.push_back(!std::isfinite(x) ? std::numeric_limits<double>::infinity()
                : deviation > 0   ? (x - mean) / deviation
                                  : 0);
  return z;
}

/// Index of the lowest cost among `rounds` >= 1 draws with replacement; the lower index wins a tie.
inline int tournament(const std::vector<double>& costs, int rounds, Random& random) {
  int best = static_cast<int>(draw_below(random, costs.size()));
  for (int i = 1; i < rounds; ++i) {
    const int other = static_cast<int>(draw_below(random, costs.size()));
    if (std::make_pair(costs[other], other) < std::make_pair(costs[best], best)) best = other;
  }
  return best;
}

/// Share of distinct genomes, (0,1].
template <class Genome>
double diversity(const Population<Genome>& population) {
  std::vector<const Genome*> genomes;
  for (const auto& individual : population) genomes.push_back(&individual.genome);
  std::sort(genomes.begin(), genomes.end(), [](const Genome* a, const Genome* b) { return *a < *b; });
  const auto end = std::unique(genomes.begin(), genomes.end(),
                               [](const Genome* a, const Genome* b) { return !(*a < *b) && !(*b < *a); });
  return static_cast<double>(end - genomes.begin()) / static_cast<double>(population.size());
}

/// Evaluates the individuals that are new, in parallel, each into its own slot. @throws Cancelled
template <class Problem, class Genome>
void evaluate(const Problem& problem, Population<Genome>& population, const GeneticOptions& options,
              const Context& context) {
  std::vector<Individual<Genome>*> fresh;
  for (auto& individual : population)
    if (!individual.evaluated) fresh.push_back(&individual);
  const int count = static_cast<int>(fresh.size());
  parallel_blocks(count, options.grain, options.threads, [&](int begin, int end, int worker) {
    if (context.cancelled()) throw Cancelled();
    for (int i = begin; i < end; ++i) {
      fresh[i]->cost = problem.evaluate(fresh[i]->genome, worker);
      fresh[i]->evaluated = true;
    }
  });
}

/// Runs generations until one is successful, nothing improves any more, or their number is used up. `problem` offers
///   double evaluate(Genome&, int worker) const
///     the cost; may improve the genome first (memetic). In parallel, so it depends on nothing but the genome.
///   double best(const Population<Genome>&) const
///     what the run minimises, e.g. the lowest cost.
///   Population<Genome> vary(const Population<Genome>&, const std::vector<double>& z_errors, Random&) const
///     the children: selection, crossover, mutation. Serial, hence the one engine.
///   Population<Genome> replace(Population<Genome> parents, Population<Genome> children) const
///     the next generation, out of both, all evaluated.
/// Genomes are ordered by <, for the diversity.
/// @param initial  not empty
/// @param observe  called after every generation, the initial one included; may be empty
/// @param enough  asked after every generation, the initial one included, whether it is the last; may be empty
/// @throws Cancelled
template <class Problem, class Genome>
GeneticRun<Genome> evolve(const Problem& problem, Population<Genome> initial, const GeneticOptions& options,
                          Random& random, const Context& context = {},
                          const std::function<void(const GenerationLog&)>& observe = {},
                          const std::function<bool(int generation, const Population<Genome>&)>& enough = {}) {
  GeneticRun<Genome> run;
  run.population = std::move(initial);
  evaluate(problem, run.population, options, context);
  double best = std::numeric_limits<double>::infinity();
  for (int generation = 0, improved = 0;; ++generation) {
    const double now = problem.best(run.population);
    if (now < best) best = now, improved = generation;
    const std::vector<double> costs = costs_of(run.population);
    run.log.push_back({generation, best, finite_mean(costs), diversity(run.population)});
    if (observe) observe(run.log.back());
    if (context.cancelled()) throw Cancelled();
    std::optional<StopReason> stop;
    if (best <= options.success_threshold || (enough && enough(generation, run.population)))
      stop = StopReason::success_threshold;
    else if (generation >= options.max_generations)
      stop = StopReason::max_generations;
    else if (generation - improved >= options.stall_generations)
      stop = StopReason::converged;
    if (stop) {
      run.stop = *stop;
      return run;
    }
    Population<Genome> children = problem.vary(run.population, z_scores(costs), random);
    evaluate(problem, children, options, context);
    run.population = problem.replace(std::move(run.population), std::move(children));
  }
}

}  // namespace ga_symmetry
