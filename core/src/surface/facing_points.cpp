// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/facing_points.h"

#include <Eigen/Geometry>
#include <functional>
#include <nanoflann.hpp>

namespace ga_symmetry {

using Points = Eigen::Matrix<float, 6, Eigen::Dynamic>;

struct FacingPoints::Impl {
  Points all;
  std::unique_ptr<nanoflann::KDTreeEigenMatrixAdaptor<Points, 6, nanoflann::metric_L2, false>> tree;
};

FacingPoints::FacingPoints(const Surface& s, const Eigen::Vector3d& origin) : impl_(std::make_unique<Impl>()) {
  using Vector = Eigen::Vector3d;
  const double unit = s.unit();
  impl_->all.resize(6, s.vertices());
  for (int v = 0; v < s.vertices(); ++v) {
    Vector sum = Vector::Zero();
    for (int k = s.first_corner[v]; k < s.first_corner[v + 1]; ++k) {
      const int c = s.corner_at[k];
      sum += (Vector(s.point(s.triangle[next_corner(c)])) - Vector(s.point(v)))
                 .cross(Vector(s.point(s.triangle[previous_corner(c)])) - Vector(s.point(v)));
    }
    impl_->all.col(v) << ((Vector(s.point(v)) - origin) / unit).cast<float>(), kTurned * sum.normalized().cast<float>();
  }
  impl_->tree = std::make_unique<decltype(impl_->tree)::element_type>(6, std::cref(impl_->all));
}
FacingPoints::~FacingPoints() = default;

const Points& FacingPoints::all() const { return impl_->all; }

float FacingPoints::nearest(const FacingPoint& p, Eigen::Index& found) const {
  float squared = 0;
  Eigen::Index hint = found;
  nanoflann::KNNResultSet<float, Eigen::Index> result(1);
  result.init(&found, &squared);
  result.addPoint((p - impl_->all.col(hint)).squaredNorm(), hint);
  impl_->tree->index->findNeighbors(result, p.data(), nanoflann::SearchParams());
  return squared;
}

}  // namespace ga_symmetry
