// SPDX-License-Identifier: GPL-3.0-or-later
// Vertices of a surface, to be found by where they stand and which way the surface faces there.
#pragma once
#include <Eigen/Core>
#include <memory>

#include "surface/surface.h"

namespace ga_symmetry {

/// A position from the origin over the surface's unit, then the normal times FacingPoints::kTurned.
using FacingPoint = Eigen::Matrix<float, 6, 1>;

/// Const after construction, so shared by threads.
class FacingPoints {
 public:
  /// Two points are near if they also face the same way: a normal that is turned by 60 degrees counts as much as a
  /// tenth of the unit.
  static constexpr float kTurned = 0.1f;

  FacingPoints(const Surface& surface, const Eigen::Vector3d& origin);
  ~FacingPoints();

  /// Of all vertices, one a column.
  const Eigen::Matrix<float, 6, Eigen::Dynamic>& all() const;
  /// @param found  a vertex that may be near, which saves most of the search; becomes the nearest
  /// @return       squared distance to it
  float nearest(const FacingPoint& point, Eigen::Index& found) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ga_symmetry
