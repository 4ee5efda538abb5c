// SPDX-License-Identifier: GPL-3.0-or-later
// Planes that mirror a surface as it stands: evidence, and exact partners, where the pose is symmetric, too.
#pragma once
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "surface/surface.h"

namespace ga_symmetry {

/// The plane of all p with normal . p = offset.
struct MirrorPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
  double offset = 0;  ///< unit of the surface
  double misfit = 1;  ///< root mean square distance from mirrored points to the surface, each capped at 0.2, in units

  Eigen::Vector3d mirror(const Eigen::Vector3d& p) const { return p - 2 * (normal.dot(p) - offset) * normal; }
};

/// Finds and fits such planes. Const after construction, so shared by threads.
class MirrorPlanes {
 public:
  /// @param vertices  evenly spaced vertices of the surface, the coarsest first: planes are tried and fitted on these
  MirrorPlanes(const Surface& surface, const std::vector<int>& vertices);
  ~MirrorPlanes();

  /// Distinct planes, best first: of those between two of the first vertices, and the principal planes, the best,
  /// fitted.
  std::vector<MirrorPlane> search(int count, int threads) const;
  /// The plane that most nearly exchanges points that are known to be partners, in no way fitted to the surface.
  static MirrorPlane between(const std::vector<Eigen::Vector3d>& points, const std::vector<Eigen::Vector3d>& partners);
  /// Moves the plane to where the mirrored surface lies best on itself (iterative closest points, Besl & McKay 1992),
  /// and measures its misfit.
  MirrorPlane fitted(MirrorPlane plane) const;
  /// For each of the first vertices the number of the one that is nearest to its mirror image and faces the mirrored
  /// way.
  std::vector<int> map(const MirrorPlane& plane, int samples) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ga_symmetry
