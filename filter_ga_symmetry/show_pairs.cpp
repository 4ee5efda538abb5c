// SPDX-License-Identifier: GPL-3.0-or-later
// "Intrinsic Symmetry: Show Pairs and Axis".
#include <vcg/complex/algorithms/stat.h>

#include <algorithm>
#include <cmath>

#include "filters.h"
#include "ga_symmetry/axis.h"
#include "ga_symmetry/errors.h"
#include "ga_symmetry/io.h"
#include "layers.h"
#include "option_parameters.h"

namespace ga_symmetry {
namespace {

constexpr const char* info =
    "Draws what Find Partners has<br>"
    "found, in new layers: lines that<br>"
    "link evenly spread pairs, and the<br>"
    "symmetry axis on the surface.<br>"
    "Blue: a perfect match, red: poor,<br>"
    "a fitness of 0.2 and more.";

RichParameterList parameters(const MeshDocument&) {
  RichParameterList list;
  list.addParam(RichInt("pairs", 50, "Pairs", "Evenly spread; 0 = none."));
  list.addParam(RichBool("axis", true, "Axis", "The line where left meets right. A rotation has none."));
  list.addParam(RichFloat("lift", 0.003f, "Lift of the axis",
                          "How far the axis stands off the surface, over sqrt(area), to be seen whole; 0 = on it."));
  add_option(list, option_info("threads"));
  return list;
}

// The normal is for the light that MeshLab puts on points and lines, too.
void set_point(CVertexO& v, const Point3m& position, const Point3m& normal, double fitness) {
  v.P() = position;
  v.N() = normal;
  v.Q() = static_cast<Scalarm>(fitness);
  v.C() = meshlab_color(fitness_color(fitness));
}

// Where a point on a face is, and the surface's normal there.
std::pair<Point3m, Point3m> place_of(const CMeshO& m, const SurfacePoint& point) {
  Point3m position(0, 0, 0), normal(0, 0, 0);
  for (int c = 0; c < 3; ++c) {
    position += m.vert[point.vertex[c]].cP() * static_cast<Scalarm>(point.weight[c]);
    normal += m.vert[point.vertex[c]].cN() * static_cast<Scalarm>(point.weight[c]);
  }
  return {position, normal.Normalize()};
}

bool is_closed(const std::vector<SurfacePoint>& line) {
  return line.front().vertex == line.back().vertex && line.front().weight == line.back().weight;
}

FilterOutputs apply(const FilterRun& run) {
  MeshModel& layer = current_layer(run);
  const TriangleMesh mesh = mesh_of(layer.cm);
  const Partners partners = stored_partners(layer, mesh);
  const int count = run.parameters.getInt("pairs");
  if (count < 0) throw InvalidOption("pairs must be at least 0, got " + std::to_string(count));
  const auto lift = static_cast<Scalarm>(run.parameters.getFloat("lift") *
                                         std::sqrt(vcg::tri::Stat<CMeshO>::ComputeMeshArea(layer.cm)));
  if (!(lift >= 0)) throw InvalidOption("lift must be at least 0");
  const bool has_sides = std::any_of(partners.side.begin(), partners.side.end(), [](int side) { return side != 0; });
  const bool wants_axis = run.parameters.getBool("axis") && has_sides;
  const Context context = context_of(run);
  run.progress(10, "pairs");
  std::vector<SymmetricPair> pairs;
  if (count > 0) pairs = spread_pairs(mesh, partners, count, context);
  run.progress(40, "axis");
  std::vector<std::vector<SurfacePoint>> axis;
  if (wants_axis) axis = axis_lines(mesh, partners, run.parameters.getInt("threads"), context);

  compact(layer.cm);
  if (!pairs.empty()) {
    CMeshO& links = add_layer(run, layer, "Symmetric pairs", 2 * pairs.size());
    Allocator::AddEdges(links, pairs.size());
    for (int i = 0; i < static_cast<int>(pairs.size()); ++i)
      for (int end = 0; end < 2; ++end) {
        const CVertexO& v = layer.cm.vert[end == 0 ? pairs[i].vertex : pairs[i].partner];
        set_point(links.vert[2 * i + end], v.cP(), v.cN(), pairs[i].fitness);
        links.edge[i].V(end) = &links.vert[2 * i + end];
      }
    vcg::tri::UpdateBounding<CMeshO>::Box(links);
  }
  std::size_t points = 0, segments = 0;
  for (const auto& line : axis) {
    points += line.size() - is_closed(line);
    segments += line.size() - 1;
  }
  if (points > 0) {
    CMeshO& drawn = add_layer(run, layer, "Symmetry axis", points);
    Allocator::AddEdges(drawn, segments);
    int point = 0, segment = 0;
    for (const auto& line : axis) {
      const int first = point, own = static_cast<int>(line.size()) - is_closed(line);
      for (int k = 0; k < own; ++k) {
        const auto [position, normal] = place_of(layer.cm, line[k]);
        set_point(drawn.vert[point++], position + normal * lift, normal, value_at(partners.fitness, line[k]));
      }
      for (int k = 0; k + 1 < static_cast<int>(line.size()); ++k, ++segment) {
        drawn.edge[segment].V(0) = &drawn.vert[first + k];
        drawn.edge[segment].V(1) = &drawn.vert[first + (k + 1) % own];
      }
    }
    vcg::tri::UpdateBounding<CMeshO>::Box(drawn);
  }
  run.log("Drawn: " + std::to_string(pairs.size()) + " pairs, an axis of " + std::to_string(axis.size()) +
          (axis.size() == 1 ? " line with " : " lines with ") + std::to_string(points) + " points");
  if (run.parameters.getBool("axis") && !has_sides) run.warn("a rotation has no axis line");
  return {{"pairs", static_cast<int>(pairs.size())}, {"axis_lines", static_cast<int>(axis.size())}};
}

}  // namespace

Filter show_pairs_filter() {
  return {"Intrinsic Symmetry: Show Pairs and Axis",
          "generate_polyline_from_intrinsic_symmetry",
          info,
          GA_SYMMETRY_FILTER_INTERFACE::Quality,
          MeshModel::MM_NONE,
          parameters,
          apply};
}

}  // namespace ga_symmetry
