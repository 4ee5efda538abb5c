// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/registration.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "ga_symmetry/errors.h"
#include "matching/local_motion.h"
#include "surface/neighbors.h"
#include "util/parallel.h"

namespace ga_symmetry {
namespace {

using Vector = Eigen::Vector3d;

constexpr double kRadius = 0.15;  // of a disc, in units: half of a head
constexpr double kFit = 0.003;    // units: what fits better is no better evidence

double falloff(double x) { return (1 - x * x) * (1 - x * x); }

// Walks downhill over edges to the vertex nearest to a point.
int nearest_vertex(const Surface& s, const Vector& p, int from) {
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

// A disc where it fits.
struct Fitted {
  LocalMotion motion;
  double misfit = INFINITY;  // mean squared distance from the moved disc to the surface, units^2; +inf = too small
};

// One Gauss-Newton step of a rigid motion, small turn first, about the centre of the image.
class Step {
 public:
  /// A point that should lie on a plane.
  void add_plane(const Vector& arm, const Vector& normal, double away, double weight) {
    Vector6 gradient;
    gradient << arm.cross(normal), normal;
    normal_ += weight * gradient * gradient.transpose();
    right_ += weight * away * gradient;
  }
  /// A point that should be at another one.
  void add_point(const Vector& arm, const Vector& away, double weight) {
    Eigen::Matrix3d cross;
    cross << 0, -arm[2], arm[1], arm[2], 0, -arm[0], -arm[1], arm[0], 0;
    normal_.topLeftCorner<3, 3>() -= weight * cross * cross;
    normal_.topRightCorner<3, 3>() += weight * cross;
    normal_.bottomLeftCorner<3, 3>() -= weight * cross;
    normal_.bottomRightCorner<3, 3>().diagonal().array() += weight;
    right_.head<3>() += weight * arm.cross(away);
    right_.tail<3>() += weight * away;
  }
  void take(LocalMotion& motion) const {
    const Vector6 move = -normal_.ldlt().solve(right_);
    const double angle = move.head<3>().norm();
    if (angle > 0) motion.turn = Eigen::AngleAxisd(angle, move.head<3>() / angle).toRotationMatrix() * motion.turn;
    motion.to += move.tail<3>();
  }

 private:
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  Eigen::Matrix<double, 6, 6> normal_ = Eigen::Matrix<double, 6, 6>::Zero();
  Vector6 right_ = Vector6::Zero();
};

// @param field    distances to the disc's centre
// @param partner  of all vertices, and `image` where exactly they are
Fitted fit_disc(const Surface& s, bool reflection, const float* field, const std::vector<int>& partner,
                const std::vector<Vector>& image, const std::vector<Vector>& normal) {
  constexpr double kOff = 0.02;   // units: what is that far off the surface counts a quarter
  constexpr double kMap = 0.003;  // weight of the map beside the shape
  constexpr int kFewest = 6, kSteps = 4;
  const double radius = kRadius * s.unit(), off2 = kOff * kOff * s.area;
  std::vector<int> disc;
  for (int v = 0; v < s.vertices(); ++v)
    if (field[v] < radius) disc.push_back(v);
  const auto count = static_cast<Eigen::Index>(disc.size());
  Fitted out;
  if (count < kFewest) return out;
  Eigen::Matrix3Xd points(3, count), images(3, count);
  Eigen::VectorXd weights(count);
  std::vector<int> at(disc.size());
  for (Eigen::Index k = 0; k < count; ++k) {
    const int v = disc[k];
    points.col(k) = Vector(s.point(v)), images.col(k) = image[v];
    weights[k] = s.vertex_area[v] * falloff(field[v] / radius);
    at[k] = partner[v];
  }
  out.motion = rigid_motion(points, images, weights, reflection);
  for (int steps = 0;; ++steps) {
    Step step;
    double squares = 0;
    for (Eigen::Index k = 0; k < count; ++k) {
      const Vector x = out.motion(points.col(k)), arm = x - out.motion.to;
      at[k] = nearest_vertex(s, x, at[k]);
      const Vector& n = normal[at[k]];
      const double away = n.dot(x - Vector(s.point(at[k]))), robust = off2 / (off2 + away * away),
                   facing = std::max(0.0, n.dot(out.motion.turn * normal[disc[k]]));
      squares += weights[k] * std::min(4 * off2, away * away);
      step.add_plane(arm, n, away, weights[k] * robust * robust * facing);
      step.add_point(arm, x - images.col(k), weights[k] * kMap);
    }
    out.misfit = squares / weights.sum() / s.area;
    if (steps == kSteps) return out;
    step.take(out.motion);
  }
}

}  // namespace

SurfaceMap register_discs(const Matching& m, SurfaceMap map, int threads, const Context& context) {
  constexpr int kRounds = 2, kBlock = 256;
  const Surface& s = m.surface;
  const int n = s.vertices(), count = m.count();
  const double radius = kRadius * s.unit();
  const std::vector<Vector> normal = unit_normals(s);
  std::vector<Vector> image(n);
  std::vector<Fitted> disc(count);
  for (int round = 0; round < kRounds; ++round) {
    context.advance(static_cast<double>(round) / kRounds);
    for (int v = 0; v < n; ++v) image[v] = position(s, map.point[v]);
    parallel_for(count, threads, [&](int i, int) {
      if (context.cancelled()) throw Cancelled();
      disc[i] = fit_disc(s, m.reflection, m.landmarks.field.row(i).data(), map.partner, image, normal);
    });
    parallel_blocks(n, kBlock, threads, [&](int begin, int end, int) {
      for (int v = begin; v < end; ++v) {
        Vector to = Vector::Zero();
        double sum = 0;
        for (int i = 0; i < count; ++i) {
          const double x = m.landmarks.field(i, v) / radius;
          if (x >= 1 || !std::isfinite(disc[i].misfit)) continue;
          const double weight = falloff(x) / (disc[i].misfit + kFit * kFit);
          to += weight * disc[i].motion(Vector(s.point(v))), sum += weight;
        }
        if (sum == 0) continue;
        map.partner[v] = nearest_vertex(s, to / sum, map.partner[v]);
        map.point[v] = nearest_around(s, map.partner[v], to / sum);
      }
    });
  }
  return map;
}

}  // namespace ga_symmetry
