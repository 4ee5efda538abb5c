// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/mirror_plane.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "surface/facing_points.h"
#include "util/parallel.h"

namespace ga_symmetry {
namespace {

using Vector = Eigen::Vector3d;
constexpr float kTurned = FacingPoints::kTurned;
constexpr float kCap = 0.04f;  // squared distance, in units: what one side lacks says nothing of the rest
using Place = FacingPoint;

// A plane over the unit, around the mean.
struct Plane {
  Eigen::Vector3f normal;
  float offset = 0, misfit = 0;

  Place mirror(const Place& p) const {
    Place out = p;
    out.head<3>() -= 2 * (normal.dot(p.head<3>()) - offset) * normal;
    out.tail<3>() -= 2 * normal.dot(p.tail<3>()) * normal;
    return out;
  }
};

bool better(const Plane& a, const Plane& b) { return a.misfit < b.misfit; }

// Of planes, best first, those that are no near copy of a better one.
std::vector<Plane> distinct(std::vector<Plane> planes, std::size_t most) {
  constexpr float kSameNormal = 0.97f, kSameOffset = 0.06f;  // cosine; units
  std::stable_sort(planes.begin(), planes.end(), better);
  std::vector<Plane> out;
  for (const Plane& p : planes) {
    if (out.size() >= most) break;
    const bool known = std::any_of(out.begin(), out.end(), [&](const Plane& q) {
      const float cosine = p.normal.dot(q.normal);
      return std::abs(cosine) > kSameNormal && std::abs(p.offset - (cosine > 0 ? q.offset : -q.offset)) < kSameOffset;
    });
    if (!known) out.push_back(p);
  }
  return out;
}

}  // namespace

struct MirrorPlanes::Impl {
  double unit;
  Vector mean;
  FacingPoints points;
  Eigen::Matrix<float, 6, Eigen::Dynamic> few;  // of the spaced vertices
  float spacing;                                // of all vertices, in units

  Impl(const Surface& s, const Vector& centre)
      : unit(s.unit()),
        mean(centre),
        points(s, centre),
        spacing(static_cast<float>(1 / std::sqrt(static_cast<double>(s.vertices())))) {}

  // Root mean square of the distances along the normals found, and across them where that is more than the vertices are
  // apart.
  // @param found  per spaced vertex: as `nearest` takes it
  float misfit(const Plane& plane, std::vector<Eigen::Index>& found) const {
    float sum = 0;
    for (Eigen::Index i = 0; i < few.cols(); ++i) {
      const Place p = plane.mirror(few.col(i));
      Eigen::Index& j = found[i];
      points.nearest(p, j);
      const Eigen::Vector3f d = p.head<3>() - points.all().col(j).head<3>(),
                            n = points.all().col(j).tail<3>() / kTurned;
      const float along = n.dot(d), across = std::max(0.f, (d - along * n).norm() - spacing);
      sum += std::min(kCap, along * along + across * across);
    }
    return std::sqrt(sum / static_cast<float>(few.cols()));
  }
  // One Gauss-Newton step on the distances from mirrored points to the tangent planes at the points nearest to them
  // (Chen & Medioni 1992): unlike distances between points they let round parts slide. The worst half in doubt is left
  // out. @return false once the plane stands still or has lost its way
  // @param found  per spaced vertex: as `nearest` takes it
  bool fit(Plane& plane, std::vector<Eigen::Index>& found) const {
    const Eigen::Index n = few.cols();
    std::vector<float> cost(n);
    for (Eigen::Index i = 0; i < n; ++i) cost[i] = points.nearest(plane.mirror(few.col(i)), found[i]);
    std::vector<float> sorted = cost;
    std::nth_element(sorted.begin(), sorted.begin() + n / 2, sorted.end());
    const float limit = 4 * sorted[n / 2] + 1e-6f;
    const Eigen::Vector3f side = plane.normal.unitOrthogonal(), up = plane.normal.cross(side);
    Eigen::Matrix3f normal = Eigen::Matrix3f::Zero();
    Eigen::Vector3f right = Eigen::Vector3f::Zero();
    for (Eigen::Index i = 0; i < n; ++i) {
      if (cost[i] > limit) continue;
      const Eigen::Vector3f x = few.col(i).head<3>(), y = points.all().col(found[i]).head<3>(),
                            facing = points.all().col(found[i]).tail<3>() / kTurned;
      const float depth = plane.normal.dot(x) - plane.offset, along = facing.dot(plane.normal);
      const float off = facing.dot(x - 2 * depth * plane.normal - y);
      const Eigen::Vector3f change(-2 * (side.dot(x) * along + depth * facing.dot(side)),
                                   -2 * (up.dot(x) * along + depth * facing.dot(up)), 2 * along);
      normal += change * change.transpose();
      right -= off * change;
    }
    normal.diagonal().array() += 1e-4f * normal.trace() / 3;  // what a round shape does not determine stays
    const Eigen::Vector3f step = normal.ldlt().solve(right);
    constexpr float kLongest = 0.3f, kStill = 1e-5f;
    if (!(step.norm() < kLongest)) return false;
    plane.normal = (plane.normal + step[0] * side + step[1] * up).normalized();
    plane.offset += step[2];
    return step.norm() > kStill;
  }
  // As many steps as it takes, then the misfit.
  void fit_fully(Plane& plane) const {
    constexpr int kSteps = 12;
    std::vector<Eigen::Index> found(few.cols(), 0);
    for (int step = 0; step < kSteps && fit(plane, found); ++step) {
    }
    plane.misfit = misfit(plane, found);
  }
  Plane of_points(const MirrorPlane& p) const {
    return {p.normal.cast<float>(), static_cast<float>((p.offset - p.normal.dot(mean)) / unit), 0};
  }
  MirrorPlane of_surface(const Plane& p) const {
    const Vector normal = p.normal.cast<double>().normalized();
    return {normal, p.offset * unit + normal.dot(mean), p.misfit};
  }
};

MirrorPlanes::MirrorPlanes(const Surface& s, const std::vector<int>& vertices) {
  Vector mean = Vector::Zero();
  for (int v : vertices) mean += Vector(s.point(v)) / static_cast<double>(vertices.size());
  impl_ = std::make_unique<Impl>(s, mean);
  impl_->few.resize(6, static_cast<Eigen::Index>(vertices.size()));
  for (std::size_t i = 0; i < vertices.size(); ++i)
    impl_->few.col(static_cast<Eigen::Index>(i)) = impl_->points.all().col(vertices[i]);
}
MirrorPlanes::~MirrorPlanes() = default;

std::vector<MirrorPlane> MirrorPlanes::search(int count, int threads) const {
  constexpr Eigen::Index kTried = 40, kProbes = 50, kFitted = 24;  // vertices, vertices, planes
  const Impl& m = *impl_;
  const Eigen::Index tried = std::min(kTried, m.few.cols()), probes = std::min(kProbes, m.few.cols());
  std::vector<Plane> planes;
  const Eigen::Matrix3f axes =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f>(m.few.topRows<3>() * m.few.topRows<3>().transpose())
          .eigenvectors();
  for (int k = 0; k < 3; ++k) planes.push_back({axes.col(k), 0, 0});
  for (Eigen::Index a = 0; a < tried; ++a)
    for (Eigen::Index b = 0; b < a; ++b) {
      const Eigen::Vector3f p = m.few.col(a).head<3>(), q = m.few.col(b).head<3>(), d = p - q;
      constexpr float kApart = 0.05f;  // units: points nearer to each other say little of a plane between them
      if (d.norm() > kApart) planes.push_back({d.normalized(), d.normalized().dot(0.5f * (p + q)), 0});
    }
  // First against the spaced vertices alone, all at once.
  parallel_for(static_cast<int>(planes.size()), threads, [&](int k, int) {
    float sum = 0;
    for (Eigen::Index i = 0; i < probes; ++i)
      sum += std::min(kCap, (m.few.colwise() - planes[k].mirror(m.few.col(i))).colwise().squaredNorm().minCoeff());
    planes[k].misfit = sum;
  });
  planes = distinct(std::move(planes), kFitted);
  parallel_for(static_cast<int>(planes.size()), threads, [&](int k, int) { m.fit_fully(planes[k]); });
  std::vector<MirrorPlane> out;
  for (const Plane& plane : distinct(std::move(planes), static_cast<std::size_t>(count)))
    out.push_back(m.of_surface(plane));
  return out;
}

MirrorPlane MirrorPlanes::between(const std::vector<Vector>& points, const std::vector<Vector>& partners) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  Vector middle = Vector::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector d = points[i] - partners[i];
    spread += d * d.transpose();
    middle += 0.5 * (points[i] + partners[i]) / static_cast<double>(points.size());
  }
  const Vector normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(2);
  return {normal, normal.dot(middle), 1};
}

MirrorPlane MirrorPlanes::fitted(MirrorPlane plane) const {
  Plane p = impl_->of_points(plane);
  impl_->fit_fully(p);
  return impl_->of_surface(p);
}

std::vector<int> MirrorPlanes::map(const MirrorPlane& plane, int samples) const {
  const Plane p = impl_->of_points(plane);
  std::vector<int> out(samples);
  for (int i = 0; i < samples; ++i)
    (impl_->few.colwise() - p.mirror(impl_->few.col(i))).colwise().squaredNorm().minCoeff(&out[i]);
  return out;
}

}  // namespace ga_symmetry
