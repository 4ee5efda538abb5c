// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/features.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "matching/scene.h"

namespace ga_symmetry {
namespace {

TEST(Trust, IsFullWhereImagesAreRight) {
  const Matching matching = creature_scene().matching(40);
  const Features features = make_tight_features(matching, creature_scene().truth(matching.landmarks), 1);
  ASSERT_EQ(static_cast<int>(features.trust.size()), features.distances);
  EXPECT_GT(*std::min_element(features.trust.begin(), features.trust.end()), 0.95f);
}

TEST(Trust, IsLostByALandmarkThatGoesElsewhereAndByNoOther) {
  Matching matching = creature_scene().matching(40);
  std::vector<int> images = creature_scene().truth(matching.landmarks).vertex;
  constexpr int kLost = 7;
  Eigen::Index farthest;
  creature_scene().solver.fields({images[kLost]}, 1).row(0).maxCoeff(&farthest);
  images[kLost] = static_cast<int>(farthest);
  for (const int fixed : {0, 40 - kLost}) {  // as a sample, then as a reference
    matching.fixed = fixed;
    const Features features = make_tight_features(matching, creature_scene().images(images), 1);
    for (int i = 0; i < matching.count(); ++i) {
      const float trust = features.trust[i];
      if (i == kLost && fixed == 0)
        EXPECT_LT(trust, 0.2f);
      else
        EXPECT_GT(trust, 0.8f) << i;
      EXPECT_EQ(features.trust[matching.count() + i], trust) << "both directions of a reflection";
    }
  }
}

}  // namespace
}  // namespace ga_symmetry
