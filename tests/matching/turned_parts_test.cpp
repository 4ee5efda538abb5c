// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/turned_parts.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <atomic>
#include <cmath>

#include "ga_symmetry/errors.h"
#include "matching/scene.h"

namespace ga_symmetry {
namespace {

using Vector = Eigen::Vector3d;

const Vector kCrown = Vector(0, 0.15, 1).normalized();  // of the creature, from its middle

// The creature with a nose and two ears, so that it shows which way it looks.
const MatchingScene& creature_with_a_face() {
  static const MatchingScene made([] {
    shapes::Symmetric shape = shapes::creature(4);
    for (int v = 0; v < shape.mesh.vertices(); ++v) {
      Eigen::Map<Vector> p(&shape.mesh.position[3 * v]);
      const Vector before = p;
      for (const Vector& feature : {Vector(0, 0.75, 1.35), Vector(0.45, 0.1, 1.45), Vector(-0.45, 0.1, 1.45)})
        p += 0.25 * std::exp(-(before - feature).squaredNorm() / 0.03) * (feature - Vector(0, 0.2, 1.3)).normalized();
    }
    return shapes::shuffled(shape, 5);
  }());
  return made;
}

SurfaceMap at_vertices(const std::vector<int>& partner) {
  SurfaceMap out{partner, {}};
  for (const int v : partner) out.point.push_back({{v, v, v}, {1, 0, 0}});
  return out;
}

// The truth, but for the head, turned by an angle about its neck.
SurfaceMap head_turned(const MatchingScene& s, double angle) {
  const auto at = [&](int v) { return Vector(&s.shape.mesh.position[3 * v]); };
  std::vector<int> head;
  for (int v = 0; v < s.surface.vertices(); ++v)
    if (at(v).dot(kCrown) > 1.15) head.push_back(v);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, kCrown).toRotationMatrix();
  std::vector<int> partner = s.shape.partner;
  for (const int v : head)
    if (angle != 0)
      partner[v] = *std::min_element(head.begin(), head.end(), [&](int a, int b) {
        const Vector to = turn * at(s.shape.partner[v]);
        return (at(a) - to).squaredNorm() < (at(b) - to).squaredNorm();
      });
  return at_vertices(partner);
}

// Share of the head, but its neck, that is within an edge of the truth.
double right(const MatchingScene& s, const SurfaceMap& map) {
  constexpr double kEdge = 0.03;  // units
  int head = 0, near = 0;
  for (int v = 0; v < s.surface.vertices(); ++v)
    if (Vector(&s.shape.mesh.position[3 * v]).dot(kCrown) > 1.4)
      ++head, near += s.surface.edge_length(map.partner[v], s.shape.partner[v]) < kEdge * s.surface.unit();
  return static_cast<double>(near) / head;
}

TEST(TurnPartsBack, TurnsAHeadBack) {
  const MatchingScene& s = creature_with_a_face();
  for (const double angle : {1.0, 2.0, 3.1}) {
    SurfaceMap map = head_turned(s, angle);
    EXPECT_LT(right(s, map), 0.5) << angle;
    EXPECT_TRUE(turn_parts_back(s.matching(100), map, 1)) << angle;
    EXPECT_GT(right(s, map), 0.98) << angle;
  }
}

TEST(TurnPartsBack, LeavesTheTruth) {
  const MatchingScene& s = creature_with_a_face();
  SurfaceMap map = head_turned(s, 0);
  EXPECT_FALSE(turn_parts_back(s.matching(100), map, 1));
  EXPECT_EQ(map.partner, s.shape.partner);
}

// What bends sideways, as a tail does, may fit better turned; its pieces do not.
TEST(TurnPartsBack, LeavesTheTruthWhereThePoseIsNotSymmetric) {
  for (const double curvature : {0.2, 0.4, 0.6, 0.8}) {
    const MatchingScene s(shapes::shuffled(shapes::bent(shapes::creature(4), curvature), 5));
    SurfaceMap map = at_vertices(s.shape.partner);
    EXPECT_FALSE(turn_parts_back(s.matching(100), map, 1)) << curvature;
    EXPECT_EQ(map.partner, s.shape.partner) << curvature;
  }
}

TEST(TurnPartsBack, ThreadsChangeNothing) {
  const MatchingScene& s = creature_with_a_face();
  SurfaceMap one = head_turned(s, 2), four = one;
  turn_parts_back(s.matching(100), one, 1);
  turn_parts_back(s.matching(100), four, 4);
  EXPECT_EQ(one.partner, four.partner);
}

TEST(TurnPartsBack, CanBeCancelled) {
  const MatchingScene& s = creature_with_a_face();
  SurfaceMap map = head_turned(s, 2);
  const std::atomic<bool> cancel{true};
  EXPECT_THROW(turn_parts_back(s.matching(100), map, 2, {nullptr, &cancel, nullptr}), Cancelled);
}

}  // namespace
}  // namespace ga_symmetry
