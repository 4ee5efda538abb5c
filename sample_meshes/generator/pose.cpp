// SPDX-License-Identifier: GPL-3.0-or-later
#include "pose.h"

#include <algorithm>
#include <cmath>

namespace samples {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

}  // namespace

double Ramp::at(const Vec3& p) const {
  const double t = std::clamp(0.5 + (p - point).dot(direction) / (2 * half_width), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

Joint joint(const Vec3& centre, std::vector<Ramp> ramps, const Vec3& degrees_xyz) {
  const Eigen::AngleAxisd turn(Eigen::AngleAxisd(kDegree * degrees_xyz.x(), Vec3::UnitX()) *
                               Eigen::AngleAxisd(kDegree * degrees_xyz.y(), Vec3::UnitY()) *
                               Eigen::AngleAxisd(kDegree * degrees_xyz.z(), Vec3::UnitZ()));
  return {centre, std::move(ramps), turn.axis(), turn.angle() / kDegree};
}

Joint mirrored(const Joint& joint) {
  const Vec3 flip(-1, 1, 1);
  Joint out = joint;
  out.centre = joint.centre.cwiseProduct(flip);
  for (Ramp& r : out.ramps) r.point = r.point.cwiseProduct(flip), r.direction = r.direction.cwiseProduct(flip);
  out.axis = -joint.axis.cwiseProduct(flip);  // a turn is an axial vector
  return out;
}

Joint turned(const Joint& joint, double degrees) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(kDegree * degrees, Vec3::UnitZ()).toRotationMatrix();
  Joint out = joint;
  out.centre = turn * joint.centre;
  for (Ramp& r : out.ramps) r.point = turn * r.point, r.direction = turn * r.direction;
  out.axis = turn * joint.axis;
  return out;
}

std::vector<Vec3> bend(const Pose& pose, const std::vector<Vec3>& rest) {
  std::vector<Vec3> out = rest;
  for (std::size_t v = 0; v < rest.size(); ++v)
    for (const Joint& j : pose) {
      double weight = 1;
      for (const Ramp& r : j.ramps) weight *= r.at(rest[v]);
      if (weight > 0) out[v] = j.centre + Eigen::AngleAxisd(weight * j.degrees * kDegree, j.axis) * (out[v] - j.centre);
    }
  return out;
}

}  // namespace samples
