// SPDX-License-Identifier: GPL-3.0-or-later
// What distances could be if nothing of a surface were missing.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "ga_symmetry/context.h"
#include "geodesics/geodesics.h"
#include "surface/surface.h"

namespace ga_symmetry {

/// Where a scan has a hole, its geodesics go around it and are longer than those of the whole shape. A distance is
/// right if its ends are nearer to each other than to the border. Any other may be too long; but a straight line across
/// a hole is no longer than any way over the missing surface, so the shortest way with such lines is a lower bound.
/// Sources: Bronstein et al. 2006 (which distances of a partial surface are right), Bracha et al. 2024 (straight ways).
class Shortcuts {
 public:
  /// None: all distances are right.
  Shortcuts() = default;
  /// Through every hole of the surface that is no mere pinprick. @throws Cancelled
  Shortcuts(const Surface& surface, const GeodesicSolver& solver, int threads, const Context& context = {});

  bool none() const { return point_.empty(); }
  /// Shortcuts lead from point to point, straight across a hole; about 100 points on the borders at most.
  int points() const { return static_cast<int>(point_.size()); }

  /// Half of what a distance field may be too long: the true distance is within slack(v) of field[v] - slack(v).
  class Slack {
   public:
    /// At a vertex. @return >= 0, unit of the field; 0 where nothing is missing
    float operator()(int v) const;

   private:
    friend class Shortcuts;
    Slack(const Shortcuts& shortcuts, const float* field);

    const Shortcuts& shortcuts_;
    const float* field_;
    Eigen::ArrayXf entry_;  // per point: how far from the field's source it is, shortcuts taken
  };

  /// @param field  of all vertices; it and the shortcuts must outlive what is returned
  Slack slack(const float* field) const { return {*this, field}; }

 private:
  std::vector<int> point_;
  Eigen::MatrixXf straight_;  // points x points: through space, +inf between different holes
  Eigen::MatrixXf distance_;  // points x vertices
};

}  // namespace ga_symmetry
