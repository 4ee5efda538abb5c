// What distances could be if nothing of a surface were missing.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/geodesics.h"
#include "ga_symmetry/surface.h"

namespace ga_symmetry {

/// A scan lacks parts, and its geodesics go around what it lacks. A distance is right where the ends are nearer to each
/// other than to the border; otherwise it may be too long, at most by what straight ways from border to border save.
/// Sources: Bronstein et al. 2006 (which distances of a partial surface are right), Bracha et al. 2024 (straight ways).
class Shortcuts {
 public:
  /// None: all distances are right.
  Shortcuts() = default;
  /// Through every hole of the surface that is no mere pinprick. @throws Cancelled
  Shortcuts(const Surface& surface, const GeodesicSolver& solver, int threads, const Context& context = {});

  bool none() const { return point_.empty(); }
  /// Points on borders between which they lead; about 100 at most.
  int points() const { return static_cast<int>(point_.size()); }

  /// How far from the source of a distance field, shortcuts taken, each point is.
  /// @param entry  written; of points() values
  void enter(const float* field, float* entry) const;
  /// Half of what the field may be too long at a vertex: the true distance is within slack() of field[v] - slack().
  /// @param entry  of that field
  /// @return >= 0, unit of the surface
  float slack(const float* field, const float* entry, int v) const;

 private:
  std::vector<int> point_;
  Eigen::MatrixXf straight_;  // points x points: through space, +inf between different holes
  Eigen::MatrixXf distance_;  // points x vertices
};

}  // namespace ga_symmetry
