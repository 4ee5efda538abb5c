// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/dense_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "ga_symmetry/errors.h"
#include "matching/matcher.h"
#include "matching/scene.h"

namespace ga_symmetry {
namespace {

// The upper half of the creature: open, and mirrored still.
shapes::Symmetric open_creature() {
  shapes::Symmetric shape = shapes::creature(4);
  std::vector<int> kept;
  for (int f = 0; f < shape.mesh.triangles(); ++f) {
    double height = 0;
    for (int k = 0; k < 3; ++k) height += shape.mesh.position[3 * shape.mesh.triangle[3 * f + k] + 2] / 3;
    if (height > -0.3) kept.insert(kept.end(), &shape.mesh.triangle[3 * f], &shape.mesh.triangle[3 * f] + 3);
  }
  // Vertices of no face go, so that a surface vertex is a mesh vertex.
  std::vector<int> number(shape.mesh.vertices(), -1), old;
  for (int& v : kept) {
    if (number[v] < 0) number[v] = static_cast<int>(old.size()), old.push_back(v);
    v = number[v];
  }
  shapes::Symmetric out = shape;
  out.mesh.triangle = kept;
  out.mesh.position.clear();
  out.partner.clear();
  for (const int v : old) {
    out.mesh.position.insert(out.mesh.position.end(), &shape.mesh.position[3 * v], &shape.mesh.position[3 * v] + 3);
    out.partner.push_back(number[shape.partner[v]]);
  }
  return out;
}

TEST(DenseMap, IsTheTruthWhereTheLandmarksAre) {
  const MatchingScene& s = creature_scene();
  const Matching m = s.matching(60);
  for (const bool filter : {false, true}) {
    const DenseMap map = make_dense_map(m, s.truth(m.landmarks), {true, filter, false}, 1);
    int wrong = 0;
    for (int v = 0; v < s.surface.vertices(); ++v) wrong += map.partner[v] != s.shape.partner[v];
    EXPECT_EQ(wrong, 0) << filter;
    for (int v = 0; v < s.surface.vertices(); ++v) {
      EXPECT_LT(map.residual[v], 1e-6);
      EXPECT_GE(map.uncertainty[v], 0);
      double sum = 0;
      for (int k = 0; k < 3; ++k) {
        sum += map.point[v].weight[k];
        ASSERT_GE(map.point[v].weight[k], 0);
      }
      ASSERT_NEAR(sum, 1, 1e-9);
      ASSERT_EQ(map.point[v].vertex[0], map.partner[v]);
    }
  }
}

TEST(DenseMap, StaysNearTheTruthThoughLandmarksAreOff) {
  const MatchingScene& s = creature_scene();
  const Matching m = s.matching(60);
  Images images = s.truth(m.landmarks);
  for (int i = 0; i < m.count(); i += 3)  // to a neighbour of the true image
    images.vertex[i] = s.surface.triangle[next_corner(s.surface.corner_at[s.surface.first_corner[images.vertex[i]]])];
  images.field = s.solver.fields(images.vertex, 1);
  // An edge is about 0.03 units long.
  EXPECT_LT(s.error(make_dense_map(m, images, {true, false, false}, 1).partner), 0.02);
  EXPECT_LT(s.error(make_dense_map(m, images, {true, true, false}, 1).partner), 0.02);
}

TEST(DenseMap, TheResidualIsThatOfThePartnerWithAndWithoutTheNoiseFilter) {
  const MatchingScene s(shapes::shuffled(shapes::bent(shapes::creature(3), 0.3), 5));
  const Matching m = s.matching(40);
  const Images images = s.truth(m.landmarks);
  const Features features = make_tight_features(m, images, 1);
  Matcher matcher(s.surface, features, kFine);
  for (const bool filter : {false, true}) {
    const DenseMap map = make_dense_map(m, images, {true, filter, false}, 1);
    for (int v = 0; v < s.surface.vertices(); ++v) {
      matcher.look_at(v);
      ASSERT_EQ(map.residual[v], matcher.error(map.partner[v])) << v << (filter ? " filtered" : "");
    }
  }
}

// Turning all faces over exchanges the next and the previous neighbour of every vertex. At the border only one of them
// is a neighbour across a face.
TEST(DenseMap, FacesTurnedOverChangeNothingAtABorder) {
  shapes::Symmetric shape = shapes::bent(open_creature(), 0.3), turned = shape;
  for (int f = 0; f < shape.mesh.triangles(); ++f)
    std::swap(turned.mesh.triangle[3 * f + 1], turned.mesh.triangle[3 * f + 2]);
  std::vector<DenseMap> maps;
  for (const shapes::Symmetric& one : {shape, turned}) {
    const MatchingScene s(one);
    ASSERT_FALSE(s.surface.closed);
    const Matching m = s.matching(40);
    // The sign of the curvature turns with the faces.
    const CurvatureFeatures none = CurvatureFeatures::Zero(s.surface.vertices(), kCurvatureFeatures);
    maps.push_back(make_dense_map({s.surface, s.fields, s.shortcuts, none, m.landmarks, 0, true}, s.truth(m.landmarks),
                                  {true, true, false}, 1));
  }
  int differ = 0, otherwise_sure = 0;
  for (std::size_t v = 0; v < maps[0].partner.size(); ++v) {
    differ += maps[0].partner[v] != maps[1].partner[v];
    otherwise_sure += std::abs(maps[0].uncertainty[v] - maps[1].uncertainty[v]) > 1e-3f * maps[0].uncertainty[v];
  }
  EXPECT_EQ(differ, 0);
  EXPECT_EQ(otherwise_sure, 0);
}

TEST(DenseMap, ThreadsChangeNothing) {
  const MatchingScene& s = creature_scene();
  const Matching m = s.matching(30);
  const Images images = s.truth(m.landmarks);
  const DenseMap one = make_dense_map(m, images, {true, true, false}, 1),
                 four = make_dense_map(m, images, {true, true, false}, 4);
  EXPECT_EQ(one.partner, four.partner);
  EXPECT_EQ(one.uncertainty, four.uncertainty);
}

TEST(DenseMap, Cancels) {
  const MatchingScene& s = creature_scene();
  const Matching m = s.matching(30);
  const std::atomic<bool> stop{true};
  EXPECT_THROW(make_dense_map(m, s.truth(m.landmarks), {}, 2, {nullptr, &stop}), Cancelled);
}

}  // namespace
}  // namespace ga_symmetry
