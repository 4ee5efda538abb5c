// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesics/anchors.h"

#include <gtest/gtest.h>

#include "shapes.h"

namespace ga_symmetry {
namespace {

struct Scene {
  Surface surface = make_surface(shapes::body());
  GeodesicSolver solver{surface};
};

TEST(Anchors, AReflectionTakesAPairBothWays) {
  const Scene s;
  const Anchors both = make_anchors({{5}, {{1, 2}}}, SymmetryKind::reflection, s.solver, 1);
  EXPECT_EQ(both.from.vertex, (std::vector<int>{5, 1, 2}));
  EXPECT_EQ(both.image.vertex, (std::vector<int>{5, 2, 1}));
  const Anchors one_way = make_anchors({{5}, {{1, 2}}}, SymmetryKind::rotation, s.solver, 1);
  EXPECT_EQ(one_way.from.vertex, (std::vector<int>{5, 1}));
  EXPECT_EQ(one_way.image.vertex, (std::vector<int>{5, 2}));
}

TEST(Anchors, TheOrderInWhichTheyAreNamedChangesNothing) {
  const Scene s;
  const Anchors a = make_anchors({{5, 9}, {{1, 2}, {30, 40}}}, SymmetryKind::reflection, s.solver, 1),
                b = make_anchors({{9, 5}, {{40, 30}, {2, 1}}}, SymmetryKind::reflection, s.solver, 1);
  EXPECT_EQ(a.from.vertex, b.from.vertex);
  EXPECT_EQ(a.image.vertex, b.image.vertex);
  const Anchors back = make_anchors({{}, {{2, 1}}}, SymmetryKind::rotation, s.solver, 1);
  EXPECT_EQ(back.from.vertex, (std::vector<int>{2})) << "a rotation goes one way";
}

TEST(Anchors, HaveTheFieldsOfTheirVertices) {
  const Scene s;
  const Anchors a = make_anchors({{5, 9}, {{1, 2}, {2, 40}}}, SymmetryKind::rotation, s.solver, 2);
  ASSERT_EQ(a.count(), 4);
  EXPECT_EQ(a.from.field, s.solver.fields(a.from.vertex, 1));
  EXPECT_EQ(a.image.field, s.solver.fields(a.image.vertex, 1));
}

TEST(Anchors, NoneWithoutReferences) {
  const Scene s;
  const Anchors none = make_anchors({}, SymmetryKind::reflection, s.solver, 1);
  EXPECT_EQ(none.count(), 0);
  EXPECT_EQ(none.from.field.cols(), s.surface.vertices());
}

}  // namespace
}  // namespace ga_symmetry
