// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/patch.h"

#include <Eigen/Dense>

#include "surface/neighbors.h"

namespace ga_symmetry {

using Vector = Eigen::Vector3d;

Patch::Patch(const Surface& s, const float* field, double radius, const std::vector<Vector>& image) {
  radius *= s.unit();
  for (int v = 0; v < s.vertices(); ++v)
    if (field[v] < radius) vertex.push_back(v);
  const auto count = static_cast<Eigen::Index>(vertex.size());
  points.resize(3, count), images.resize(3, count), weights.resize(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const int v = vertex[k];
    points.col(k) = Vector(s.point(v)), images.col(k) = image[v];
    weights[k] = s.vertex_area[v] * falloff(field[v] / radius);
  }
}

void MotionStep::add_plane(const Vector& arm, const Vector& normal, double away, double weight) {
  Eigen::Matrix<double, 6, 1> gradient;
  gradient << arm.cross(normal), normal;
  normal_ += weight * gradient * gradient.transpose();
  right_ += weight * away * gradient;
}

void MotionStep::add_point(const Vector& arm, const Vector& away, double weight) {
  Eigen::Matrix3d cross;
  cross << 0, -arm[2], arm[1], arm[2], 0, -arm[0], -arm[1], arm[0], 0;
  normal_.topLeftCorner<3, 3>() -= weight * cross * cross;
  normal_.topRightCorner<3, 3>() += weight * cross;
  normal_.bottomLeftCorner<3, 3>() -= weight * cross;
  normal_.bottomRightCorner<3, 3>().diagonal().array() += weight;
  right_.head<3>() += weight * arm.cross(away);
  right_.tail<3>() += weight * away;
}

void MotionStep::take(LocalMotion& motion) const {
  const Eigen::Matrix<double, 6, 1> move = -normal_.ldlt().solve(right_);
  const double angle = move.head<3>().norm();
  if (angle > 0) motion.turn = Eigen::AngleAxisd(angle, move.head<3>() / angle).toRotationMatrix() * motion.turn;
  motion.to += move.tail<3>();
}

int walk_to_nearest(const Surface& s, const Vector& p, int from) {
  double least = (Vector(s.point(from)) - p).squaredNorm();
  for (bool moved = true; moved;) {
    moved = false;
    for_each_neighbor(s, from, [&](int w) {
      const double d = (Vector(s.point(w)) - p).squaredNorm();
      if (d < least || (d == least && w < from)) least = d, from = w, moved = true;
    });
  }
  return from;
}

Fitted fit_to_partners(const Surface& s, bool reflection, const Patch& patch, const std::vector<int>& partner,
                       const std::vector<Vector>& normal) {
  constexpr int kSteps = 4;
  std::vector<int> at;
  for (const int v : patch.vertex) at.push_back(partner[v]);
  return fit_patch(
      s, patch, rigid_motion(patch.points, patch.images, patch.weights, reflection), normal, kSteps, true,
      [&](Eigen::Index k, const Vector& x, const Vector&) { return at[k] = walk_to_nearest(s, x, at[k]); });
}

}  // namespace ga_symmetry
