// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/curvature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "symmetric_shapes.h"

namespace ga_symmetry {
namespace {

CurvatureFeatures features_of(const Surface& surface) {
  HeatDiffusion diffusion(surface);
  return curvature_features(surface, diffusion);
}

// What is left is that its triangles are not all alike.
TEST(CurvatureFeatures, APlainSphereHasHardlyAny) {
  EXPECT_LT(features_of(make_surface(shapes::icosphere(4))).cwiseAbs().maxCoeff(), 0.5);
}

TEST(CurvatureFeatures, AreTheSameAtMirroredVertices) {
  const shapes::Symmetric shape = shapes::shuffled(shapes::creature(4), 5);
  const CurvatureFeatures f = features_of(make_surface(shape.mesh));
  for (int v = 0; v < f.rows(); ++v)
    for (int k = 0; k < kCurvatureFeatures; ++k) ASSERT_NEAR(f(v, k), f(shape.partner[v], k), 1e-3) << v;
}

TEST(CurvatureFeatures, DoNotChangeWithSizeAndPlace) {
  const shapes::Symmetric shape = shapes::creature(3);
  const CurvatureFeatures one = features_of(make_surface(shape.mesh)),
                          other = features_of(make_surface(shapes::moved(shape.mesh, 1e4)));
  EXPECT_LT((one - other).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(CurvatureFeatures, TurnWithTheFaces) {
  shapes::Symmetric shape = shapes::creature(3), turned = shape;
  for (int f = 0; f < shape.mesh.triangles(); ++f)
    std::swap(turned.mesh.triangle[3 * f + 1], turned.mesh.triangle[3 * f + 2]);
  const CurvatureFeatures one = features_of(make_surface(shape.mesh)), other = features_of(make_surface(turned.mesh));
  EXPECT_LT((one + other).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(CurvatureFeatures, TipsAreMoreConvexThanTheRest) {
  const shapes::Symmetric shape = shapes::creature(4);
  const CurvatureFeatures f = features_of(make_surface(shape.mesh));
  for (const int tip : {shape.axis[0], shape.axis[1], shape.pair[0], shape.pair[1]})
    for (int k = 0; k < kCurvatureFeatures; ++k) EXPECT_GT(f(tip, k), 1) << k;
  EXPECT_LE(f.cwiseAbs().maxCoeff(), 3);
}

TEST(CurvatureFeatures, ABorderIsNotCurved) {
  EXPECT_LT(features_of(make_surface(shapes::grid(20, 15))).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(HeatDiffusion, KeepsConstantsAndAmounts) {
  const Surface surface = make_surface(shapes::creature(3).mesh);
  HeatDiffusion diffusion(surface);
  const int n = surface.vertices();
  const Eigen::VectorXd smooth = diffusion.smooth(Eigen::VectorXd::Constant(n, 2.5), 0.1);
  EXPECT_NEAR(smooth.minCoeff(), 2.5, 1e-9);
  EXPECT_NEAR(smooth.maxCoeff(), 2.5, 1e-9);
  Eigen::VectorXd source = Eigen::VectorXd::Zero(n);
  source[7] = 3;
  const Eigen::VectorXd density = diffusion.spread(source, 0.1);
  EXPECT_GE(density.minCoeff(), -1e-12);
  EXPECT_NEAR(density.dot(Eigen::Map<const Eigen::VectorXd>(surface.vertex_area.data(), n)), 3, 1e-9);
}

}  // namespace
}  // namespace ga_symmetry
