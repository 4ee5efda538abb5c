// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include "axis/divide.h"
#include "axis/sides.h"
#include "ga_symmetry/axis.h"
#include "ga_symmetry/errors.h"
#include "geodesics/sampling.h"
#include "partners/partnered_surface.h"

namespace ga_symmetry {
namespace {

constexpr int kLandmarks = 100;  // pairs whose distances place the axis

// Surface vertices, as spread_pairs says.
std::vector<int> spread_vertices(const PartneredSurface& shape, const GeodesicSolver& solver, int count,
                                 const Context& context) {
  const Partners& p = shape.partners;
  std::vector<int> allowed;
  for (int v = 0; v < shape.surface.vertices(); ++v)
    if (p.partner[v] >= 0 && p.partner[v] != v && (!shape.has_sides || (p.side[v] > 0 && p.side[p.partner[v]] <= 0)))
      allowed.push_back(v);
  return farthest_points(shape.surface, solver, allowed, count, context);
}

}  // namespace

std::vector<SymmetricPair> spread_pairs(const TriangleMesh& mesh, const Partners& partners, int count,
                                        const Context& context) {
  if (count < 1) throw InvalidOption("the number of pairs must be at least 1, got " + std::to_string(count));
  const PartneredSurface shape(mesh, partners);
  std::vector<SymmetricPair> out;
  for (const int v : spread_vertices(shape, GeodesicSolver(shape.surface), count, context))
    out.push_back({shape.surface.mesh_vertex[v], shape.surface.mesh_vertex[shape.partners.partner[v]],
                   shape.partners.fitness[v]});
  return out;
}

std::vector<std::vector<SurfacePoint>> axis_lines(const TriangleMesh& mesh, const Partners& partners, int threads,
                                                  const Context& context) {
  const PartneredSurface shape(mesh, partners);
  if (!shape.has_sides) throw InvalidOption("there is no left and no right, as after a rotation: it has no axis line");
  const GeodesicSolver solver(shape.surface);
  Landmarks left, right;
  left.vertex = spread_vertices(shape, solver, kLandmarks, context);
  for (const int v : left.vertex) right.vertex.push_back(shape.partners.partner[v]);
  left.field = solver.fields(left.vertex, threads, context);
  right.field = solver.fields(right.vertex, threads, context);
  auto lines = divide(shape.surface, left_right_function(shape.surface, left, right, 0), shape.partners.partner).axis;
  for (auto& line : lines)
    for (SurfacePoint& point : line)
      for (int& v : point.vertex) v = shape.surface.mesh_vertex[v];
  return lines;
}

std::array<double, 3> position_of(const TriangleMesh& mesh, const SurfacePoint& point) {
  std::array<double, 3> out{0, 0, 0};
  for (int c = 0; c < 3; ++c)
    for (int k = 0; k < 3; ++k)
      out[k] += point.weight[c] * mesh.position[3 * static_cast<std::size_t>(point.vertex[c]) + k];
  return out;
}

double value_at(const std::vector<double>& values, const SurfacePoint& point) {
  double out = 0;
  for (int c = 0; c < 3; ++c) out += point.weight[c] * values[static_cast<std::size_t>(point.vertex[c])];
  return out;
}

}  // namespace ga_symmetry
