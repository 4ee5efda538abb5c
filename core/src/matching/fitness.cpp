// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/fitness.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace ga_symmetry {

std::vector<double> vertex_fitness(const Matching& m, const DenseMap& map, HeatDiffusion& diffusion) {
  // Weights beside the distance to the partner's partner, and the width of the average in units: chosen over the posed
  // animals and people with known truth, so that fitness ranks vertices by their true error.
  constexpr double kStretch = 0.04, kUncertainty = 0.2, kSmooth = 0.025;
  // Partners are vertices: an edge may well shrink to nothing, and that says little.
  constexpr double kShrunk = 0.3;
  // Spectral refinement makes any map smooth and its own inverse: whether it holds together is asked of the one before.
  const Surface& surface = m.surface;
  const DistanceFields& fields = m.landmarks.field;
  const int n = surface.vertices(), corners = 3 * surface.triangles();
  std::vector<float> off(n, 0.f), apart(n, 0.f), stretched(corners, 0.f);
  for (Eigen::Index i = 0; i < fields.rows(); ++i) {
    const float* field = fields.row(i).data();
    if (m.reflection)
      for (int v = 0; v < n; ++v)
        off[v] = std::max(off[v], std::abs(field[v] - field[map.by_distances[map.by_distances[v]]]));
    for (int v = 0; v < n; ++v)
      apart[v] = std::max(apart[v], std::abs(field[map.by_distances[v]] - field[map.partner[v]]));
    for (int c = 0; c < corners; ++c)
      stretched[c] = std::max(stretched[c], std::abs(field[map.by_distances[surface.triangle[c]]] -
                                                     field[map.by_distances[surface.triangle[next_corner(c)]]]));
  }
  std::vector<double> stretch(n, 0.0);
  std::vector<int> edges(n, 0);
  for (int c = 0; c < corners; ++c) {
    const int a = surface.triangle[c], b = surface.triangle[next_corner(c)];
    const double ratio = stretched[c] / surface.edge_length(a, b);
    for (const int v : {a, b}) stretch[v] += std::abs(std::log((ratio + kShrunk) / (1 + kShrunk))), ++edges[v];
  }
  Eigen::VectorXd out(n);
  for (int v = 0; v < n; ++v)
    out[v] =
        (off[v] + apart[v]) / surface.unit() + kStretch * stretch[v] / edges[v] + kUncertainty * map.uncertainty[v];
  out = diffusion.smooth(out, kSmooth).cwiseMax(0);
  return {out.begin(), out.end()};
}

}  // namespace ga_symmetry
