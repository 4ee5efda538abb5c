// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/curvature.h"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "surface/laplacian.h"

namespace ga_symmetry {
namespace {

constexpr double kScales[kCurvatureFeatures] = {0.02, 0.04, 0.08};  // of the unit
constexpr float kClamp = 3;

}  // namespace

std::vector<double> integrated_mean_curvature(const Surface& s) {
  const int n = s.vertices();
  std::vector<Eigen::Vector3d> laplacian(n, Eigen::Vector3d::Zero()), normal(n, Eigen::Vector3d::Zero());
  for_each_cotangent(s, [&](int corner, double weight) {
    const int v = s.triangle[corner], a = s.triangle[next_corner(corner)], b = s.triangle[previous_corner(corner)];
    const Eigen::Vector3d p(s.point(v)), pa(s.point(a)), pb(s.point(b));
    laplacian[a] += weight * (pb - pa);
    laplacian[b] -= weight * (pb - pa);
    normal[v] += (pa - p).cross(pb - p);
  });
  std::vector<double> out(n);
  for (int v = 0; v < n; ++v) out[v] = -laplacian[v].dot(normal[v].normalized());
  return out;
}

struct HeatDiffusion::Matrices {
  Laplacian laplacian;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver;
};

HeatDiffusion::HeatDiffusion(const Surface& s) : unit_(s.unit()), matrices_(std::make_unique<Matrices>()) {
  matrices_->laplacian = cotangent_laplacian(s);
  matrices_->solver.analyzePattern(matrices_->laplacian.stiffness + matrices_->laplacian.mass);
}
HeatDiffusion::~HeatDiffusion() = default;

Eigen::VectorXd HeatDiffusion::spread(const Eigen::VectorXd& source, double length) {
  const auto& [stiffness, mass] = matrices_->laplacian;
  matrices_->solver.factorize(mass + length * length * unit_ * unit_ * stiffness);
  return matrices_->solver.solve(source);
}

Eigen::VectorXd HeatDiffusion::smooth(const Eigen::VectorXd& values, double length) {
  return spread(matrices_->laplacian.mass * values, length);
}

CurvatureFeatures curvature_features(const Surface& s, HeatDiffusion& diffusion) {
  const int n = s.vertices();
  const std::vector<double> curvature = integrated_mean_curvature(s);
  Eigen::VectorXd source(n);
  // Where there is no outside, convex and concave are the same; at a border the formula says nothing.
  for (int v = 0; v < n; ++v) source[v] = s.orientable ? curvature[v] : std::abs(curvature[v]);
  for (int corner = 0; corner < 3 * s.triangles(); ++corner)
    if (s.opposite[corner] < 0)
      source[s.triangle[next_corner(corner)]] = source[s.triangle[previous_corner(corner)]] = 0;
  const Eigen::Map<const Eigen::ArrayXd> area(s.vertex_area.data(), n);
  CurvatureFeatures out(n, kCurvatureFeatures);
  for (int k = 0; k < kCurvatureFeatures; ++k) {
    const Eigen::ArrayXd x = diffusion.spread(source, kScales[k]).array() * (kScales[k] * s.unit());
    const double mean = (area * x).sum() / area.sum();
    const double deviation = std::sqrt((area * (x - mean).square()).sum() / area.sum());
    const double sphere = kScales[k] * std::sqrt(4 * 3.14159265358979323846);  // what a sphere of that area has
    out.col(k) = ((x - mean) / std::max(deviation, 0.2 * sphere)).cast<float>().min(kClamp).max(-kClamp);
  }
  return out;
}

}  // namespace ga_symmetry
