// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/registration.h"

#include <cmath>
#include <optional>
#include <vector>

#include "ga_symmetry/errors.h"
#include "matching/patch.h"
#include "util/parallel.h"

namespace ga_symmetry {

SurfaceMap register_discs(const Matching& m, SurfaceMap map, int threads, const Context& context) {
  using Vector = Eigen::Vector3d;
  constexpr double kRadius = 0.15;  // units: half of a head
  constexpr double kFit = 0.003;    // units: what fits better is no better evidence
  constexpr int kRounds = 2, kPatches = 4, kBlock = 256;
  const Surface& s = m.surface;
  const int n = s.vertices(), count = m.count();
  const double radius = kRadius * s.unit();
  const std::vector<Vector> normal = unit_normals(s);
  std::vector<Vector> image(n);
  std::vector<std::optional<Fitted>> fitted(count);
  for (int round = 0; round < kRounds; ++round) {
    context.advance(static_cast<double>(round) / kRounds);
    for (int v = 0; v < n; ++v) image[v] = position(s, map.point[v]);
    parallel_blocks(count, kPatches, threads, [&](int begin, int end, int) {
      if (context.cancelled()) throw Cancelled();
      for (int i = begin; i < end; ++i) {
        const Patch patch(s, m.landmarks.field.row(i).data(), kRadius, image);
        if (patch.fits()) fitted[i] = fit_to_partners(s, m.reflection, patch, map.partner, normal);
      }
    });
    parallel_blocks(n, kBlock, threads, [&](int begin, int end, int) {
      for (int v = begin; v < end; ++v) {
        Vector to = Vector::Zero();
        double sum = 0;
        for (int i = 0; i < count; ++i) {
          const double x = m.landmarks.field(i, v) / radius;
          if (x >= 1 || !fitted[i]) continue;
          const double weight = falloff(x) / (fitted[i]->misfit + kFit * kFit);
          to += weight * fitted[i]->motion(Vector(s.point(v))), sum += weight;
        }
        if (sum == 0) continue;
        map.partner[v] = walk_to_nearest(s, to / sum, map.partner[v]);
        map.point[v] = nearest_around(s, map.partner[v], to / sum);
      }
    });
  }
  return map;
}

}  // namespace ga_symmetry
