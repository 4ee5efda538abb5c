// SPDX-License-Identifier: GPL-3.0-or-later
// The generic genetic loop and its operators, with a toy problem: find a number.
#include "search/genetic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <set>
#include <vector>

namespace ga_symmetry {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(ZScores, ByHandOverFiniteValues) {
  const std::vector<double> z = z_scores({1, 2, kInfinity, 3});
  ASSERT_EQ(z.size(), 4u);
  EXPECT_DOUBLE_EQ(z[0], -std::sqrt(1.5));  // mean 2, deviation sqrt(2/3)
  EXPECT_DOUBLE_EQ(z[1], 0);
  EXPECT_EQ(z[2], kInfinity);
  EXPECT_DOUBLE_EQ(z[3], std::sqrt(1.5));
}

TEST(ZScores, EqualValuesHaveNone) {
  for (double z : z_scores({0.1, 0.1, 0.1})) EXPECT_EQ(z, 0);  // their mean is not exactly 0.1
  for (double z : z_scores({kInfinity, kInfinity})) EXPECT_EQ(z, kInfinity);
  EXPECT_EQ(z_scores({5}), std::vector<double>{0});
  EXPECT_TRUE(z_scores({}).empty());
}

TEST(FiniteMean, LeavesOutInfinity) {
  EXPECT_DOUBLE_EQ(finite_mean({1, kInfinity, 4}), 2.5);
  EXPECT_EQ(finite_mean({kInfinity}), kInfinity);
  EXPECT_EQ(finite_mean({}), kInfinity);
}

TEST(Tournament, LowestOfTheDrawsWins) {
  const std::vector<double> costs{5, 1, 4, kInfinity, 2};
  Random random(3), replay(3);
  for (int i = 0; i < 200; ++i) {
    const int rounds = 1 + i % 4, winner = tournament(costs, rounds, random);
    double lowest = kInfinity;
    for (int k = 0; k < rounds; ++k) lowest = std::min(lowest, costs[draw_below(replay, costs.size())]);
    EXPECT_EQ(costs[winner], lowest);
  }
}

TEST(Tournament, LowerIndexWinsATie) {
  Random random(1);
  std::set<int> winners;
  for (int i = 0; i < 50; ++i) winners.insert(tournament({1, 1, 1}, 200, random));
  EXPECT_EQ(winners, std::set<int>{0});
}

TEST(Tournament, MoreRoundsSelectMoreStrictly) {
  const std::vector<double> costs{0, 1, 2, 3};
  int wins[2] = {0, 0};
  Random random(1);
  for (int i = 0; i < 4000; ++i) {
    wins[0] += tournament(costs, 1, random) == 0;
    wins[1] += tournament(costs, 3, random) == 0;
  }
  EXPECT_NEAR(wins[0] / 4000.0, 0.25, 0.05);                   // each alike
  EXPECT_NEAR(wins[1] / 4000.0, 1 - std::pow(0.75, 3), 0.05);  // unless it is never drawn
}

Population<int> of(const std::vector<int>& genomes) {
  Population<int> out;
  for (int g : genomes) out.push_back({g});
  return out;
}

TEST(Diversity, ShareOfDistinctGenomes) {
  EXPECT_DOUBLE_EQ(diversity(of({4, 4, 4, 4})), 0.25);
  EXPECT_DOUBLE_EQ(diversity(of({1, 2, 1, 3})), 0.75);
  EXPECT_DOUBLE_EQ(diversity(of({7})), 1);
}

int fittest(const Population<int>& population) {
  const std::vector<double> costs = costs_of(population);
  return static_cast<int>(std::min_element(costs.begin(), costs.end()) - costs.begin());
}

// |genome - 1000| for even genomes; odd ones are impossible. Children are their parents, a little off.
struct FindNumber {
  int target = 1000;
  bool memetic = false;
  int step = 50;
  mutable std::atomic<int> evaluations{0};

  double evaluate(int& genome, int /*worker*/) const {
    ++evaluations;
    if (memetic && genome > target) --genome;
    return genome % 2 ? kInfinity : std::abs(genome - target);
  }
  double best(const Population<int>& population) const { return costs_of(population)[fittest(population)]; }
  Population<int> vary(const Population<int>& parents, const std::vector<double>& z, Random& random) const {
    EXPECT_EQ(z, z_scores(costs_of(parents)));
    Population<int> children{parents[fittest(parents)]};
    while (children.size() < parents.size()) {
      const int parent = parents[tournament(costs_of(parents), 2, random)].genome;
      children.push_back({parent + static_cast<int>(draw_below(random, 2 * step + 1)) - step});
    }
    return children;
  }
  Population<int> replace(const Population<int>&, Population<int> children) const { return children; }
};

Population<int> start() { return of({0, 10, 20, 30, 40, 51, 62, 73, 85, 90}); }

GeneticRun<int> run(const FindNumber& problem, GeneticOptions options, std::uint64_t seed = 1) {
  Random random(seed);
  return evolve(problem, start(), options, random);
}

void expect_equal(const GeneticRun<int>& a, const GeneticRun<int>& b) {
  EXPECT_EQ(a.stop, b.stop);
  ASSERT_EQ(a.log.size(), b.log.size());
  for (std::size_t i = 0; i < a.log.size(); ++i) {
    EXPECT_EQ(a.log[i].best, b.log[i].best);
    EXPECT_EQ(a.log[i].mean, b.log[i].mean);
    EXPECT_EQ(a.log[i].diversity, b.log[i].diversity);
  }
  ASSERT_EQ(a.population.size(), b.population.size());
  for (std::size_t i = 0; i < a.population.size(); ++i) EXPECT_EQ(a.population[i].genome, b.population[i].genome);
}

TEST(Evolve, FindsTheNumberAndSaysWhyItStopped) {
  const FindNumber problem;
  GeneticOptions options;
  options.max_generations = 1000;
  const GeneticRun<int> result = run(problem, options);
  EXPECT_EQ(result.stop, StopReason::success_threshold);
  EXPECT_EQ(result.log.back().best, 0);
  bool found = false;
  for (const auto& individual : result.population) found = found || individual.genome == 1000;
  EXPECT_TRUE(found);
}

TEST(Evolve, LogHoldsEveryGenerationAndBestNeverRises) {
  const FindNumber problem;
  GeneticOptions options;
  options.max_generations = 12;
  const GeneticRun<int> result = run(problem, options);
  EXPECT_EQ(result.stop, StopReason::max_generations);
  ASSERT_EQ(result.log.size(), 13u);
  EXPECT_EQ(result.log[0].best, 910);
  EXPECT_DOUBLE_EQ(result.log[0].mean, 1000 - (0 + 10 + 20 + 30 + 40 + 62 + 90) / 7.0);  // the odd ones are infinite
  EXPECT_EQ(result.log[0].diversity, 1);
  for (std::size_t i = 0; i < result.log.size(); ++i) {
    EXPECT_EQ(result.log[i].generation, static_cast<int>(i));
    EXPECT_LE(result.log[i].best, result.log[i ? i - 1 : 0].best);
  }
  EXPECT_LT(result.log.back().best, result.log.front().best);
}

// Loses its best individual in every generation.
struct Forgetful : FindNumber {
  Population<int> vary(const Population<int>& parents, const std::vector<double>&, Random&) const {
    return Population<int>(parents.size(), {0});
  }
};

TEST(Evolve, BestIsTheBestSoFarEvenIfItIsLost) {
  const Forgetful problem;
  GeneticOptions options;
  options.stall_generations = 5;
  Random random(1);
  const GeneticRun<int> result = evolve(problem, start(), options, random);
  EXPECT_EQ(result.stop, StopReason::converged);
  ASSERT_EQ(result.log.size(), 6u);  // the initial generation and five without a lower best
  for (const GenerationLog& log : result.log) EXPECT_EQ(log.best, 910);
  EXPECT_EQ(result.log.back().mean, 1000);
  EXPECT_DOUBLE_EQ(result.log.back().diversity, 0.1);
}

TEST(Evolve, SuccessThresholdStopsAtOnce) {
  const FindNumber problem;
  GeneticOptions options;
  options.success_threshold = 910;
  const GeneticRun<int> result = run(problem, options);
  EXPECT_EQ(result.stop, StopReason::success_threshold);
  EXPECT_EQ(result.log.size(), 1u);
}

TEST(Evolve, EndsWhenItIsEnough) {
  const FindNumber problem;
  Random random(1);
  std::vector<int> asked;
  const GeneticRun<int> result =
      evolve(problem, start(), {}, random, {}, {}, {[&](int generation, const Population<int>& population) {
               EXPECT_EQ(population.size(), start().size());
               for (const auto& individual : population) EXPECT_TRUE(individual.evaluated);
               asked.push_back(generation);
               return generation == 2;
             }});
  EXPECT_EQ(asked, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(result.stop, StopReason::success_threshold);
  EXPECT_EQ(result.log.size(), 3u);
}

TEST(Evolve, NoGenerationsLeaveTheInitialOneEvaluated) {
  const FindNumber problem;
  GeneticOptions options;
  options.max_generations = 0;
  const GeneticRun<int> result = run(problem, options);
  EXPECT_EQ(result.stop, StopReason::max_generations);
  EXPECT_EQ(result.log.size(), 1u);
  for (const auto& individual : result.population) EXPECT_TRUE(individual.evaluated);
}

TEST(Evolve, EvaluatesOnlyNewIndividuals) {
  const FindNumber problem;
  GeneticOptions options;
  options.max_generations = 7;
  run(problem, options);
  EXPECT_EQ(problem.evaluations, 10 + 7 * 9);  // one is carried over
}

TEST(Evolve, EvaluationMayImproveTheGenome) {
  FindNumber problem;
  problem.memetic = true;
  problem.target = 50;
  GeneticOptions options;
  options.max_generations = 0;
  EXPECT_EQ(run(problem, options).population[5].genome, 50);  // was 51
}

TEST(Evolve, SeedDecidesAndThreadsDoNot) {
  const FindNumber problem;
  GeneticOptions options;
  options.threads = 1;
  const GeneticRun<int> one = run(problem, options, 5);
  expect_equal(one, run(problem, options, 5));
  for (int grain : {1, 3, 100}) {
    options.threads = 4;
    options.grain = grain;
    expect_equal(one, run(problem, options, 5));
  }
  const GeneticRun<int> other = run(problem, options, 6);
  EXPECT_NE(one.log[3].mean, other.log[3].mean);
}

TEST(Evolve, ObserverSeesEveryGeneration) {
  const FindNumber problem;
  GeneticOptions options;
  options.max_generations = 4;
  std::vector<int> seen;
  Random random(1);
  evolve(problem, start(), options, random, {}, [&](const GenerationLog& log) { seen.push_back(log.generation); });
  EXPECT_EQ(seen, (std::vector<int>{0, 1, 2, 3, 4}));
}

TEST(Evolve, CancelThrows) {
  const FindNumber problem;
  std::atomic<bool> cancel{false};
  Context context;
  context.cancel = &cancel;
  Random random(1);
  int generations = 0;
  EXPECT_THROW(evolve(problem, start(), GeneticOptions{}, random, context,
                      [&](const GenerationLog& log) {
                        ++generations;
                        cancel = log.generation == 2;
                      }),
               Cancelled);
  EXPECT_EQ(generations, 3);
  cancel = true;
  const int before = problem.evaluations;
  EXPECT_THROW(evolve(problem, start(), GeneticOptions{}, random, context), Cancelled);
  EXPECT_EQ(problem.evaluations, before);
}

}  // namespace
}  // namespace ga_symmetry
