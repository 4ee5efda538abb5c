// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/local_motion.h"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>

#include "surface/nearest_point.h"

namespace ga_symmetry {

using Vector = Eigen::Vector3d;

LocalMotion local_motion(const Surface& s, const std::vector<Vector>& image, int vertex, bool reflection) {
  constexpr int kRings = 2;  // one turns with every vertex that is half an edge off; five blur what bends
  std::vector<int> near{vertex};
  std::size_t first = 0;
  for (int ring = 0; ring < kRings; ++ring) {
    const std::size_t last = near.size();
    for (; first < last; ++first)
      for (int i = s.first_corner[near[first]]; i < s.first_corner[near[first] + 1]; ++i)
        for (int w : {s.triangle[next_corner(s.corner_at[i])], s.triangle[previous_corner(s.corner_at[i])]})
          if (std::find(near.begin(), near.end(), w) == near.end()) near.push_back(w);
  }
  near.erase(std::remove_if(near.begin(), near.end(), [&](int w) { return image[w].hasNaN(); }), near.end());
  LocalMotion m{Vector::Zero(), Vector::Zero(), Eigen::Matrix3d::Identity()};
  for (int w : near) m.from += Vector(s.point(w)), m.to += image[w];
  m.from /= static_cast<double>(near.size()), m.to /= static_cast<double>(near.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (int w : near) covariance += (image[w] - m.to) * (Vector(s.point(w)) - m.from).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = svd.matrixU().determinant() * svd.matrixV().determinant() * (reflection ? -1 : 1);
  m.turn = svd.matrixU() * Vector(1, 1, sign < 0 ? -1 : 1).asDiagonal() * svd.matrixV().transpose();
  return m;
}

SurfacePoint nearest_around(const Surface& s, int vertex, const Vector& point) {
  SurfacePoint out{{vertex, vertex, vertex}, {1, 0, 0}};
  double least = std::numeric_limits<double>::infinity();
  for (int i = s.first_corner[vertex]; i < s.first_corner[vertex + 1]; ++i) {
    const int* t = &s.triangle[3 * static_cast<std::size_t>(s.corner_at[i] / 3)];
    const Vector a(s.point(t[0])), ab = Vector(s.point(t[1])) - a, ac = Vector(s.point(t[2])) - a, ap = point - a;
    double x, y;
    nearest_in_triangle(ap, ab, ac, x, y);
    const double d = (ap - x * ab - y * ac).squaredNorm();
    if (d < least) least = d, out = {{t[0], t[1], t[2]}, {std::max(0.0, 1 - x - y), x, y}};
  }
  return out;
}

}  // namespace ga_symmetry
