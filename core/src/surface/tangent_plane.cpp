// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/tangent_plane.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "util/parallel.h"

namespace ga_symmetry {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Corner of `v` from which its fan of faces can be walked counter-clockwise without leaving anything behind.
int first_fan_corner(const Surface& s, int v) {
  int start = s.corner_at[s.first_corner[v]];
  for (int i = s.first_corner[v]; i < s.first_corner[v + 1]; ++i)
    if (s.opposite[previous_corner(s.corner_at[i])] < 0) start = s.corner_at[i];
  return start;
}

}  // namespace

TangentPlane::TangentPlane(const Surface& s, int v) : vertex_(v) {
  std::vector<double> angle;
  const int start = first_fan_corner(s, v), limit = s.first_corner[v + 1] - s.first_corner[v];
  const Eigen::Vector3d p(s.point(v));
  double turn = 0;
  bool open = false;
  int corner = start;
  for (int i = 0; i < limit; ++i) {
    const int a = s.triangle[next_corner(corner)], b = s.triangle[previous_corner(corner)];
    ring_.push_back({a, Eigen::Vector2d::Zero()});
    angle.push_back(turn);
    const Eigen::Vector3d u = Eigen::Vector3d(s.point(a)) - p, w = Eigen::Vector3d(s.point(b)) - p;
    turn += std::acos(std::clamp(u.dot(w) / (u.norm() * w.norm()), -1.0, 1.0));
    const int across = s.opposite[next_corner(corner)];
    if (across < 0) {
      open = true;
      ring_.push_back({b, Eigen::Vector2d::Zero()});
      angle.push_back(turn);
      break;
    }
    // The neighbour's corner at v: faces are oriented alike where the surface is orientable.
    corner = s.triangle[next_corner(across)] == v ? next_corner(across) : previous_corner(across);
    if (corner == start) break;
  }
  const double stretch = open ? 1 : 2 * kPi / turn;
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < ring_.size(); ++i) {
    Eigen::Vector2d& at = ring_[i].at;
    at =
        s.edge_length(v, ring_[i].vertex) * Eigen::Vector2d(std::cos(angle[i] * stretch), std::sin(angle[i] * stretch));
    normal += at * at.transpose() / at.squaredNorm();
  }
  inverse_ = (normal + 1e-6 * normal.trace() * Eigen::Matrix2d::Identity()).inverse();
}

std::pair<Table, Table> directions(const Surface& surface, const std::vector<int>& vertices,
                                   const DistanceFields& fields, int threads) {
  const int count = static_cast<int>(vertices.size()), sources = static_cast<int>(fields.rows());
  std::pair<Table, Table> out{Table::Zero(count, sources), Table::Zero(count, sources)};
  parallel_for(count, threads, [&](int i, int) {
    const TangentPlane plane(surface, vertices[i]);
    for (int j = 0; j < sources; ++j) {
      if (fields(j, vertices[i]) == 0) continue;
      const Eigen::Vector2d towards = -plane.gradient([&](int v) { return double{fields(j, v)}; });
      const double length = towards.norm();
      if (!(length > 0)) continue;
      out.first(i, j) = static_cast<float>(towards[0] / length);
      out.second(i, j) = static_cast<float>(towards[1] / length);
    }
  });
  return out;
}

}  // namespace ga_symmetry
