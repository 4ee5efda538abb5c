// "Intrinsic Symmetry: Show Pairs and Axis".
#include "filters.h"
#include "ga_symmetry/errors.h"
#include "ga_symmetry/export.h"
#include "ga_symmetry/lines.h"
#include "layers.h"

namespace ga_symmetry {
namespace {

constexpr const char* info =
    "Draws what Find Partners has found, in new layers:<br>"
    "lines that link evenly spread pairs, and the<br>"
    "symmetry axis on the surface.<br>"
    "Colour: blue is a perfect match, red a poor one.";

RichParameterList parameters() {
  RichParameterList list;
  list.addParam(RichInt("pairs", 50, "Pairs", "Evenly spread; 0 = none."));
  list.addParam(RichBool("axis", true, "Axis", "The line where left meets right. A rotation has none."));
  add_advanced<RichInt>(list, "threads", 0, "Threads", "0 to 256; 0 = all cores. Changes the time, never the result.");
  return list;
}

void set_point(CMeshO& m, int i, const std::array<double, 3>& position, double fitness, double top) {
  for (int k = 0; k < 3; ++k) m.vert[i].P()[k] = static_cast<Scalarm>(position[k]);
  m.vert[i].Q() = static_cast<Scalarm>(fitness);
  m.vert[i].C() = fitness_color(fitness, top);
}

FilterOutputs apply(const FilterRun& run) {
  MeshModel& layer = current_layer(run);
  const TriangleMesh mesh = to_triangle_mesh(layer.cm);
  const Partners partners = stored_partners(layer, mesh);
  const int count = run.parameters.getInt("pairs");
  if (count < 0) throw InvalidOption("pairs must be at least 0, got " + std::to_string(count));
  const bool has_sides = std::any_of(partners.side.begin(), partners.side.end(), [](int side) { return side != 0; });
  const bool wants_axis = run.parameters.getBool("axis") && has_sides;
  const Context context = context_of(run);
  run.progress(10, "pairs");
  std::vector<SymmetricPair> pairs;
  if (count > 0) pairs = spread_pairs(mesh, partners, count, context);
  run.progress(40, "axis");
  std::vector<std::vector<SurfacePoint>> axis;
  if (wants_axis) axis = axis_lines(mesh, partners, run.parameters.getInt("threads"), context);

  const double top = ramp_top(partners.partner, partners.fitness);
  if (!pairs.empty()) {
    CMeshO& links = add_layer(run, layer, "Symmetric pairs", 2 * pairs.size());
    Allocator::AddEdges(links, pairs.size());
    for (int i = 0; i < static_cast<int>(pairs.size()); ++i)
      for (int end = 0; end < 2; ++end) {
        const int v = end == 0 ? pairs[i].vertex : pairs[i].partner;
        const double* p = &mesh.position[3 * static_cast<std::size_t>(v)];
        set_point(links, 2 * i + end, {p[0], p[1], p[2]}, pairs[i].fitness, top);
        links.edge[i].V(end) = &links.vert[2 * i + end];
      }
    vcg::tri::UpdateBounding<CMeshO>::Box(links);
  }
  std::size_t points = 0, segments = 0;
  for (const auto& line : axis) {
    // A closed line's last point is its first.
    const bool closed = line.front().vertex == line.back().vertex && line.front().weight == line.back().weight;
    points += line.size() - closed;
    segments += line.size() - 1;
  }
  if (points > 0) {
    CMeshO& drawn = add_layer(run, layer, "Symmetry axis", points);
    Allocator::AddEdges(drawn, segments);
    int point = 0, segment = 0;
    for (const auto& line : axis) {
      const bool closed = line.front().vertex == line.back().vertex && line.front().weight == line.back().weight;
      const int first = point, own = static_cast<int>(line.size()) - closed;
      for (int k = 0; k < own; ++k)
        set_point(drawn, point++, position_of(mesh, line[k]), value_at(partners.fitness, line[k]), top);
      for (int k = 0; k + 1 < static_cast<int>(line.size()); ++k, ++segment) {
        drawn.edge[segment].V(0) = &drawn.vert[first + k];
        drawn.edge[segment].V(1) = &drawn.vert[first + (k + 1) % own];
      }
    }
    vcg::tri::UpdateBounding<CMeshO>::Box(drawn);
  }
  run.log("Drawn: " + std::to_string(pairs.size()) + " pairs, an axis of " + std::to_string(axis.size()) +
          " lines with " + std::to_string(points) + " points");
  if (run.parameters.getBool("axis") && !has_sides) run.warn("Warning: a rotation has no axis line");
  return {{"pairs", static_cast<int>(pairs.size())}, {"axis_lines", static_cast<int>(axis.size())}};
}

}  // namespace

Filter show_pairs_filter() {
  return {"Intrinsic Symmetry: Show Pairs and Axis",
          "generate_polyline_from_intrinsic_symmetry",
          info,
          GA_SYMMETRY_FILTER_INTERFACE::Quality,
          parameters,
          apply};
}

}  // namespace ga_symmetry
