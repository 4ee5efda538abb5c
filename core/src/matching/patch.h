// SPDX-License-Identifier: GPL-3.0-or-later
// A geodesic disc of a surface, and how it is laid rigidly onto the surface somewhere else.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "matching/local_motion.h"
#include "surface/surface.h"

namespace ga_symmetry {

/// What a vertex counts at a distance from the centre of 0 to 1 radius.
inline double falloff(double x) { return (1 - x * x) * (1 - x * x); }

struct Patch {
  std::vector<int> vertex;
  Eigen::Matrix3Xd points, images;  ///< where its vertices stand, and where a map takes them
  Eigen::VectorXd weights;          ///< area times falloff

  /// @param field   distances to the centre, of all vertices
  /// @param radius  units
  /// @param image   of all vertices
  Patch(const Surface& surface, const float* field, double radius, const std::vector<Eigen::Vector3d>& image);
  /// Whether there is enough of it to be fitted.
  bool fits() const { return vertex.size() >= 6; }
};

/// A disc where it fits.
struct Fitted {
  LocalMotion motion;
  double misfit;  ///< mean squared distance from the moved disc to the surface, units^2, each capped
};

/// One Gauss-Newton step of a rigid motion: a small turn about the centre of the image, then a shift.
class MotionStep {
 public:
  /// A point that should lie on a plane. @param arm  from the centre to it
  void add_plane(const Eigen::Vector3d& arm, const Eigen::Vector3d& normal, double away, double weight);
  /// A point that should be at another one.
  void add_point(const Eigen::Vector3d& arm, const Eigen::Vector3d& away, double weight);
  void take(LocalMotion& motion) const;

 private:
  Eigen::Matrix<double, 6, 6> normal_ = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> right_ = Eigen::Matrix<double, 6, 1>::Zero();
};

/// Iterative closest points, from point to plane (Chen & Medioni 1992). What the shape does not tell, round a limb or
/// along it, stays as it is by the images.
/// @param normal   of all vertices
/// @param steps    of Gauss and Newton, >= 0
/// @param held     by the images; otherwise by where it is before each step, so that it may go far
/// @param nearest  nearest(k, x, facing) is the vertex nearest to point k, which is now at x and faces that way; -1 =
/// none
template <class Nearest>
Fitted fit_patch(const Surface& s, const Patch& patch, LocalMotion start, const std::vector<Eigen::Vector3d>& normal,
                 int steps, bool held, const Nearest& nearest) {
  using Vector = Eigen::Vector3d;
  constexpr double kOff = 0.02;   // units: what is that far off the surface counts a quarter
  constexpr double kMap = 0.003;  // weight of the images beside the shape
  const double off2 = kOff * kOff * s.area, most = 4 * off2;
  Fitted out{start, 0};
  for (;; --steps) {
    MotionStep step;
    double squares = 0;
    for (Eigen::Index k = 0; k < patch.points.cols(); ++k) {
      const Vector x = out.motion(patch.points.col(k)), arm = x - out.motion.to;
      const Vector facing = out.motion.turn * normal[patch.vertex[k]];
      const int at = nearest(k, x, facing);
      step.add_point(arm, held ? (x - patch.images.col(k)).eval() : Vector::Zero().eval(), patch.weights[k] * kMap);
      if (at < 0) {
        squares += patch.weights[k] * most;
        continue;
      }
      const Vector& n = normal[at];
      const double away = n.dot(x - Vector(s.point(at))), robust = off2 / (off2 + away * away),
                   alike = std::max(0.0, n.dot(facing));
      squares += patch.weights[k] * std::min(most, away * away);
      step.add_plane(arm, n, away, patch.weights[k] * robust * robust * alike);
    }
    out.misfit = squares / patch.weights.sum() / s.area;
    if (steps == 0) return out;
    step.take(out.motion);
  }
}

/// Walks downhill over edges to the vertex nearest to a point.
int walk_to_nearest(const Surface& surface, const Eigen::Vector3d& point, int from);

/// Lays a disc where its images are, and fits it to the surface near there. @param partner  of all vertices
Fitted fit_to_partners(const Surface& surface, bool reflection, const Patch& patch, const std::vector<int>& partner,
                       const std::vector<Eigen::Vector3d>& normal);

}  // namespace ga_symmetry
