// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/curvature.h"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

namespace ga_symmetry {
namespace {

constexpr double kScales[kCurvatureFeatures] = {0.02, 0.04, 0.08};  // of the unit
constexpr double kMaxCotangent = 20;                                // needles would dominate everything around them
constexpr float kClamp = 3;

// Calls body(corner, its half cotangent), for the edge opposite of the corner.
template <class Body>
void for_each_cotangent(const Surface& s, const Body& body) {
  for (int corner = 0; corner < 3 * s.triangles(); ++corner) {
    const Eigen::Vector3d p(s.point(s.triangle[corner])),
        u = Eigen::Vector3d(s.point(s.triangle[next_corner(corner)])) - p,
        w = Eigen::Vector3d(s.point(s.triangle[previous_corner(corner)])) - p;
    body(corner, 0.5 * std::clamp(u.dot(w) / u.cross(w).norm(), -kMaxCotangent, kMaxCotangent));
  }
}

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
  Eigen::SparseMatrix<double> stiffness, mass;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver;
};

HeatDiffusion::HeatDiffusion(const Surface& s) : unit_(s.unit()), matrices_(std::make_unique<Matrices>()) {
  const int n = s.vertices();
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(12) * s.triangles());
  for_each_cotangent(s, [&](int corner, double weight) {
    const int a = s.triangle[next_corner(corner)], b = s.triangle[previous_corner(corner)];
    // Without negative weights the diffusion keeps to the range of its source, whatever the triangles.
    weight = std::max(weight, 0.0);
    entries.emplace_back(a, a, weight);
    entries.emplace_back(b, b, weight);
    entries.emplace_back(a, b, -weight);
    entries.emplace_back(b, a, -weight);
  });
  Matrices& m = *matrices_;
  m.stiffness.resize(n, n);
  m.stiffness.setFromTriplets(entries.begin(), entries.end());
  m.mass.resize(n, n);
  m.mass.setIdentity();
  for (int v = 0; v < n; ++v) m.mass.coeffRef(v, v) = s.vertex_area[v];
  m.solver.analyzePattern(m.stiffness + m.mass);
}
HeatDiffusion::~HeatDiffusion() = default;

Eigen::VectorXd HeatDiffusion::spread(const Eigen::VectorXd& source, double length) {
  matrices_->solver.factorize(matrices_->mass + length * length * unit_ * unit_ * matrices_->stiffness);
  return matrices_->solver.solve(source);
}

Eigen::VectorXd HeatDiffusion::smooth(const Eigen::VectorXd& values, double length) {
  return spread(matrices_->mass * values, length);
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
