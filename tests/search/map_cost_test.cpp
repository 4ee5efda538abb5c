// SPDX-License-Identifier: GPL-3.0-or-later
// The cost of a map, term by term, and of one gene of it.
#include "search/map_cost.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene.h"

namespace ga_symmetry {
namespace {

const SearchScene& scene() { return search_scene(); }

TEST(MapCost, TheIdentityKeepsDistancesButNotOrientation) {
  const CostTerms t = scene().cost().terms(scene().identity());
  EXPECT_EQ(t.distance, 0);
  EXPECT_EQ(t.continuity, 0);
  EXPECT_EQ(t.bijectivity, 0);
  EXPECT_GT(t.orientation, 0.3);
  // Turned by nothing it is a rotation.
  EXPECT_LT(scene().cost({}, SymmetryKind::rotation).terms(scene().identity()).orientation, 1e-3);
}

TEST(MapCost, TheTruthCostsLittleInEveryTerm) {
  const MapCost cost = scene().cost();
  const CostTerms good = cost.terms(scene().truth()), bad = cost.terms(scene().random_map(1));
  EXPECT_LT(good.distance, 0.2 * bad.distance);
  EXPECT_LT(good.orientation, 0.5 * bad.orientation);
  EXPECT_LT(good.continuity, 0.3 * bad.continuity);
  EXPECT_LT(good.unary, 0.5 * bad.unary);
  EXPECT_LT(good.bijectivity, 0.2 * bad.bijectivity);
}

TEST(MapCost, IsTheWeightedSumOfItsTerms) {
  JointOptions o;
  o.distance_weight = 2, o.orientation_weight = 3, o.continuity_weight = 5, o.bijectivity_weight = 7;
  const CostTerms t{0.1, 0.2, 0.3, 0.4, 0.5};
  EXPECT_DOUBLE_EQ(scene().cost(o).total(t), 0.2 + 0.6 + 1.5 + 0.4 + 3.5);
}

TEST(MapCost, WeighsOnlyWhatTheSurfaceAndTheSymmetryHave) {
  const CostWeights all = make_cost_weights({}, SymmetryKind::reflection, true);
  EXPECT_GT(all.orientation, 0);
  EXPECT_GT(all.bijectivity, 0);
  EXPECT_EQ(make_cost_weights({}, SymmetryKind::reflection, false).orientation, 0);
  EXPECT_EQ(make_cost_weights({}, SymmetryKind::rotation, true).bijectivity, 0);
}

TEST(MapCost, ReferencesPullTheirSamplesToTheirImages) {
  JointOptions without;
  without.reference_weight = 0;
  const SampleMap map = scene().random_map(3);
  const auto unary = [&](const JointOptions& o) {
    return scene().cost(o, SymmetryKind::reflection, scene().references()).terms(map).unary;
  };
  EXPECT_GT(unary({}), unary(without));
}

TEST(MapCost, OverTheFirstSitesIsThatOfTheFirstSamples) {
  const Sites& fine = scene().sites;
  const MapCost cost = scene().cost();
  const Sites all = coarsened(fine, fine.samples, fine.count()), few = coarsened(fine, 15, 40);
  const SampleMap map = scene().random_map(2);
  EXPECT_EQ(MapCost(cost, all).cost(map), cost.cost(map));
  SampleMap first(15);
  for (int i = 0; i < 15; ++i) first[i] = 39 - i;
  double unary = 0;
  for (int i = 0; i < 15; ++i) unary += cost.unary()(i, first[i]);
  EXPECT_DOUBLE_EQ(MapCost(cost, few).terms(first).unary, unary / 15);
}

TEST(Score, TheIdentityIsNoSymmetry) {
  const MapCost cost = scene().cost(without_orientation());
  EXPECT_TRUE(std::isinf(cost.score(scene().identity())));
  EXPECT_EQ(moved_share(scene().sites, scene().identity()), 0);
  const SampleMap map = scene().random_map(1);
  EXPECT_GE(cost.score(map), cost.cost(map));
}

TEST(Score, PrefersOfTwoEquallyCostlyMapsTheOneThatMovesMore) {
  JointOptions nothing;
  nothing.distance_weight = nothing.orientation_weight = nothing.continuity_weight = nothing.bijectivity_weight = 0;
  nothing.descriptor_weight = 0;
  const MapCost cost(scene().sites, SymmetryKind::reflection, Table::Ones(40, 120),
                     make_cost_weights(nothing, SymmetryKind::reflection, true));
  const SampleMap all = scene().random_map(1);
  SampleMap half = all;
  for (int i = 0; i < 20; ++i) half[i] = i;
  EXPECT_EQ(cost.cost(half), cost.cost(all));
  EXPECT_LT(cost.score(all), cost.score(half));
}

TEST(DistanceError, ByHand) {
  const float a[] = {1, 2, 3}, b[] = {1.1f, 4, 3}, slack[] = {0.02f, 0.5f, 1}, weight[] = {2, 0.01f, 1};
  EXPECT_NEAR(distance_error(a, b, nullptr, nullptr, weight, 3), 2 * 0.01 + 0.01 * 4, 1e-6);
  EXPECT_NEAR(distance_error(a, b, slack, slack, weight, 3), 2 * 0.06 * 0.06 + 0.01 * 1, 1e-6);
  const float heavy[] = {2, 10, 1};
  EXPECT_NEAR(distance_error(a, b, nullptr, nullptr, heavy, 3), 2 * 0.01 + 0.25, 1e-6) << "capped";
}

// Gene by gene and site by site, the difference is that of the whole map's cost.
TEST(GeneCost, DiffersAsTheWholeMapsCostDoes) {
  Random random(1);
  for (SymmetryKind kind : {SymmetryKind::reflection, SymmetryKind::rotation})
    for (int term = 0; term < 5; ++term) {
      SCOPED_TRACE(term);
      JointOptions o;
      o.distance_weight = term == 0, o.orientation_weight = term == 1, o.continuity_weight = term == 2;
      o.bijectivity_weight = term == 3, o.descriptor_weight = term == 4;
      const MapCost cost = scene().cost(o, kind);
      SampleMap map = scene().random_map(random);
      GeneCost gene(cost, map);
      for (int round = 0; round < 60; ++round) {
        gene.look_at(static_cast<int>(draw_below(random, map.size())));
        const double whole = cost.cost(map), part = gene.cost(gene.site());
        const int site = static_cast<int>(draw_below(random, scene().sites.count()));
        const double change = (gene.cost(site) - part) / static_cast<double>(map.size());
        if (round % 3 == 0) gene.set(site);
        SampleMap other = map;
        other[gene.gene()] = site;
        EXPECT_NEAR(cost.cost(other) - whole, change, 1e-6);
      }
    }
}

TEST(GeneCost, TheGuessIsAtLeastTheLimitWhereItStops) {
  const MapCost cost = scene().cost();
  SampleMap map = scene().random_map(1);
  GeneCost gene(cost, map);
  gene.look_at(5);
  for (int k = 0; k < scene().sites.count(); ++k) {
    const float whole = gene.guess(k);
    EXPECT_EQ(gene.guess(k, whole * 2), whole);
    EXPECT_GE(gene.guess(k, whole / 2), whole / 2);
  }
}

}  // namespace
}  // namespace ga_symmetry
