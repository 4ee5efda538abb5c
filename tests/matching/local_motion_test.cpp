// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/local_motion.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "surface/surface.h"
#include "symmetric_shapes.h"

namespace ga_symmetry {
namespace {

using Vector = Eigen::Vector3d;

std::vector<Vector> images(const Surface& s, const Eigen::Matrix3d& turn, const Vector& shift) {
  std::vector<Vector> out;
  for (int v = 0; v < s.vertices(); ++v) out.push_back(turn * Vector(s.point(v)) + shift);
  return out;
}

TEST(LocalMotion, IsTheMotionOfARigidMap) {
  const Surface s = make_surface(shapes::creature(3).mesh);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Matrix3d mirror = turn * Vector(-1, 1, 1).asDiagonal();
  const Vector shift(0.3, -0.2, 0.1);
  for (const bool reflection : {false, true}) {
    std::vector<Vector> image = images(s, reflection ? mirror : turn, shift);
    image[5].setConstant(std::numeric_limits<double>::quiet_NaN());  // nowhere
    for (int v = 0; v < s.vertices(); v += 37) {
      const LocalMotion m = local_motion(s, image, v, reflection);
      const Vector p(s.point(v));
      EXPECT_LT((m(p) - ((reflection ? mirror : turn) * p + shift)).norm(), 1e-9) << v;
      EXPECT_NEAR(m.turn.determinant(), reflection ? -1 : 1, 1e-9);
    }
  }
}

TEST(NearestAround, LiesOnTheFacesOfTheVertex) {
  const Surface s = make_surface(shapes::icosphere(3));
  for (int v = 0; v < s.vertices(); v += 29) {
    const Vector p(s.point(v)), centre = Vector(s.point(s.triangle[0])) * 0;
    const SurfacePoint at = nearest_around(s, v, p);
    Vector found = centre;
    for (int k = 0; k < 3; ++k) found += at.weight[k] * Vector(s.point(at.vertex[k]));
    EXPECT_LT((found - p).norm(), 1e-12);
    // The middle of a face beside the vertex is found as such.
    const int corner = s.corner_at[s.first_corner[v]], f = corner / 3;
    Vector middle = Vector::Zero();
    for (int k = 0; k < 3; ++k) middle += Vector(s.point(s.triangle[3 * f + k])) / 3;
    const SurfacePoint inside = nearest_around(s, v, middle);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(inside.weight[k], 1.0 / 3, 1e-9);
  }
}

}  // namespace
}  // namespace ga_symmetry
