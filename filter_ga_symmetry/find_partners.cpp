// SPDX-License-Identifier: GPL-3.0-or-later
// "Intrinsic Symmetry: Find Partners".
#include "filters.h"
#include "ga_symmetry/io.h"
#include "ga_symmetry/symmetry.h"
#include "layers.h"
#include "option_parameters.h"

namespace ga_symmetry {
namespace {

// Short lines: the dialog of 2020.09 cuts its last row off where this text is wrapped, and its help after two lines of
// some 42 letters.
constexpr const char* info =
    "Finds every vertex's partner on the<br>"
    "other side, in any pose.<br>"
    "<b>Just press Apply.</b> If that goes wrong, first<br>"
    "select four vertices: two on the symmetry<br>"
    "axis (nose, tail), a left-right pair (feet).<br>"
    "Attributes: symmetry_partner, _fitness, _side.<br>"
    "Colour: blue is a perfect match, red a<br>"
    "poor one, a fitness of 0.2 and more.";

RichParameterList parameters(const MeshDocument&) {
  RichParameterList list;
  const auto add = [&](OptionLevel level) {
    for (const OptionInfo& info : option_table())
      if (info.level == level && info.kind != OptionKind::references) add_option(list, info);
  };
  add_option(list, option_info("references"), " Empty = selection.");
  list.addParam(RichBool("automatic", true, "Without references: search for the symmetry",
                         "If nothing is selected, find the symmetry from the shape alone."));
  add(OptionLevel::basic);
  list.addParam(RichEnum("color_by", 0, {"Fitness", "Symmetry", "Sides"}, "Colour",
                         "Fitness: 0 blue, 0.1 green, 0.2 red. Symmetry: both hands alike. Sides: left blue."));
  list.addParam(RichSaveFile("export_to", "", "*.csv *.json *.ply", "Export to",
                             "Also write the partners: .csv, .json (everything) or .ply (coloured mesh)."));
  add(OptionLevel::advanced);
  add_advanced<RichString>(list, "advanced", "", "Advanced options",
                           "Such as joint_sites=400, fitness=linear; ? lists all keys.");
  return list;
}

Options to_options(const RichParameterList& list) {
  Options options;
  for (const OptionInfo& info : option_table())
    if (info.level != OptionLevel::expert) read_option(list, info, options);
  set_expert_options(options, list.getString("advanced").toStdString());
  return options;
}

// Without references in the text four selected vertices do; without those, and if allowed, there are none.
References choose_references(const References& given, bool automatic, const CMeshO& m, const TriangleMesh& mesh,
                             const Options& options, const Context& context) {
  if (!given.empty()) return given;
  std::vector<int> selected;
  int index = 0;
  for (const CVertexO& v : m.vert) {
    if (v.IsD()) continue;
    if (v.IsS()) selected.push_back(index);
    ++index;
  }
  if (selected.size() == 4)
    return references_from_selection(mesh, {selected[0], selected[1], selected[2], selected[3]}, options, context);
  if (selected.empty() && automatic) return {};
  if (selected.size() == 2) {
    const std::string a = std::to_string(selected[0]), b = std::to_string(selected[1]);
    throw InvalidOption("two vertices are selected: as References write " + a + "," + b +
                        " if both are on the symmetry axis, or " + a + ":" + b +
                        " if they are a left-right pair; or select four, or none");
  }
  throw InvalidOption("select four vertices, two on the symmetry axis and one left-right pair, or none; " +
                      std::to_string(selected.size()) + " are selected (or give references by index)");
}

void log_summary(const Result& result, const FilterRun& run) {
  std::string used;
  for (int v : result.axis_references) used += (used.empty() ? "" : ",") + std::to_string(v);
  for (const auto& p : result.pair_references)
    used += (used.empty() ? "" : ",") + std::to_string(p[0]) + ":" + std::to_string(p[1]);
  run.log("References: " + (used.empty() ? std::string("none") : used));
  if (!result.surface.empty()) run.log("Surface: " + result.surface);
  run.log("Found: " + std::string(to_string(result.kind)) + ", " + std::to_string(result.matched) + " of " +
          std::to_string(result.partners.partner.size()) + " vertices matched, " + std::to_string(result.pairs.size()) +
          " pairs of samples, mean fitness " + text("%.4g", result.mean_fitness) + ", confidence " +
          text("%.2f", result.confidence));
  run.log("Search: " + std::to_string(result.log.size()) + " generations, stopped: " + to_string(result.stop));
  std::string stages;
  double total = 0;
  for (const StageTime& stage : result.seconds) {
    stages += (stages.empty() ? "" : ", ") + stage.stage + text(" %.2f", stage.seconds);
    total += stage.seconds;
  }
  run.log("Seconds: " + text("%.2f", total) + " (" + stages + ")");
  for (const std::string& warning : result.warnings) run.warn(warning);
}

FilterOutputs apply(const FilterRun& run) {
  MeshModel& layer = current_layer(run);
  const CMeshO& m = layer.cm;

  Options options = to_options(run.parameters);
  const std::string path = run.parameters.getSaveFileName("export_to").toLocal8Bit().toStdString();
  if (!path.empty()) check_result_path(path);
  const TriangleMesh mesh = mesh_of(m);
  constexpr double kSelectionRead = 0.1;  // progress
  const Context context = context_of(run);
  options.references = choose_references(options.references, run.parameters.getBool("automatic"), m, mesh, options,
                                         context.part(0, kSelectionRead));

  const Result result = find_symmetry(mesh, options, context.part(kSelectionRead, 1));
  const auto color_by = static_cast<ColorBy>(run.parameters.getEnum("color_by"));
  const std::vector<Color> colors = vertex_colors(mesh, result.partners, color_by);
  if (!path.empty()) write_results({path}, mesh, result, {}, color_by);
  store_partners(layer, result.partners, colors);
  log_summary(result, run);
  return {{"matched", result.matched},
          {"mean_fitness", result.mean_fitness},
          {"confidence", result.confidence},
          {"generations", static_cast<int>(result.log.size())}};
}

}  // namespace

Filter find_partners_filter() {
  // Not of the class VertexColoring too: to a mesh without colours MeshLab adds them for it even when the filter fails.
  return {"Intrinsic Symmetry: Find Partners",
          "compute_intrinsic_symmetry_per_vertex",
          info,
          GA_SYMMETRY_FILTER_INTERFACE::Quality,
          MeshModel::MM_VERTCOLOR | MeshModel::MM_VERTQUALITY,
          parameters,
          apply};
}

}  // namespace ga_symmetry
