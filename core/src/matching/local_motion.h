// SPDX-License-Identifier: GPL-3.0-or-later
// How a map between points of a surface moves what lies around a vertex: the best rigid motion, in any pose.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "ga_symmetry/result.h"
#include "surface/surface.h"

namespace ga_symmetry {

/// Takes what is near a vertex to where its partner is.
struct LocalMotion {
  Eigen::Vector3d from, to;  ///< centres
  Eigen::Matrix3d turn;      ///< orthogonal; with a reflection its determinant is -1
  Eigen::Vector3d operator()(const Eigen::Vector3d& p) const { return to + turn * (p - from); }
};

/// The motion that takes points nearest to their images, by weighted squares. Source: Kabsch, A solution for the best
/// rotation to relate two sets of vectors, 1976.
/// @param points, images, weights  as many columns, at least one, the weights > 0
LocalMotion rigid_motion(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xd& images, const Eigen::VectorXd& weights,
                         bool reflection);

/// That of the two rings around a vertex.
/// @param image  per vertex: where the map takes it; NaN = nowhere, as if it were not there
LocalMotion local_motion(const Surface& surface, const std::vector<Eigen::Vector3d>& image, int vertex,
                         bool reflection);

Eigen::Vector3d position(const Surface& surface, const SurfacePoint& point);

/// Per vertex: the mean normal of the faces around it, weighted by area.
std::vector<Eigen::Vector3d> unit_normals(const Surface& surface);

/// The point nearest to another one on the faces around a vertex, which is the first of its corners.
SurfacePoint nearest_around(const Surface& surface, int vertex, const Eigen::Vector3d& point);

}  // namespace ga_symmetry
