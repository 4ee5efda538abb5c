// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/local_motion.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <limits>

#include "surface/locate.h"
#include "surface/nearest_point.h"

namespace ga_symmetry {

using Vector = Eigen::Vector3d;

LocalMotion rigid_motion(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xd& images, const Eigen::VectorXd& weights,
                         bool reflection) {
  LocalMotion m{points * weights / weights.sum(), images * weights / weights.sum(), {}};
  const Eigen::Matrix3d covariance =
      (images.colwise() - m.to) * weights.asDiagonal() * (points.colwise() - m.from).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = svd.matrixU().determinant() * svd.matrixV().determinant() * (reflection ? -1 : 1);
  m.turn = svd.matrixU() * Vector(1, 1, sign < 0 ? -1 : 1).asDiagonal() * svd.matrixV().transpose();
  return m;
}

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
  const auto count = static_cast<Eigen::Index>(near.size());
  Eigen::Matrix3Xd points(3, count), images(3, count);
  for (Eigen::Index k = 0; k < count; ++k) points.col(k) = Vector(s.point(near[k])), images.col(k) = image[near[k]];
  return rigid_motion(points, images, Eigen::VectorXd::Ones(count), reflection);
}

Vector position(const Surface& s, const SurfacePoint& p) {
  return p.weight[0] * Vector(s.point(p.vertex[0])) + p.weight[1] * Vector(s.point(p.vertex[1])) +
         p.weight[2] * Vector(s.point(p.vertex[2]));
}

std::vector<Vector> unit_normals(const Surface& s) {
  std::vector<Vector> out;
  out.reserve(s.vertices());
  for (const auto& sum : vertex_normals(s.position, s.triangle)) out.push_back(Vector(sum.data()).normalized());
  return out;
}

SurfacePoint nearest_around(const Surface& s, int vertex, const Vector& point) {
  SurfacePoint out{{vertex, vertex, vertex}, {1, 0, 0}};
  double least = std::numeric_limits<double>::infinity();
  for (int i = s.first_corner[vertex]; i < s.first_corner[vertex + 1]; ++i) {
    const int c = s.corner_at[i];
    const std::array t{vertex, s.triangle[next_corner(c)], s.triangle[previous_corner(c)]};
    const Vector a(s.point(t[0])), ab = Vector(s.point(t[1])) - a, ac = Vector(s.point(t[2])) - a, ap = point - a;
    double x, y;
    nearest_in_triangle(ap, ab, ac, x, y);
    const double d = (ap - x * ab - y * ac).squaredNorm();
    if (d < least) least = d, out = {t, {std::max(0.0, 1 - x - y), x, y}};
  }
  return out;
}

}  // namespace ga_symmetry
