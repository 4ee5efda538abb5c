// SPDX-License-Identifier: GPL-3.0-or-later
// Where the first population comes from.
#include "search/seeding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "ga_symmetry/errors.h"
#include "scene.h"
#include "search/local_search.h"

namespace ga_symmetry {
namespace {

const SearchScene& scene() { return search_scene(); }

TEST(AnchorPairs, AreTheNearestSampleAndSite) {
  const Sites& s = scene().sites;
  // From a sample to a site: both are found again. From any vertex: nothing is nearer.
  const SurfaceReferences references{{}, {{s.vertex[7], s.vertex[90]}, scene().references().pairs[0]}};
  const Anchors anchors = make_anchors(references, SymmetryKind::rotation, scene().solver, 1);
  const std::vector<SitePair> pairs = anchor_pairs(s, anchors);
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[0], (SitePair{7, 90}));
  EXPECT_LT(pairs[1].sample, s.samples);
  for (int k = 0; k < s.count(); ++k) {
    EXPECT_LE(anchors.image.field(1, s.vertex[pairs[1].site]), anchors.image.field(1, s.vertex[k]));
    if (k < s.samples) {
      EXPECT_LE(anchors.from.field(1, s.vertex[pairs[1].sample]), anchors.from.field(1, s.vertex[k]));
    }
  }
}

TEST(SeedPairs, AnchorsThenTipsThenWhatIsAlike) {
  const Sites& s = scene().sites;
  const std::vector<SitePair> anchors{{3, 100}, {4, 4}};
  const std::vector<SitePair> pairs = seed_pairs(scene().cost(), anchors);
  ASSERT_GE(pairs.size(), 120u);
  EXPECT_EQ(pairs[0], (SitePair{3, s.nearest_sample[100]}));
  EXPECT_EQ(pairs[1], anchors[1]);
  EXPECT_EQ(pairs[2], (SitePair{s.extremal[0], s.extremal[0]}));
  for (const SitePair& p : pairs) {
    EXPECT_LT(p.sample, s.samples);
    EXPECT_LT(p.site, s.samples);
  }
}

TEST(SeedPairs, ARotationTakesTipsBothWays) {
  const Sites& s = scene().sites;
  const std::vector<SitePair> pairs = seed_pairs(scene().cost({}, SymmetryKind::rotation), {});
  const auto has = [&](int a, int b) { return std::count(pairs.begin(), pairs.end(), SitePair{a, b}) > 0; };
  int both = 0;
  for (std::size_t a = 0; a < s.extremal.size(); ++a)
    for (std::size_t b = a + 1; b < s.extremal.size(); ++b) {
      EXPECT_EQ(has(s.extremal[a], s.extremal[b]), has(s.extremal[b], s.extremal[a]));
      both += has(s.extremal[a], s.extremal[b]);
    }
  EXPECT_GT(both, 0);
}

TEST(SeedPopulation, DistinctWholeMapsBestFirst) {
  const Sites& s = scene().sites;
  const MapCost cost = scene().cost();
  const auto seeds = seed_population(cost, {seed_pairs(cost, {}), {}}, 12, 1.96, 1);
  ASSERT_GT(seeds.size(), 3u);
  ASSERT_LE(seeds.size(), 12u);
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    EXPECT_TRUE(seeds[i].evaluated);
    EXPECT_EQ(seeds[i].cost, cost.score(seeds[i].genome));
    for (int site : seeds[i].genome) EXPECT_GE(site, 0);
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GE(map_distance(s, seeds[i].genome, seeds[j].genome), 0.02);
      EXPECT_LE(seeds[j].cost, seeds[i].cost);
    }
  }
  const auto threaded = seed_population(cost, {seed_pairs(cost, {}), {}}, 12, 1.96, 4);
  ASSERT_EQ(threaded.size(), seeds.size());
  for (std::size_t i = 0; i < seeds.size(); ++i) EXPECT_EQ(threaded[i].genome, seeds[i].genome);
}

TEST(SeedPopulation, AFurtherWholeMapCompetesWithThePolarOnes) {
  const Sites& s = scene().sites;
  const MapCost cost = scene().cost();
  const SampleMap truth = scene().truth();
  // Alone, it is improved like them.
  const auto alone = seed_population(cost, {{}, {truth}}, 12, 1.96, 1);
  ASSERT_EQ(alone.size(), 1u);
  EXPECT_TRUE(alone[0].evaluated);
  EXPECT_EQ(alone[0].cost, cost.score(alone[0].genome));
  EXPECT_LT(map_distance(s, alone[0].genome, truth), 0.1);
  // Twice, it counts once.
  EXPECT_EQ(seed_population(cost, {{}, {truth, truth}}, 12, 1.96, 1).size(), 1u);
  // Among polar maps that are all far off, it comes first.
  const std::vector<SitePair> wrong{{s.extremal[0], s.extremal.back()}};
  const auto without = seed_population(cost, {wrong, {}}, 12, 1.96, 1);
  const auto with = seed_population(cost, {wrong, {truth}}, 12, 1.96, 1);
  ASSERT_FALSE(without.empty());
  EXPECT_GT(map_distance(s, without[0].genome, truth), 0.1);
  EXPECT_LT(map_distance(s, with[0].genome, truth), 0.1);
  EXPECT_LT(with[0].cost, without[0].cost);
}

TEST(SeedPopulation, Cancel) {
  const std::atomic<bool> cancel{true};
  const MapCost cost = scene().cost();
  EXPECT_THROW(seed_population(cost, {seed_pairs(cost, {}), {}}, 12, 1.96, 1, {nullptr, &cancel}), Cancelled);
}

}  // namespace
}  // namespace ga_symmetry
