// SPDX-License-Identifier: GPL-3.0-or-later
// Moves that lower the cost of a map.
#include "search/local_search.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene.h"
#include "shapes.h"

namespace ga_symmetry {
namespace {

const SearchScene& scene() { return search_scene(); }

TEST(CoordinateDescent, MovesNoFartherThanItsRadius) {
  const SampleMap before = scene().random_map(9);
  SampleMap after = before;
  coordinate_descent(scene().cost(), after, 0.1f);
  EXPECT_NE(after, before);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_LE(scene().sites.distance(before[i], after[i]), 0.1f);
}

TEST(CoordinateDescent, EverywhereMeansTheSamples) {
  SampleMap map = scene().random_map(9);
  coordinate_descent(scene().cost(), map, kEverywhere);
  const SampleMap before = scene().random_map(9);
  int changed = 0;
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (map[i] == before[i]) continue;
    ++changed;
    EXPECT_LT(map[i], scene().sites.samples);
  }
  EXPECT_GT(changed, 20);
}

TEST(CoordinateDescent, LaterSweepsGoOnFromTheFirst) {
  const MapCost cost = scene().cost();
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SampleMap once = scene().random_map(seed), often = once;
    coordinate_descent(cost, once, kNearRadius);
    coordinate_descent(cost, often, kNearRadius, 6);
    EXPECT_LT(cost.cost(often), cost.cost(once));
  }
}

// Over shapes with and without orientation, exact distances and uncertain ones, both kinds and any weights.
TEST(CoordinateDescent, NeverRaisesTheCost) {
  constexpr double kRounding = 1e-6;  // costs are below 10 and single precision
  Random random(1);
  const auto unmade = [](TriangleMesh mesh) {
    shapes::Symmetric shape;
    shape.mesh = std::move(mesh);
    return shape;
  };
  int changed = 0;
  for (const shapes::Symmetric& shape :
       {shapes::bent(shapes::creature(2), 0.1), unmade(shapes::torus(24, 16)), unmade(shapes::moebius_strip(40, 8))}) {
    SearchScene scene(shape);
    for (int round = 0; round < 40; ++round) {
      if (round == 20) {
        scene.sites.slack = Table::Constant(scene.sites.count(), scene.sites.count(), 0.05f);
        scene.sites.slack.diagonal().setZero();
      }
      JointOptions o;
      for (double* weight : {&o.distance_weight, &o.orientation_weight, &o.continuity_weight, &o.descriptor_weight,
                             &o.bijectivity_weight})
        *weight = draw_below(random, 3) ? 4 * draw_unit(random) : 0;
      const MapCost cost = scene.cost(o, round % 2 ? SymmetryKind::reflection : SymmetryKind::rotation);
      SampleMap map = scene.random_map(random);
      const float radius = round % 3 ? kNearRadius : kEverywhere;
      for (int sweep = 0; sweep < 10; ++sweep) {
        const double before = cost.cost(map);
        const int now = sweep % 3 == 2 ? relocate_outliers(cost, map, 1) : coordinate_descent(cost, map, radius);
        changed += now;
        ASSERT_LE(cost.cost(map), before + kRounding) << "round " << round << ", sweep " << sweep;
      }
    }
  }
  EXPECT_GT(changed, 1000);
}

TEST(RelocateOutliers, BringsBackAStrayGeneFromAnywhere) {
  const Sites& s = scene().sites;
  Eigen::Index far;
  s.distance.row(7).maxCoeff(&far);
  SampleMap map = scene().identity();
  map[7] = static_cast<int>(far);
  EXPECT_GE(relocate_outliers(scene().cost(without_orientation()), map, 1.96), 1);
  EXPECT_LT(s.distance(map[7], 7), 0.25f);
}

TEST(RelocateOutliers, LeavesWhatIsNone) {
  SampleMap map = scene().random_map(2);
  const SampleMap before = map;
  EXPECT_EQ(relocate_outliers(scene().cost(), map, 1e9), 0);
  EXPECT_EQ(map, before);
}

TEST(Recreate, ARegionComesBackFromWhatIsLeft) {
  const Sites& s = scene().sites;
  SampleMap map = scene().identity();
  for (int i = 0; i < s.samples; ++i)
    if (s.distance(i, 7) < 0.3f) map[i] = -1;
  const auto lost = std::count(map.begin(), map.end(), -1);
  ASSERT_GT(lost, 3);
  recreate(scene().cost(without_orientation()), map);
  double off = 0;
  for (int i = 0; i < s.samples; ++i) {
    ASSERT_GE(map[i], 0);
    off += s.distance(map[i], i) / static_cast<double>(lost);
  }
  EXPECT_LT(off, 0.2);
}

TEST(Recreate, AWholeMapIsLeftAlone) {
  SampleMap map = scene().random_map(4);
  const SampleMap before = map;
  recreate(scene().cost(), map);
  EXPECT_EQ(map, before);
}

TEST(Recreate, WithoutAKnownGeneThereIsNothingToGoBy) {
  const SampleMap unknown(scene().sites.samples, -1);
  SampleMap map = unknown;
  recreate(scene().cost(), map);
  EXPECT_EQ(map, unknown);
}

TEST(Improve, CompletesTheTruthFromHalfOfIt) {
  const Sites& s = scene().sites;
  const SampleMap truth = scene().truth();
  SampleMap map = truth;
  for (int i = 0; i < s.samples; i += 2) map[i] = -1;
  const MapCost cost = scene().cost();
  improve(cost, map, 1.96);
  EXPECT_LE(cost.cost(map), cost.cost(truth) + 1e-6);
  EXPECT_LT(map_distance(s, map, truth), 0.1);
}

}  // namespace
}  // namespace ga_symmetry
