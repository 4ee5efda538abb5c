// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "ga_symmetry/errors.h"
#include "ga_symmetry/mirror.h"
#include "matching/local_motion.h"
#include "partners/partnered_surface.h"
#include "util/parallel.h"

namespace ga_symmetry {
namespace {

using Vector = Eigen::Vector3d;
using Positions = Eigen::Map<const Eigen::Matrix<double, 3, Eigen::Dynamic>>;

void check_after(const TriangleMesh& before, const TriangleMesh& after) {
  if (after.position.size() != before.position.size())
    throw InvalidOption("the mesh before sculpting has " + std::to_string(before.vertices()) + " vertices, after it " +
                        std::to_string(after.vertices()) + ": both must have the same");
  for (std::size_t i = 0; i < after.position.size(); ++i)
    if (!std::isfinite(after.position[i]))
      throw InvalidMesh("vertex " + std::to_string(i / 3) +
                        " has a coordinate after sculpting that is not finite: repair it");
}

}  // namespace

std::vector<double> transferred_shape(const TriangleMesh& before, const TriangleMesh& after, const Partners& partners,
                                      Transfer transfer, int threads, const Context& context) {
  check_after(before, after);
  const PartneredSurface shape(before, partners);
  const TransferPlan plan = plan_transfer(partners, transfer);
  const Surface& s = shape.surface;
  const Positions was(before.position.data(), 3, before.vertices()), is(after.position.data(), 3, after.vertices());
  const auto moved = [&](int v) -> Vector { return is.col(s.mesh_vertex[v]) - was.col(s.mesh_vertex[v]); };
  std::vector<Vector> image(s.vertices(), Vector::Constant(std::numeric_limits<double>::quiet_NaN()));
  for (int v = 0; v < s.vertices(); ++v)
    if (const int w = shape.partners.partner[v]; w >= 0) image[v] = Vector(s.point(w));

  const std::vector<Vector> normal = unit_normals(s);

  // Per vertex of the surface: how its partner point moved, turned to its own side.
  std::vector<Vector> received(s.vertices(), Vector::Zero());
  constexpr int kBlock = 256;
  parallel_blocks(s.vertices(), kBlock, threads, [&](int begin, int end, int thread) {
    if (context.cancelled()) throw Cancelled();
    if (thread == 0) context.report(static_cast<double>(begin) / s.vertices(), "mirroring");
    for (int v = begin; v < end; ++v) {
      const int w = shape.partners.partner[v];
      if (w < 0) continue;
      const LocalMotion motion = local_motion(s, image, v, shape.has_sides);
      const SurfacePoint at = nearest_around(s, w, motion(Vector(s.point(v))));
      Vector there = Vector::Zero(), up = Vector::Zero();
      for (int k = 0; k < 3; ++k)
        there += at.weight[k] * moved(at.vertex[k]), up += at.weight[k] * normal[at.vertex[k]];
      // What stands upright there stands upright here.
      const Eigen::Matrix3d back = motion.turn.transpose();
      received[v] = Eigen::Quaterniond::FromTwoVectors(back * up, normal[v]) * (back * there);
    }
  });

  std::vector<double> out = after.position;
  for (int m = 0; m < before.vertices(); ++m) {
    const int v = s.surface_vertex[m];
    if (v < 0 || plan.source[m] < 0) continue;
    const Vector own = is.col(m) - was.col(m);
    const Vector now = was.col(m) + (transfer == Transfer::average ? 0.5 * (own + received[v]) : received[v]);
    std::copy_n(now.data(), 3, &out[3 * static_cast<std::size_t>(m)]);
  }
  return out;
}

}  // namespace ga_symmetry
