// SPDX-License-Identifier: GPL-3.0-or-later
#include "field.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace samples {
namespace {

double distance(const Solid& s, const Vec3& p) {
  if (s.kind == Solid::Kind::kCone) {
    const Vec3 axis = s.b - s.a;
    const double length2 = axis.squaredNorm();
    const double t = length2 > 0 ? std::clamp((p - s.a).dot(axis) / length2, 0.0, 1.0) : 0.0;
    return (p - s.a - t * axis).norm() - (s.radius_a + t * (s.radius_b - s.radius_a));
  }
  // First-order distance to an ellipsoid: |q| (|q| - 1) / |grad|, with q the point in units of the half axes.
  const Vec3 q = (p - s.a).cwiseQuotient(s.b);
  const double length = q.norm(), slope = q.cwiseQuotient(s.b).norm();
  return slope > 0 ? length * (length - 1) / slope : -s.b.minCoeff();
}

}  // namespace

Solid cone(const Vec3& a, double radius_a, const Vec3& b, double radius_b) {
  return {Solid::Kind::kCone, a, b, radius_a, radius_b};
}

Solid ellipsoid(const Vec3& centre, const Vec3& half_axes) { return {Solid::Kind::kEllipsoid, centre, half_axes}; }

// The soft minimum -k log(sum exp(-d / k)) does not depend on the order of the solids, so mirrored solids blend alike.
double Field::value(const Vec3& p) const {
  double before = std::numeric_limits<double>::infinity();
  for (const Layer& layer : layers_) {
    // Sum relative to the least distance so far, so that nothing overflows.
    double least = before, sum = std::isfinite(before) ? 1 : 0;
    for (const Solid& s : layer.solids) {
      const double d = distance(s, p);
      if (d > least + 20 * layer.blend) continue;  // would move the surface by less than 1e-8
      sum = d < least ? 1 + sum * std::exp((d - least) / layer.blend) : sum + std::exp((least - d) / layer.blend);
      least = std::min(least, d);
    }
    before = least - layer.blend * std::log(sum);
  }
  return before;
}

Vec3 Field::gradient(const Vec3& p) const {
  constexpr double kStep = 1e-4;  // cm
  Vec3 g;
  for (int k = 0; k < 3; ++k) {
    const Vec3 step = kStep * Vec3::Unit(k);
    g[k] = (value(p + step) - value(p - step)) / (2 * kStep);
  }
  return g;
}

Eigen::AlignedBox3d Field::box() const {
  Eigen::AlignedBox3d box;
  for (const Layer& layer : layers_)
    for (const Solid& s : layer.solids) {
      // Blending n solids moves the surface out by at most blend * log(n).
      const double swell = layer.blend * std::log(2.0 + static_cast<double>(layer.solids.size()));
      if (s.kind == Solid::Kind::kCone) {
        const Vec3 r = Vec3::Constant(std::max(s.radius_a, s.radius_b) + swell);
        for (const Vec3& c : {s.a, s.b}) box.extend(Vec3(c - r)), box.extend(Vec3(c + r));
      } else {
        const Vec3 r = s.b + Vec3::Constant(swell);
        box.extend(Vec3(s.a - r)), box.extend(Vec3(s.a + r));
      }
    }
  return box;
}

}  // namespace samples
