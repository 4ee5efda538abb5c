// SPDX-License-Identifier: GPL-3.0-or-later
#include "ga_symmetry/samples.h"
#include "geodesics/geodesics.h"
#include "geodesics/sampling.h"
#include "surface/surface.h"

namespace ga_symmetry {

SpacedSamples spaced_samples(const TriangleMesh& mesh, int count, bool largest_component, int threads,
                             const Context& context) {
  const Surface surface = make_surface(mesh, largest_component, context);
  const Landmarks samples = evenly_spaced_samples(surface, GeodesicSolver(surface), count, threads, context);
  const std::vector<int> patch = nearest_source(samples.field);
  SpacedSamples out;
  for (const std::string& note : surface.notes) out.surface += (out.surface.empty() ? "" : ", ") + note;
  out.patch.assign(static_cast<std::size_t>(mesh.vertices()), -1);
  for (int m = 0; m < mesh.vertices(); ++m)
    if (surface.surface_vertex[m] >= 0) out.patch[m] = patch[surface.surface_vertex[m]];
  for (const int v : samples.vertex) out.vertex.push_back(surface.mesh_vertex[v]);
  return out;
}

}  // namespace ga_symmetry
