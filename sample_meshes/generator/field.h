// SPDX-License-Identifier: GPL-3.0-or-later
// Rounded solids, blended into one smooth surface: the zero set of a function, negative inside.
#pragma once
#include <vector>

#include "mesh.h"

namespace samples {

/// A cone with spherical ends (two centres, two radii) or an axis-parallel ellipsoid (centre, three half axes).
struct Solid {
  enum class Kind { kCone, kEllipsoid } kind;
  Vec3 a, b;  ///< ends of the cone; centre and half axes of the ellipsoid
  double radius_a = 0, radius_b = 0;
};
Solid cone(const Vec3& a, double radius_a, const Vec3& b, double radius_b);
Solid ellipsoid(const Vec3& centre, const Vec3& half_axes);
inline Solid ball(const Vec3& centre, double radius) { return cone(centre, radius, centre, radius); }

/// Solids that melt into each other, and into all layers before, over a width of about `blend`.
struct Layer {
  double blend;  ///< > 0
  std::vector<Solid> solids;
};

class Field {
 public:
  Field() = default;
  explicit Field(std::vector<Layer> layers) : layers_(std::move(layers)) {}
  double value(const Vec3& p) const;
  Vec3 gradient(const Vec3& p) const;
  /// A box that holds the surface.
  Eigen::AlignedBox3d box() const;

 private:
  std::vector<Layer> layers_;
};

}  // namespace samples
