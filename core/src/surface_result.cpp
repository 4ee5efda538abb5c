// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface_result.h"

#include <algorithm>
#include <string>
#include <utility>

namespace ga_symmetry {

Result to_mesh(SurfaceResult found, std::vector<std::vector<SurfacePoint>> axis, const Surface& surface,
               double max_fitness) {
  Result out;
  const int n = surface.mesh_vertices;
  const auto point_of = [&](SurfacePoint p) {
    for (int& v : p.vertex) v = surface.mesh_vertex[v];
    return p;
  };
  double worst = 0, sum = 0;
  for (int v = 0; v < surface.vertices(); ++v) {
    if (found.partner[v] < 0) continue;
    worst = std::max(worst, found.fitness[v]);
    if (max_fitness > 0 && found.fitness[v] > max_fitness) {
      found.partner[v] = -1;
      continue;
    }
  }
  for (const int v : surface.surface_vertex)
    if (v >= 0 && found.partner[v] >= 0) sum += found.fitness[v], ++out.matched;
  out.mean_fitness = out.matched ? sum / out.matched : 0;
  out.partners.partner.assign(n, -1);
  out.partners.fitness.assign(n, worst);
  out.partners.side.assign(n, 0);
  out.partner_point.assign(n, {});
  for (int m = 0; m < n; ++m) {
    const int v = surface.surface_vertex[m];
    if (v < 0) continue;
    out.partners.side[m] = found.side[v];
    if (found.partner[v] < 0) continue;
    out.partners.partner[m] = surface.mesh_vertex[found.partner[v]];
    out.partners.fitness[m] = found.fitness[v];
    out.partner_point[m] = point_of(found.point[v]);
  }
  for (auto& line : axis)
    for (SurfacePoint& p : line) p = point_of(p);
  out.axis = std::move(axis);
  for (const SymmetricPair& pair : found.pairs)
    if (found.partner[pair.vertex] >= 0)
      out.pairs.push_back({surface.mesh_vertex[pair.vertex], surface.mesh_vertex[pair.partner], pair.fitness});
  out.order = found.order;
  out.symmetries = std::move(found.symmetries);
  // A map onto few vertices, or of few, is none, however well those agree.
  constexpr double kSpread = 0.25, kCollapsed = 0.1;  // distinct partners over vertices: sound maps have 0.4 and more
  std::vector<int> distinct = found.partner;
  distinct.erase(std::remove(distinct.begin(), distinct.end(), -1), distinct.end());
  const auto with_partner = static_cast<double>(distinct.size());
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  const double spread = with_partner > 0 ? static_cast<double>(distinct.size()) / with_partner : 0;
  out.confidence = found.confidence * std::min(1.0, spread / kSpread) * with_partner / surface.vertices();
  if (spread < kCollapsed)
    found.warnings.push_back("the map has collapsed: " + std::to_string(distinct.size()) +
                             " vertices are the partners of all others; do not rely on it");
  out.log = std::move(found.log);
  out.stop = found.stop;
  out.warnings = std::move(found.warnings);
  return out;
}

}  // namespace ga_symmetry
