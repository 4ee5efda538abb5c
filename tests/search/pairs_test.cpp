// SPDX-License-Identifier: GPL-3.0-or-later
// The paper's search: every operator alone, then the laws of the whole.
#include "search/pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <set>
#include <string>

#include "ga_symmetry/errors.h"
#include "shapes.h"
#include "symmetric_shapes.h"

namespace ga_symmetry {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(PairFitness, ByHand) {
  // |1 - 2| / 2 = 1/2 and |6 - 4| / 4 = 1/2
  EXPECT_DOUBLE_EQ(pair_fitness({1, 6}, {2, 4}, PairError::linear), 1.0);
  EXPECT_DOUBLE_EQ(pair_fitness({1, 6}, {2, 4}, PairError::squared), 0.5);
  // The right one divides: |2 - 1| / 1 = 1 and |4 - 6| / 6 = 1/3
  EXPECT_DOUBLE_EQ(pair_fitness({2, 4}, {1, 6}, PairError::linear), 4.0 / 3);
  EXPECT_DOUBLE_EQ(pair_fitness({2, 4}, {1, 6}, PairError::squared), 10.0 / 9);
}

TEST(PairFitness, EqualDistancesArePerfectAndAZeroIsImpossible) {
  for (PairError error : {PairError::linear, PairError::squared}) {
    EXPECT_EQ(pair_fitness({3, 7}, {3, 7}, error), 0);
    EXPECT_EQ(pair_fitness({0, 7}, {0, 7}, error), kInfinity);
    EXPECT_EQ(pair_fitness({3, 1}, {3, 0}, error), kInfinity);
    EXPECT_DOUBLE_EQ(pair_fitness({0, 0}, {3, 7}, error), 2);
    EXPECT_DOUBLE_EQ(pair_fitness({1, 2}, {4, 8}, error), pair_fitness({0.5, 1}, {2, 4}, error));  // no unit
  }
}

TEST(Regions, EqualCountsInTheOrderOfDistance) {
  Random random(1);
  for (int n : {1, 2, 5, 23, 100}) {
    std::vector<float> distance;
    for (int i = 0; i < n; ++i) distance.push_back(static_cast<float>(draw_below(random, 40)));  // with ties
    for (int count : {1, 2, 5, 8, 100}) {
      if (count > n) continue;
      const std::vector<int> region = make_regions(distance, count);
      std::vector<int> members(count, 0);
      for (int r : region) ++members.at(r);
      const auto [fewest, most] = std::minmax_element(members.begin(), members.end());
      EXPECT_LE(*most - *fewest, 1);
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          if (std::make_pair(distance[i], i) < std::make_pair(distance[j], j)) {
            ASSERT_LE(region[i], region[j]);
          }
    }
  }
}

TEST(Regions, ByHand) { EXPECT_EQ(make_regions({9, 1, 5, 3, 7}, 2), (std::vector<int>{1, 0, 0, 0, 1})); }

// 6 x 6 samples on either side: sample 6 i + j has the distances i + 1 and j + 1, so 3 regions per axis point hold two
// of the six distances each.
struct Lattice {
  std::vector<AxisDistances> samples;
  RegionTable table;
  Lattice() {
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) samples.push_back({i + 1.0f, j + 1.0f});
    table = make_region_table(samples, samples, 3);
  }
};

TEST(RegionTable, EverySampleInItsCell) {
  const Lattice lattice;
  for (int s = 0; s < 36; ++s) {
    const int r0 = s / 6 / 2, r1 = s % 6 / 2;
    EXPECT_EQ(lattice.table.right[0][s], r0);
    EXPECT_EQ(lattice.table.left[1][s], r1);
    const auto holds = [&](const std::vector<int>& set) { return std::count(set.begin(), set.end(), s); };
    EXPECT_EQ(holds(lattice.table.cells[3 * r0 + r1]), 1);
    EXPECT_EQ(holds(lattice.table.members[0][r0]), 1);
    EXPECT_EQ(holds(lattice.table.members[1][r1]), 1);
  }
  for (const auto& cell : lattice.table.cells) EXPECT_EQ(cell.size(), 4u);
}

TEST(Crossover, MovesOneRegionTowardsTheReferenceForEachAxisPoint) {
  const Lattice lattice;
  Random random(1);
  for (int left = 0; left < 36; ++left)
    for (int right = 0; right < 36; ++right) {
      std::set<int> drawn;
      for (int i = 0; i < 60; ++i) {
        const Pair child = crossover({left, right}, lattice.table, random);
        EXPECT_EQ(child.left, left);
        drawn.insert(child.right);
        for (int k = 0; k < 2; ++k) {
          const int from = lattice.table.right[k][right], to = lattice.table.left[k][left];
          const int expected = from < to ? from + 1 : from > to ? from - 1 : from;
          ASSERT_EQ(lattice.table.right[k][child.right], expected) << left << " " << right;
        }
      }
      EXPECT_EQ(drawn.size(), 4u);  // any sample of the new region, not one and the same
    }
}

TEST(Crossover, TakesTheRegionOfOneAxisPointWhereBothShareNone) {
  // The right samples lie on the diagonal, so the cell (0,1) is empty.
  const std::vector<AxisDistances> left{{1, 4}, {2, 3}, {3, 2}, {4, 1}}, right{{1, 1}, {2, 2}, {3, 3}, {4, 4}};
  const RegionTable table = make_region_table(left, right, 2);
  ASSERT_TRUE(table.cells[0 * 2 + 1].empty());
  Random random(1);
  std::set<int> drawn;
  for (int i = 0; i < 200; ++i) drawn.insert(crossover({0, 0}, table, random).right);
  EXPECT_EQ(drawn, (std::set<int>{0, 1, 2, 3}));  // region 0 of a0 or region 1 of a1
}

TEST(Mutation, AnyRightSampleAndNothingElse) {
  Random random(1);
  std::vector<int> drawn(7, 0);
  for (int i = 0; i < 7000; ++i) {
    const Pair child = mutate({3, 5}, 7, random);
    EXPECT_EQ(child.left, 3);
    ++drawn.at(child.right);
  }
  for (int count : drawn) EXPECT_NEAR(count, 1000, 150);  // five standard deviations
}

PairOperator choose(double z, double probability, Random& random) {
  PairsOptions options;
  options.mutation_probability = probability;
  return choose_operator(z, options, random);
}

TEST(ChooseOperator, ByZError) {
  Random random(1);
  for (double probability : {0.0, 0.01, 1.0}) {
    EXPECT_EQ(choose(1.97, probability, random), PairOperator::mutation);
    EXPECT_EQ(choose(kInfinity, probability, random), PairOperator::mutation);
    EXPECT_EQ(choose(-1.97, probability, random), PairOperator::keep);
  }
  for (double z : {-1.96, 0.0, 1.96}) {  // the thresholds themselves are neither
    EXPECT_EQ(choose(z, 0, random), PairOperator::crossover);
    EXPECT_EQ(choose(z, 1, random), PairOperator::mutation);
  }
}

TEST(ChooseOperator, MutatesWithTheGivenProbability) {
  Random random(1);
  int mutations = 0;
  for (int i = 0; i < 10000; ++i) mutations += choose(0, 0.2, random) == PairOperator::mutation;
  EXPECT_NEAR(mutations, 2000, 200);  // five standard deviations
}

// A surface with everything that depends on it alone. It keeps the mesh's vertex numbers.
struct Scene {
  Surface surface;
  GeodesicSolver solver;
  std::array<int, 2> axis, pair;

  Scene(const TriangleMesh& mesh, const std::array<int, 2>& a, const std::array<int, 2>& p)
      : surface(make_surface(mesh)), solver(surface), axis(a), pair(p) {}
  explicit Scene(const shapes::Symmetric& shape) : Scene(shape.mesh, shape.axis, shape.pair) {}

  PairsResult search(const PairsOptions& options = {}, std::uint64_t seed = 1, int threads = 1,
                     const Context& context = {}) const {
    Random random(seed);
    return search_pairs(surface, solver, {axis, pair}, options, random, threads, context);
  }
  DistanceFields fields() const { return solver.fields({axis[0], axis[1], pair[0], pair[1]}, 1); }
};

shapes::Symmetric posed_creature() { return shapes::shuffled(shapes::bent(shapes::creature(3), 0.1), 11); }

/// The naive search of the paper's table 1: for every left sample the right sample of the lowest fitness.
double exhaustive_best(const Scene& scene, const PairsResult& result, PairError error) {
  const DistanceFields fields = scene.fields();
  const auto distances = [&](int v) { return AxisDistances{fields(0, v), fields(1, v)}; };
  double sum = 0;
  for (int l : result.left_samples) {
    double lowest = kInfinity;
    for (int r : result.right_samples) lowest = std::min(lowest, pair_fitness(distances(l), distances(r), error));
    sum += lowest;
  }
  return sum / static_cast<double>(result.left_samples.size());
}

void expect_complete(const Scene& scene, const PairsResult& result) {
  const int n = scene.surface.vertices();
  ASSERT_EQ(static_cast<int>(result.partner.size()), n);
  ASSERT_EQ(static_cast<int>(result.fitness.size()), n);
  ASSERT_EQ(static_cast<int>(result.side.size()), n);
  for (int v = 0; v < n; ++v) {
    ASSERT_GE(result.partner[v], 0);
    ASSERT_LT(result.partner[v], n);
    EXPECT_EQ(result.side[result.partner[v]], -result.side[v]);
    EXPECT_TRUE(std::isfinite(result.fitness[v]) && result.fitness[v] >= 0);
    EXPECT_EQ(result.side[v] == 0, result.partner[v] == v);
  }
  EXPECT_EQ(result.left_samples.size(), result.right_samples.size());
  EXPECT_FALSE(result.pairs.empty());
  const auto all_on = [&](const std::vector<int>& samples, int side) {
    return std::all_of(samples.begin(), samples.end(), [&](int v) { return result.side[v] == side; }) &&
           std::set<int>(samples.begin(), samples.end()).size() == samples.size();
  };
  EXPECT_TRUE(all_on(result.left_samples, 1));
  EXPECT_TRUE(all_on(result.right_samples, -1));
}

void expect_equal(const PairsResult& a, const PairsResult& b) {
  EXPECT_EQ(a.partner, b.partner);
  EXPECT_EQ(a.fitness, b.fitness);
  EXPECT_EQ(a.side, b.side);
  EXPECT_EQ(a.left_samples, b.left_samples);
  EXPECT_EQ(a.stop, b.stop);
  ASSERT_EQ(a.log.size(), b.log.size());
  for (std::size_t i = 0; i < a.log.size(); ++i) {
    EXPECT_EQ(a.log[i].best, b.log[i].best);
    EXPECT_EQ(a.log[i].mean, b.log[i].mean);
  }
}

TEST(SplitSides, OppositeForTruePartnersAndThroughTheAxisPoints) {
  for (double curvature : {1e-9, 0.1}) {
    const shapes::Symmetric shape = shapes::shuffled(shapes::bent(shapes::creature(3), curvature), 5);
    const Scene scene(shape);
    const std::vector<int> side = split_sides(scene.surface, scene.fields(), shape.axis, shape.pair);
    EXPECT_EQ(side[shape.pair[0]], 1);
    EXPECT_EQ(side[shape.pair[1]], -1);
    EXPECT_EQ(side[shape.axis[0]], 0);
    EXPECT_EQ(side[shape.axis[1]], 0);
    int wrong = 0, left = 0, right = 0;
    for (int v = 0; v < scene.surface.vertices(); ++v) {
      wrong += side[v] * side[shape.partner[v]] > 0;
      left += side[v] > 0, right += side[v] < 0;
    }
    // Bent, lengths differ by up to a fifth from side to side: a strip along the axis may go either way.
    EXPECT_LE(wrong, curvature < 1e-3 ? 0 : scene.surface.vertices() / 10);
    EXPECT_NEAR(left, right, 0.1 * scene.surface.vertices());
  }
}

TEST(SplitSides, BalancesAReferencePairThatIsOff) {
  shapes::Symmetric shape = shapes::shuffled(shapes::creature(3), 5);
  const Scene honest(shape);
  const DistanceFields fields = honest.fields();
  const double unit = honest.surface.unit();
  for (int v = 0; v < honest.surface.vertices(); ++v)  // the farthest towards l, within 0.3 of the true r
    if (fields(3, v) < 0.3 * unit && fields(2, v) < fields(2, shape.pair[1])) shape.pair[1] = v;
  const Scene scene(shape);
  ASSERT_GT(scene.fields()(3, honest.pair[1]), 0.2 * unit);
  const std::vector<int> side = split_sides(scene.surface, scene.fields(), shape.axis, shape.pair);
  int wrong = 0;
  for (int v = 0; v < scene.surface.vertices(); ++v) wrong += side[v] * side[shape.partner[v]] > 0;
  EXPECT_LE(wrong, scene.surface.vertices() / 8);  // nearly half without the balance
}

TEST(SplitSides, NoEdgeJoinsBothSides) {
  const shapes::Symmetric shape = posed_creature();
  const Scene scene(shape);
  const std::vector<int> side = split_sides(scene.surface, scene.fields(), shape.axis, shape.pair);
  for (int c = 0; c < static_cast<int>(scene.surface.triangle.size()); ++c)
    EXPECT_GE(side[scene.surface.triangle[c]] * side[scene.surface.triangle[next_corner(c)]], 0);
}

TEST(SearchPairs, APartnerForEveryVertexCloseToTheTruth) {
  const shapes::Symmetric shape = posed_creature();
  const Scene scene(shape);
  for (Sampling sampling : {Sampling::evenly_spaced, Sampling::uniform})
    for (PairError error : {PairError::squared, PairError::linear}) {
      PairsOptions options;
      options.sampling = sampling;
      options.error = error;
      options.samples = 300;
      const PairsResult result = scene.search(options);
      expect_complete(scene, result);
      const DistanceFields all = scene.solver.fields(shape.partner, 2);
      double sum = 0;
      for (int v = 0; v < scene.surface.vertices(); ++v) sum += all(v, result.partner[v]);
      // What two axis points leave open, a few edges of this mesh; a random vertex of the other side is 1.3 away.
      EXPECT_LT(sum / scene.surface.vertices() / scene.surface.unit(), 0.15);
    }
}

TEST(SearchPairs, NeverBeatsTheExhaustiveSearchAndComesClose) {
  const Scene scene(shapes::shuffled(shapes::creature(3), 11));  // its pair is exact, so that success stops nothing
  for (PairError error : {PairError::squared, PairError::linear}) {
    PairsOptions options;
    options.error = error;
    options.samples = 200;
    const PairsResult result = scene.search(options);
    const double optimum = exhaustive_best(scene, result, error);
    EXPECT_GE(result.log.back().best, optimum * (1 - 1e-12));  // sums in the same order, of the same terms
    // What is left is at the borders of regions: ranks on both sides differ there, and only mutation crosses them.
    EXPECT_LT(result.log.back().best - optimum, 0.1 * (result.log.front().best - optimum));
  }
}

TEST(SearchPairs, BestNeverRisesAndPairsAreWhatItCounts) {
  const Scene scene(posed_creature());
  PairsOptions options;
  options.outlier_z = 1e9;  // no pair is left out
  const PairsResult result = scene.search(options);
  for (std::size_t i = 1; i < result.log.size(); ++i) EXPECT_LE(result.log[i].best, result.log[i - 1].best);
  ASSERT_EQ(result.pairs.size(), result.left_samples.size());
  double sum = 0;
  for (const SymmetricPair& p : result.pairs) {
    EXPECT_EQ(result.side[p.vertex], 1);
    EXPECT_EQ(result.side[p.partner], -1);
    sum += p.fitness;
  }
  EXPECT_NEAR(sum / static_cast<double>(result.pairs.size()), result.log.back().best, 1e-12);
}

TEST(SearchPairs, OutliersAreLeftOut) {
  const Scene scene(posed_creature());
  PairsOptions options;
  options.max_generations = 1;  // leaves bad pairs
  const std::size_t few = scene.search(options).pairs.size();
  options.outlier_z = 1e9;
  EXPECT_LT(few, scene.search(options).pairs.size());
  options.outlier_z = 0;  // the strictest that there is still leaves the pairs better than the mean
  const PairsResult strict = scene.search(options);
  expect_complete(scene, strict);
  EXPECT_LT(strict.pairs.size(), few);
}

TEST(SearchPairs, SeedDecidesAndThreadsDoNot) {
  const Scene scene(posed_creature());
  for (Sampling sampling : {Sampling::evenly_spaced, Sampling::uniform}) {
    PairsOptions options;
    options.sampling = sampling;
    const PairsResult one = scene.search(options, 3, 1);
    expect_equal(one, scene.search(options, 3, 1));
    expect_equal(one, scene.search(options, 3, 4));
    EXPECT_NE(one.log[2].mean, scene.search(options, 4, 1).log[2].mean);
  }
}

TEST(SearchPairs, PlaceAndScaleMakeNoDifference) {
  const shapes::Symmetric shape = posed_creature();
  const PairsResult one = Scene(shape).search();
  for (double scale : {1.0, 1e-3, 1e6}) {
    const PairsResult other = Scene(shapes::moved(shape.mesh, scale), shape.axis, shape.pair).search();
    // Rotation rounds coordinates anew, and distances are single precision: ties may fall the other way.
    int same = 0;
    for (std::size_t v = 0; v < one.partner.size(); ++v) same += one.side[v] == other.side[v];
    EXPECT_GT(same, 0.99 * one.partner.size());
    EXPECT_NEAR(other.log.back().best, one.log.back().best, 0.3 * one.log.back().best);
  }
  // A power of two rounds nothing.
  const PairsResult doubled = Scene(shapes::scaled(shape.mesh, 4), shape.axis, shape.pair).search();
  expect_equal(one, doubled);
}

TEST(SearchPairs, RenumberingPermutesTheAnswer) {
  const shapes::Symmetric shape = posed_creature();
  const std::vector<int> to = shapes::random_permutation(shape.mesh.vertices(), 21);
  const PairsResult one = Scene(shape).search(), other = Scene(shapes::renumbered(shape, to)).search();
  int same_side = 0, same_partner = 0;
  for (std::size_t v = 0; v < to.size(); ++v) {
    same_side += other.side[to[v]] == one.side[v];
    same_partner += other.partner[to[v]] == to[one.partner[v]];
  }
  // Distances are single precision and differ in the last place with the order of the faces.
  EXPECT_GE(same_side, 0.99 * to.size());
  EXPECT_GE(same_partner, 0.9 * to.size());
}

TEST(SearchPairs, StopsAtTheFitnessOfTheReferencePair) {
  shapes::Symmetric shape = posed_creature();
  // A pair that is not quite symmetric asks for less than the best.
  const Scene honest(shape);
  const DistanceFields fields = honest.fields();
  const auto misfit = [&](int v) {
    const int l = shape.pair[0];
    const double fitness = pair_fitness({fields(0, l), fields(1, l)}, {fields(0, v), fields(1, v)}, PairError::squared);
    return std::abs(fitness - 0.03);
  };
  for (int v = 0; v < honest.surface.vertices(); ++v)
    if (fields(3, v) < fields(3, shape.pair[0]) / 3 && misfit(v) < misfit(shape.pair[1])) shape.pair[1] = v;
  const PairsResult result = Scene(shape).search();
  EXPECT_EQ(result.stop, StopReason::success_threshold);
  EXPECT_LE(result.log.back().best, result.success_threshold);
  ASSERT_GT(result.log.size(), 1u);
  EXPECT_GT(result.log[result.log.size() - 2].best, result.success_threshold);
  EXPECT_LT(result.log.size(), 300u);
  // A perfect pair asks for perfection, which samples do not have.
  const PairsResult perfect = Scene(shapes::creature(3)).search();
  EXPECT_LT(perfect.success_threshold, 1e-6);
  EXPECT_NE(perfect.stop, StopReason::success_threshold);
}

TEST(SearchPairs, StopsAfterTheLastGeneration) {
  const Scene scene(posed_creature());
  PairsOptions options;
  options.max_generations = 3;
  const PairsResult result = scene.search(options);
  EXPECT_EQ(result.stop, StopReason::max_generations);
  EXPECT_EQ(result.log.size(), 4u);
}

TEST(SearchPairs, FewerVerticesThanSamples) {
  const TriangleMesh small = shapes::icosphere(1);  // 42 vertices
  PairsOptions options;
  options.samples = 20000;
  options.individuals = 1;
  options.regions = 100;
  const int top = shapes::nearest_vertex(small, 0, 0, 1), bottom = shapes::nearest_vertex(small, 0, 0, -1);
  const int left = shapes::nearest_vertex(small, 1, 0, 0), right = shapes::nearest_vertex(small, -1, 0, 0);
  const Scene scene(small, {top, bottom}, {left, right});
  const PairsResult result = scene.search(options);
  expect_complete(scene, result);
  EXPECT_GE(result.left_samples.size(), 10u);
}

TEST(SearchPairs, EveryTopologyAndAnyReferences) {
  const TriangleMesh meshes[] = {shapes::torus(30, 12), shapes::grid(12, 15), shapes::moebius_strip(40, 5),
                                 shapes::icosphere(2),  shapes::sphere(3, 6), shapes::grid(2, 10)};
  for (const TriangleMesh& mesh : meshes) {
    Random random(7);
    for (int round = 0; round < 20; ++round) {
      const std::vector<int> any = shapes::random_permutation(mesh.vertices(), random());
      const Scene scene(mesh, {any[0], any[1]}, {any[2], any[3]});
      PairsOptions options;
      options.max_generations = 20;
      options.sampling = round % 2 ? Sampling::uniform : Sampling::evenly_spaced;
      expect_complete(scene, scene.search(options));
    }
  }
}

TEST(SearchPairs, RefusesBadReferences) {
  const shapes::Symmetric shape = shapes::creature(2);
  const int n = shape.mesh.vertices();
  const auto refuses = [&](std::array<int, 2> axis, std::array<int, 2> pair) {
    EXPECT_THROW(Scene(shape.mesh, axis, pair).search(), InvalidOption);
  };
  refuses({1, 1}, {2, 3});
  refuses({1, 2}, {2, 3});
  refuses({1, 2}, {3, 3});
  refuses({1, n}, {2, 3});
  refuses({1, 2}, {-1, 3});
}

TEST(SearchPairs, ReportsProgressAndCancelThrows) {
  const Scene scene(posed_creature());
  Context context;
  std::vector<double> fractions;
  context.progress = [&](double fraction, const char*) { fractions.push_back(fraction); };
  scene.search({}, 1, 2, context);
  ASSERT_GT(fractions.size(), 3u);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.front(), 0);
  EXPECT_EQ(fractions.back(), 1);

  std::atomic<bool> cancel{false};
  context.cancel = &cancel;
  for (double at : {0.0, 0.1, 0.3, 0.8}) {
    cancel = false;
    context.progress = [&](double fraction, const char*) {
      if (fraction >= at) cancel = true;
    };
    EXPECT_THROW(scene.search({}, 1, 2, context), Cancelled) << at;
  }
}

}  // namespace
}  // namespace ga_symmetry
