// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/refinement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "matching/scene.h"
#include "surface/neighbors.h"

namespace ga_symmetry {
namespace {

const Matching& matching() {
  static const Matching made = creature_scene().matching(60);
  return made;
}

// All images off the truth in the same sense around the body: by four edges, each the one that climbs most.
const Images& pushed() {
  static const Images made = [] {
    const Surface& surface = creature_scene().surface;
    std::vector<int> vertices = creature_scene().truth(matching().landmarks).vertex;
    for (int& image : vertices)
      for (int step = 0; step < 4; ++step) {
        int best = image;
        for_each_neighbor(surface, image, [&](int w) {
          if (surface.point(w)[2] > surface.point(best)[2]) best = w;
        });
        image = best;
      }
    return creature_scene().images(vertices);
  }();
  return made;
}

double error(const Images& images) {
  double total = 0;
  for (int i = 0; i < matching().count(); ++i)
    total += images.field(i, creature_scene().shape.partner[matching().landmarks.vertex[i]]);
  return total / matching().count() / creature_scene().surface.unit();
}

Images adjusted(const AdjustOptions& options, int threads = 1) {
  return adjust_images(matching(), pushed(), options, threads);
}

TEST(AdjustImages, BringsImagesHomeThatAreAllOffTheSameWay) {
  ASSERT_GT(error(pushed()), 0.08);
  EXPECT_LT(error(adjusted({})), 0.25 * error(pushed()));
}

TEST(AdjustImages, LowersTheStressWithEveryFurtherStep) {
  const double start = image_stress(matching(), pushed(), 0);
  double before = start;
  for (int steps : {1, 2, 4, 8}) {
    AdjustOptions options;
    options.steps = steps;
    const double now = image_stress(matching(), adjusted(options), 0);
    EXPECT_LE(now, before);
    before = now;
  }
  EXPECT_LT(before, 0.1 * start);
}

TEST(AdjustImages, FieldsAreThoseOfTheImages) {
  const Images out = adjusted({});
  EXPECT_TRUE(out.field == creature_scene().solver.fields(out.vertex, 1));
}

TEST(AdjustImages, FixedImagesStay) {
  Matching fixed = matching();
  fixed.fixed = 20;
  const std::vector<int> to = adjust_images(fixed, pushed(), {}, 1).vertex, &start = pushed().vertex;
  EXPECT_TRUE(std::equal(to.end() - 20, to.end(), start.end() - 20));
  EXPECT_FALSE(std::equal(to.begin(), to.end() - 20, start.begin()));
}

TEST(AdjustImages, ThreadsChangeNothing) { EXPECT_EQ(adjusted({}, 1).vertex, adjusted({}, 4).vertex); }

TEST(AdjustImages, NoStepsLeaveEverything) {
  AdjustOptions options;
  options.steps = 0;
  EXPECT_EQ(adjusted(options).vertex, pushed().vertex);
}

TEST(RefineImages, KeepsThePerfectImages) {
  const Images truth = creature_scene().truth(matching().landmarks);
  EXPECT_EQ(refine_images(matching(), truth, 1).vertex, truth.vertex);
}

TEST(RefineImages, BringsASingleImageHomeAndItsField) {
  Images off = creature_scene().truth(matching().landmarks);
  const int home = off.vertex[30];
  off.vertex[30] = pushed().vertex[30];
  ASSERT_NE(off.vertex[30], home);
  off.field = creature_scene().solver.fields(off.vertex, 1);
  const Images out = refine_images(matching(), off, 1);
  EXPECT_EQ(out.vertex[30], home);
  EXPECT_TRUE(out.field == creature_scene().solver.fields(out.vertex, 1));
  Matching fixed = matching();
  fixed.fixed = matching().count();
  EXPECT_EQ(refine_images(fixed, off, 1).vertex, off.vertex);
}

TEST(MatchProbes, FindTheTruePartnersOfVerticesThatAreNoLandmarks) {
  const MatchingScene& s = creature_scene();
  const Images truth = s.truth(matching().landmarks);
  std::vector<int> vertices;
  for (int v = 0; v < s.surface.vertices(); v += 11) vertices.push_back(v);
  const Probes probes = match_probes(matching(), truth, vertices);
  ASSERT_EQ(probes.partner.size(), vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    EXPECT_EQ(probes.partner[i], s.shape.partner[vertices[i]]) << vertices[i];
    EXPECT_LT(probes.error[i], 1e-6);
  }
}

TEST(MatchProbes, ErrorsTellAWrongMap) {
  const MatchingScene& s = creature_scene();
  // Head and tail stay, left and right are exchanged for most landmarks, but an arm is not.
  Images wrong = s.truth(matching().landmarks);
  const DistanceFields arm = s.solver.fields({s.shape.pair[0]}, 1);
  for (int i = 0; i < matching().count(); ++i)
    if (arm(0, matching().landmarks.vertex[i]) < 0.5 * s.surface.unit())
      wrong.vertex[i] = matching().landmarks.vertex[i];
  wrong.field = s.solver.fields(wrong.vertex, 1);
  const std::vector<int> probe{s.shape.pair[0]};
  EXPECT_GT(match_probes(matching(), wrong, probe).error[0], 0.01);
  EXPECT_LT(match_probes(matching(), s.truth(matching().landmarks), probe).error[0], 1e-6);
}

}  // namespace
}  // namespace ga_symmetry
