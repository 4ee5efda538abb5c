// SPDX-License-Identifier: GPL-3.0-or-later
#include "search/polar_map.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene.h"

namespace ga_symmetry {
namespace {

const SearchScene& scene() { return search_scene(); }

TEST(PolarMap, TakesItsSampleToItsSiteAndTheRestAlong) {
  const Sites& s = scene().sites;
  const SampleMap truth = scene().truth();
  const MapCost cost = scene().cost();
  const int p = s.extremal.front(), q = s.nearest_sample[truth[p]];
  double nearest = 1;
  for (int a = 0; a < 24; ++a) {
    const SampleMap map = polar_map(cost, {p, q}, a * 0.2618);
    EXPECT_EQ(map[p], q);
    for (int site : map) EXPECT_LT(site, s.samples);
    nearest = std::min(nearest, map_distance(s, map, truth));
  }
  EXPECT_LT(nearest, 0.25) << "one of the angles is about right";
}

TEST(PolarMap, ARotationByNothingIsTheIdentity) {
  const Sites& s = scene().sites;
  const SampleMap map = polar_map(scene().cost({}, SymmetryKind::rotation), {5, 5}, 0);
  EXPECT_EQ(map, scene().identity());
  EXPECT_GT(map_distance(s, polar_map(scene().cost(), {5, 5}, 0), map), 0.05) << "a reflection is not";
}

}  // namespace
}  // namespace ga_symmetry
