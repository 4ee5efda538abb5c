// Moves that lower the cost of a map.
#include "search/local_search.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene.h"
#include "shapes.h"

namespace ga_symmetry {
namespace {

const SearchScene& scene() { return creature_scene(); }

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
  for (std::size_t i = 0; i < map.size(); ++i)
    if (map[i] != before[i]) ++changed, EXPECT_LT(map[i], scene().sites.samples);
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
