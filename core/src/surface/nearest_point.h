// SPDX-License-Identifier: GPL-3.0-or-later
// The point of a triangle that is nearest to another point.
#pragma once
#include <Eigen/Core>

namespace ga_symmetry {

/// Weights of the corners b and c in the point of the triangle a, a + ab, a + ac that is nearest to a + ap.
/// Source: Ericson, Real-Time Collision Detection, 2005, 5.1.5.
template <class Vector, class Scalar = typename Vector::Scalar>
void nearest_in_triangle(const Vector& ap, const Vector& ab, const Vector& ac, Scalar& x, Scalar& y) {
  const Vector bp = ap - ab, cp = ap - ac;
  const Scalar d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp), d6 = ac.dot(cp);
  const Scalar va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  x = 0, y = 0;
  if (d1 <= 0 && d2 <= 0) {
  } else if (d3 >= 0 && d4 <= d3) {
    x = 1;
  } else if (d6 >= 0 && d5 <= d6) {
    y = 1;
  } else if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    x = d1 / (d1 - d3);
  } else if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    y = d2 / (d2 - d6);
  } else if (va <= 0 && d4 >= d3 && d5 >= d6) {
    y = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    x = 1 - y;
  } else {
    x = vb / (va + vb + vc);
    y = vc / (va + vb + vc);
  }
}

inline float squared_distance_to_triangle(const Eigen::Vector3f& p, const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                                          const Eigen::Vector3f& c) {
  const Eigen::Vector3f ab = b - a, ac = c - a, ap = p - a;
  float x, y;
  nearest_in_triangle(ap, ab, ac, x, y);
  return (ap - x * ab - y * ac).squaredNorm();
}

}  // namespace ga_symmetry
