// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of the sites.
#include "search/sites.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "scene.h"

namespace ga_symmetry {
namespace {

TEST(Directions, AnglesBetweenSourcesAreThoseOfThePlane) {
  const Surface s = make_surface(shapes::grid(41, 41));
  const GeodesicSolver solver(s);
  const std::vector<int> sources{41 * 5 + 5, 41 * 5 + 35, 41 * 33 + 22};
  const int center = 41 * 20 + 20;
  const auto [cosine, sine] = directions(s, {center}, solver.fields(sources, 1), 1);
  const auto angle = [&](int j) {
    const double x = s.point(sources[j])[0] - s.point(center)[0], y = s.point(sources[j])[1] - s.point(center)[1];
    return std::atan2(y, x);
  };
  for (int j = 1; j < 3; ++j) {
    const double found = std::atan2(sine(0, j), cosine(0, j)) - std::atan2(sine(0, 0), cosine(0, 0));
    EXPECT_GT(std::cos(found - (angle(j) - angle(0))), std::cos(0.06));
  }
}

TEST(Sites, TablesAreConsistent) {
  const Sites& s = search_scene().sites;
  EXPECT_EQ(s.count(), 120);
  EXPECT_TRUE(s.distance == s.distance.transpose());
  for (int i = 0; i < s.samples; ++i) {
    EXPECT_EQ(s.nearest_sample[i], i);
    for (int j = 0; j < s.samples; ++j)
      EXPECT_EQ(std::count(s.neighbors[i].begin(), s.neighbors[i].end(), j),
                std::count(s.observers[j].begin(), s.observers[j].end(), i));
    for (std::size_t k = 1; k < s.neighbors[i].size(); ++k)
      EXPECT_LE(s.distance(i, s.neighbors[i][k - 1]), s.distance(i, s.neighbors[i][k]));
  }
  for (int k = 0; k < s.count(); ++k)
    for (int j = 0; j < s.count(); ++j) EXPECT_NEAR(std::hypot(s.cosine(k, j), s.sine(k, j)), k == j ? 0 : 1, 1e-4);
}

TEST(Sites, NearAreAllWithinTheRadiusNearestFirst) {
  const Sites& s = search_scene().sites;
  for (int k = 0; k < s.count(); ++k) {
    const std::vector<int>& near = s.near[k];
    ASSERT_FALSE(near.empty());
    EXPECT_EQ(near[0], k);
    const std::set<int> members(near.begin(), near.end());
    EXPECT_EQ(members.size(), near.size());
    for (int j = 0; j < s.count(); ++j) EXPECT_EQ(members.count(j) > 0, s.distance(k, j) <= kNearRadius);
    EXPECT_TRUE(
        std::is_sorted(near.begin(), near.end(), [&](int a, int b) { return s.distance(k, a) < s.distance(k, b); }));
  }
}

TEST(Sites, ExtremalSamplesAreTipsFarthestFirstAndTheCenterLast) {
  const Sites& s = search_scene().sites;
  ASSERT_GT(s.extremal.size(), 1u);
  const auto average = [&](int i) { return s.average_distance[i]; };
  EXPECT_EQ(s.extremal.front(), std::max_element(s.average_distance.begin(), s.average_distance.begin() + s.samples) -
                                    s.average_distance.begin());
  for (int i = 0; i < s.samples; ++i) EXPECT_GE(average(i), average(s.extremal.back()));
  for (std::size_t t = 1; t < s.extremal.size(); ++t) EXPECT_GE(average(s.extremal[t - 1]), average(s.extremal[t]));
}

TEST(Coarsened, HoldsTheFirstSites) {
  const Sites& fine = search_scene().sites;
  const Sites coarse = coarsened(fine, 15, 40);
  EXPECT_EQ(coarse.samples, 15);
  ASSERT_EQ(coarse.count(), 40);
  EXPECT_TRUE(coarse.distance == fine.distance.topLeftCorner(40, 40));
  for (int nearest : coarse.nearest_sample) EXPECT_LT(nearest, 15);
  for (const auto& neighbors : coarse.neighbors)
    for (int j : neighbors) EXPECT_LT(j, 15);
}

}  // namespace
}  // namespace ga_symmetry
