// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/laplacian.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "ga_symmetry/errors.h"
#include "symmetric_shapes.h"

namespace ga_symmetry {
namespace {

Eigen::VectorXf area_shares(const Surface& s) {
  return (Eigen::Map<const Eigen::VectorXd>(s.vertex_area.data(), s.vertices()) / s.area).cast<float>();
}

TEST(CotangentLaplacian, HasConstantsInItsKernelAndTheAreaAsMass) {
  const Surface s = make_surface(shapes::creature(3).mesh);
  const Laplacian l = cotangent_laplacian(s);
  EXPECT_LT((l.stiffness * Eigen::VectorXd::Ones(s.vertices())).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_NEAR(l.mass.diagonal().sum(), s.area, 1e-9 * s.area);
  EXPECT_EQ((Eigen::MatrixXd(l.stiffness) - Eigen::MatrixXd(l.stiffness).transpose()).cwiseAbs().maxCoeff(), 0);
}

// L x - lambda M x, relative to lambda x, in the norm of the area.
double residual(const Laplacian& l, const Eigen::VectorXd& x, double* eigenvalue) {
  const Eigen::ArrayXd mass = l.mass.diagonal();
  *eigenvalue = x.dot(l.stiffness * x) / x.dot(l.mass * x);
  const Eigen::ArrayXd off = (l.stiffness * x - *eigenvalue * (l.mass * x)).array();
  return std::sqrt((off.square() / mass).sum() / (x.array().square() * mass).sum()) / *eigenvalue;
}

TEST(Eigenfunctions, AreOrthonormalAndOfTheLowestEigenvalues) {
  const Surface s = make_surface(shapes::bent(shapes::creature(4), 0.1).mesh);
  constexpr int kCount = 100;
  const Eigen::MatrixXf f = eigenfunctions(s, kCount, 1);
  ASSERT_EQ(f.cols(), kCount);
  const Eigen::MatrixXf gram = f.transpose() * (area_shares(s).asDiagonal() * f);
  EXPECT_LT((gram - Eigen::MatrixXf::Identity(kCount, kCount)).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_LT((f.col(0).array().abs() - 1).abs().maxCoeff(), 1e-3) << "the constant";
  const Laplacian l = cotangent_laplacian(s);
  double before = 0;
  for (int k = 1; k < kCount; ++k) {
    double eigenvalue;
    EXPECT_LT(residual(l, f.col(k).cast<double>(), &eigenvalue), 0.01) << k;
    EXPECT_GE(eigenvalue, 0.999 * before) << k;
    before = eigenvalue;
  }
  EXPECT_NEAR(before * s.area / (4 * 3.14159265 * kCount), 1, 0.25) << "Weyl's law: none is missing";
}

// Of the unit sphere k (k + 1), each 2 k + 1 times.
TEST(Eigenfunctions, OfASphereBeginWithItsCoordinates) {
  const Surface s = make_surface(shapes::icosphere(4));
  const Eigen::MatrixXf f = eigenfunctions(s, 4, 1);
  const Laplacian l = cotangent_laplacian(s);
  for (int k = 1; k < 4; ++k) {
    double eigenvalue;
    residual(l, f.col(k).cast<double>(), &eigenvalue);
    EXPECT_NEAR(eigenvalue * s.area / (4 * 3.14159265), 2, 0.02) << k;
  }
}

TEST(Eigenfunctions, AreFewerOnTinySurfacesAndTheSameForAnyNumberOfThreads) {
  const Surface tiny = make_surface(shapes::icosphere(0)), s = make_surface(shapes::creature(4).mesh);
  EXPECT_LE(eigenfunctions(tiny, 100, 1).cols(), tiny.vertices() / 2);
  EXPECT_EQ(eigenfunctions(s, 40, 1), eigenfunctions(s, 40, 4));
}

TEST(Eigenfunctions, CanBeCancelled) {
  const std::atomic<bool> stop = true;
  EXPECT_THROW(eigenfunctions(make_surface(shapes::creature(3).mesh), 40, 1, {nullptr, &stop}), Cancelled);
}

}  // namespace
}  // namespace ga_symmetry
