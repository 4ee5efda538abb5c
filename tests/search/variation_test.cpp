// SPDX-License-Identifier: GPL-3.0-or-later
// Every operator of the joint search alone.
#include "search/variation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "scene.h"
#include "search/polar_map.h"

namespace ga_symmetry {
namespace {

const SearchScene& scene() { return search_scene(); }

Population<SampleMap> random_parents(int count) {
  Population<SampleMap> parents;
  for (int seed = 1; seed <= count; ++seed) parents.push_back({scene().random_map(seed), 1.0 * seed, true});
  return parents;
}

Population<SampleMap> vary_once(const VariationOptions& options, const Population<SampleMap>& parents) {
  Random random(5);
  return vary(scene().cost(), options, parents, z_scores(costs_of(parents)), random);
}

TEST(Disc, AnyCenterAndRadiusOfItsRange) {
  Random random(1);
  std::set<int> centers;
  float least = 9, most = 0;
  for (int i = 0; i < 1000; ++i) {
    const Disc disc = draw_disc(scene().sites, random);
    centers.insert(disc.center);
    least = std::min(least, disc.radius), most = std::max(most, disc.radius);
  }
  EXPECT_EQ(static_cast<int>(centers.size()), scene().sites.samples);
  EXPECT_GE(least, 0.15f);
  EXPECT_LT(least, 0.2f);
  EXPECT_GT(most, 0.95f);
  EXPECT_LE(most, 1);
}

TEST(DiscCrossover, TakesTheDiscFromTheMateAndNothingElse) {
  const Sites& s = scene().sites;
  const SampleMap map = scene().random_map(1), mate = scene().random_map(2);
  const SampleMap child = disc_crossover(s, map, mate, {7, 0.4f}), ruined = ruin(s, map, {7, 0.4f});
  for (int i = 0; i < s.samples; ++i) {
    const bool inside = s.distance(7, i) <= 0.4f;
    EXPECT_EQ(child[i], inside ? mate[i] : map[i]);
    EXPECT_EQ(ruined[i], inside ? -1 : map[i]);
  }
  EXPECT_NE(child, map);
  EXPECT_NE(child, mate);
}

TEST(TurnDisc, IsThePolarMapInsideAndNothingElse) {
  const Sites& s = scene().sites;
  const MapCost cost = scene().cost();
  const SampleMap map = scene().truth();
  const Disc disc{7, 0.4f};
  const int image = s.nearest_sample[map[7]];
  const SampleMap polar = polar_map(cost, {7, image}, 2), turned = turn_disc(cost, map, disc, 2);
  for (int i = 0; i < s.samples; ++i) EXPECT_EQ(turned[i], s.distance(7, i) <= disc.radius ? polar[i] : map[i]);
  EXPECT_NE(turned, turn_disc(cost, map, disc, 4));
}

TEST(TurnDisc, TheLastTurnIsTheOneThatCounts) {
  const MapCost cost = scene().cost();
  const SampleMap map = scene().truth();
  const Disc disc{scene().sites.extremal.front(), 0.5f};
  EXPECT_EQ(turn_disc(cost, turn_disc(cost, map, disc, 1), disc, 2), turn_disc(cost, map, disc, 2));
}

TEST(Vary, TurnsAsOftenAsItsProbability) {
  // All parents are alike, so that crossover changes nothing.
  const Population<SampleMap> parents(200, {scene().truth(), 1.0, true});
  VariationOptions options;
  options.turn_probability = 0.25;
  EXPECT_NEAR(static_cast<double>(vary_once(options, parents).size()), 50, 31);  // five standard deviations
}

TEST(RegionCrossover, GoesToTheRegionOfTheReferencesDistanceAndStays) {
  const Sites& s = scene().sites;
  constexpr int kSample = 7, kReference = 3, kRegions = 5;
  const auto rank = [&](float distance) {
    int nearer = 0;
    for (int k = 0; k < s.count(); ++k) nearer += s.distance(kReference, k) < distance;
    return nearer;
  };
  const auto region = [&](int site) { return rank(s.distance(kReference, site)) * kRegions / s.count(); };
  const int wanted = region(kSample);
  SampleMap map = scene().identity();
  Random random(2);
  std::set<int> seen;
  for (int start = 0; start < s.count(); ++start) {
    map[kSample] = start;
    for (int step = 0; step < kRegions; ++step) {
      const int before = std::abs(region(map[kSample]) - wanted);
      map[kSample] = region_crossover(s, map, kSample, kReference, random);
      EXPECT_EQ(std::abs(region(map[kSample]) - wanted), std::max(0, before - 1));
    }
    seen.insert(map[kSample]);
  }
  EXPECT_GT(seen.size(), 10U) << "any site of the region may be drawn";
}

TEST(MutateGenes, AsOftenAsItsProbability) {
  VariationOptions options;
  options.mutation_probability = 0.25;
  Random random(5);
  const SampleMap unknown(scene().sites.samples, -1);
  int changed = 0;
  for (int i = 0; i < 100; ++i) {
    SampleMap map = unknown;  // so that every mutation shows
    mutate_genes(scene().sites, options, map, random);
    changed += static_cast<int>(std::count_if(map.begin(), map.end(), [](int site) { return site >= 0; }));
  }
  EXPECT_NEAR(changed, 1000, 140);  // of 4000; five standard deviations
}

TEST(MutateGenes, ReachesEverySite) {
  VariationOptions options;
  options.mutation_probability = 1;
  Random random(5);
  std::set<int> seen;
  for (int i = 0; i < 100; ++i) {
    SampleMap map = scene().random_map(1);
    mutate_genes(scene().sites, options, map, random);
    seen.insert(map.begin(), map.end());
  }
  EXPECT_EQ(static_cast<int>(seen.size()), scene().sites.count());
}

TEST(Vary, RuinLeavesHalfOfTheGenes) {
  VariationOptions options;
  options.ruin_probability = 1;
  const auto children = vary_once(options, random_parents(40));
  ASSERT_FALSE(children.empty());
  for (const auto& child : children) {
    const auto lost = std::count(child.genome.begin(), child.genome.end(), -1);
    EXPECT_GT(lost, 0);
    EXPECT_LE(lost, scene().sites.samples / 2);
    EXPECT_FALSE(child.evaluated);
  }
}

TEST(Vary, ChildrenAreMadeOfTheirParents) {
  const Population<SampleMap> parents = random_parents(4);
  const auto children = vary_once({}, parents);
  ASSERT_FALSE(children.empty());
  for (const auto& child : children)
    for (std::size_t i = 0; i < child.genome.size(); ++i)
      EXPECT_TRUE(std::any_of(parents.begin(), parents.end(),
                              [&](const auto& parent) { return parent.genome[i] == child.genome[i]; }));
}

TEST(Vary, AChildLikeItsParentIsLeftOut) {
  EXPECT_TRUE(vary_once({}, Population<SampleMap>(10, {scene().random_map(1), 1.0, true})).empty());
}

TEST(RestrictedTournament, AChildCompetesWithTheOneMostLikeIt) {
  const SampleMap a = scene().random_map(1), b = scene().random_map(2);
  SampleMap like_b = b;
  like_b[0] = like_b[0] == 0 ? 1 : 0;
  const auto compete = [&](double cost) {
    return restricted_tournament(scene().sites, {{a, 3, true}, {b, 1, true}}, {{like_b, cost, true}});
  };
  EXPECT_EQ(compete(2)[0].genome, a) << "the worst stays: it is another niche";
  EXPECT_EQ(compete(2)[1].genome, b);
  EXPECT_EQ(compete(0.5)[0].genome, a);
  EXPECT_EQ(compete(0.5)[1].genome, like_b);
  EXPECT_EQ(compete(std::numeric_limits<double>::infinity())[1].genome, b);
}

}  // namespace
}  // namespace ga_symmetry
