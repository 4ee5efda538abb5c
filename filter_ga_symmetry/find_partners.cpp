// "Intrinsic Symmetry: Find Partners".
#include "filters.h"
#include "ga_symmetry/io.h"
#include "ga_symmetry/symmetry.h"
#include "layers.h"
#include "option_text.h"

namespace ga_symmetry {
namespace {

// Short lines: the dialog of 2020.09 cuts its last row off where this text is wrapped, and its help after two lines of
// some 42 letters.
constexpr const char* info =
    "Finds every vertex's partner on the<br>"
    "other side, in any pose.<br>"
    "<b>First select four vertices:</b> two on the<br>"
    "symmetry axis (nose and tail) and a<br>"
    "left-right pair (two feet).<br>"
    "Attributes: symmetry_partner, _fitness, _side.<br>"
    "Colour: blue is a perfect match, red a poor one.";

RichParameterList parameters() {
  const Options defaults;
  RichParameterList list;
  list.addParam(RichString("references", "", "References",
                           "a0,a1,l,r: axis points and a left-right pair. Or 3,8,12:57,90:4. Empty = selection."));
  list.addParam(RichBool("automatic", false, "Without references: search for the symmetry",
                         "If nothing is selected, find the symmetry from the shape alone."));
  list.addParam(RichEnum("symmetry", static_cast<int>(defaults.symmetry), {"Reflection", "Rotation"}, "Symmetry",
                         "Reflection swaps left and right; Rotation takes every vertex to the next one around."));
  list.addParam(RichSaveFile("export_to", "", "*.csv *.json *.ply", "Export to",
                             "Also write the partners: .csv, .json (everything) or .ply (coloured mesh)."));
  list.addParam(RichBool("largest_component", defaults.largest_component, "Only the largest component",
                         "Instead of refusing a mesh of several components."));
  list.addParam(RichEnum("method", static_cast<int>(defaults.method), {"Joint", "Pairs"}, "Method",
                         "Joint: all partners at once, accurate. Pairs: the original, one by one."));

  add_advanced<RichInt>(list, "seed", static_cast<int>(defaults.seed), "Seed",
                        "At least 0. The same seed and mesh give the same result.");
  add_advanced<RichInt>(list, "threads", defaults.threads, "Threads",
                        "0 to 256; 0 = all cores. Changes the time, never the result.");
  add_advanced<RichInt>(list, "proxy", defaults.proxy, "Simplify to",
                        "Vertices. Meshes of over 1.3 times as many are searched simplified; 0 = never.");
  add_advanced<RichInt>(list, "rank", defaults.rank, "Symmetry by rank",
                        "1 = the best that is found, 2 = the next best, ... up to 30.");
  add_advanced<RichFloat>(list, "max_fitness", defaults.max_fitness, "Largest fitness",
                          "Vertices above get no partner (-1): try 0.08. 0 = keep all.");
  add_advanced<RichInt>(list, "joint_samples", defaults.joint.samples, "Samples",
                        "Joint: evenly spaced, what the search works on; 20 to 1000.");
  add_advanced<RichString>(list, "advanced", "", "Advanced options",
                           "Such as joint_sites=400, fitness=linear; ? lists all keys.");
  return list;
}

Options to_options(const RichParameterList& list) {
  Options options;
  options.symmetry = static_cast<SymmetryKind>(list.getEnum("symmetry"));
  options.method = static_cast<Method>(list.getEnum("method"));
  options.largest_component = list.getBool("largest_component");
  const int seed = list.getInt("seed");
  if (seed < 0) throw InvalidOption("seed must be at least 0, got " + std::to_string(seed));
  options.seed = static_cast<std::uint64_t>(seed);
  options.threads = list.getInt("threads");
  options.proxy = list.getInt("proxy");
  options.rank = list.getInt("rank");
  options.max_fitness = decimal(list.getFloat("max_fitness"));
  options.joint.samples = list.getInt("joint_samples");
  set_options(list.getString("advanced").toStdString(), options);
  return options;
}

// The text rules; without it four selected vertices do; without those, and if allowed, there are none.
References choose_references(const std::string& text, bool automatic, const CMeshO& m, const TriangleMesh& mesh,
                             const Options& options, const Context& context) {
  References given = parse_references(text);
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
  throw InvalidOption(
      "select exactly four vertices: two on the symmetry axis and one left-right pair; " +
      std::to_string(selected.size()) +
      " are selected (or give references by index, or select none and allow the search without references)");
}

void log_summary(const Result& result, const FilterRun& run) {
  std::string used;
  for (int v : result.axis_references) used += (used.empty() ? "" : ",") + std::to_string(v);
  for (const auto& p : result.pair_references)
    used += (used.empty() ? "" : ",") + std::to_string(p[0]) + ":" + std::to_string(p[1]);
  run.log("References: " + (used.empty() ? std::string("none") : used));
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
  for (const std::string& warning : result.warnings) run.warn("Warning: " + warning);
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
  options.references =
      choose_references(run.parameters.getString("references").toStdString(), run.parameters.getBool("automatic"), m,
                        mesh, options, context.part(0, kSelectionRead));

  const Result result = find_symmetry(mesh, options, context.part(kSelectionRead, 1));
  if (!path.empty()) write_result(path, mesh, result);
  store_partners(layer, result.partners);
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
          parameters,
          apply};
}

}  // namespace ga_symmetry
