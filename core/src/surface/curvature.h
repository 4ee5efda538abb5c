// SPDX-License-Identifier: GPL-3.0-or-later
// Mean curvature of a surface, raw and as features to be matched; and the heat diffusion that smooths it.
#pragma once
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "surface/surface.h"

namespace ga_symmetry {

/// Mean curvature integrated over each vertex's cell, unit of length, > 0 where convex (cotangent formula, Meyer et al.
/// 2003).
std::vector<double> integrated_mean_curvature(const Surface& surface);

/// Heat diffusion on a surface: one implicit step with the cotangent Laplacian (Desbrun et al. 1999).
class HeatDiffusion {
 public:
  explicit HeatDiffusion(const Surface& surface);
  ~HeatDiffusion();
  /// The density of an amount per vertex after it has spread over about `length` units.
  Eigen::VectorXd spread(const Eigen::VectorXd& source, double length);
  /// Averages of values per vertex over about `length` units.
  Eigen::VectorXd smooth(const Eigen::VectorXd& values, double length);

 private:
  struct Matrices;
  double unit_;
  std::unique_ptr<Matrices> matrices_;
};

/// How many numbers describe a vertex in curvature_features.
constexpr int kCurvatureFeatures = 3;
/// vertices x kCurvatureFeatures
using CurvatureFeatures = Eigen::Matrix<float, Eigen::Dynamic, kCurvatureFeatures, Eigen::RowMajor>;

/// Mean curvature smoothed by heat diffusion over 2, 4 and 8 % of the unit; each scaled to standard deviation 1 (less
/// where the surface hardly differs from a sphere) and clamped to [-3, 3]. Bending limbs leaves most of it alone, and
/// it tells where around a limb a point is, which distances hardly do.
CurvatureFeatures curvature_features(const Surface& surface, HeatDiffusion& diffusion);

}  // namespace ga_symmetry
