// SPDX-License-Identifier: GPL-3.0-or-later
// Directions on a surface, as seen from a vertex.
#pragma once
#include <Eigen/Core>
#include <utility>
#include <vector>

#include "geodesics/sampling.h"
#include "surface/surface.h"

namespace ga_symmetry {

using Table = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A vertex's one-ring, flattened: lengths kept, angles stretched to a full turn, not at the border (Polthier & Schmies
/// 1998). Where the surface is orientable all planes turn the same way.
class TangentPlane {
 public:
  TangentPlane(const Surface& surface, int vertex);

  /// Least squares gradient of a function, neighbours weighted by 1 / length^2. @param value  (vertex) -> number
  template <class Function>
  Eigen::Vector2d gradient(const Function& value) const {
    const double here = value(vertex_);
    Eigen::Vector2d right(0, 0);
    for (const Neighbor& n : ring_) right += n.at * ((value(n.vertex) - here) / n.at.squaredNorm());
    return inverse_ * right;
  }

 private:
  struct Neighbor {
    int vertex;
    Eigen::Vector2d at;
  };
  int vertex_;
  std::vector<Neighbor> ring_;
  Eigen::Matrix2d inverse_;
};

/// Directions (unit vectors in each vertex's tangent plane) of the shortest ways from vertices to the fields' sources;
/// (0,0) at a source. @param fields  sources x vertices @return {cosine, sine}, vertices x sources
std::pair<Table, Table> directions(const Surface& surface, const std::vector<int>& vertices,
                                   const DistanceFields& fields, int threads);

}  // namespace ga_symmetry
