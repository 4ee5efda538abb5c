// SPDX-License-Identifier: GPL-3.0-or-later
// The triangle mesh that the generator works on.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <stdexcept>
#include <string>
#include <vector>

namespace samples {

using Vec3 = Eigen::Vector3d;
using Face = std::array<int, 3>;

/// Lengths in centimetres.
struct Mesh {
  std::vector<Vec3> point;
  std::vector<Face> face;  ///< counterclockwise seen from outside
  int points() const { return static_cast<int>(point.size()); }
};

/// A promise about a sample that does not hold; the generator stops with a failure.
inline void require(bool holds, const std::string& promise) {
  if (!holds) throw std::runtime_error("broken promise: " + promise);
}

}  // namespace samples
