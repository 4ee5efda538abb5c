// "Intrinsic Symmetry: Find Partners".
#include <iterator>

#include "filters.h"
#include "ga_symmetry/export.h"
#include "ga_symmetry/symmetry.h"
#include "layers.h"

namespace ga_symmetry {
namespace {

// Short lines: the dialog of 2020.09 cuts its last row off where this text is wrapped, and its help after two lines of
// some 42 letters.
constexpr const char* info =
    "Finds every vertex's partner on the other side, in any pose.<br>"
    "<b>First select four vertices:</b> two on the symmetry axis<br>"
    "(nose and tail) and a left-right pair (two feet).<br>"
    "Attributes: symmetry_partner, _fitness, _side.<br>"
    "Colour: blue is a perfect match, red a poor one.";

// The weights of the joint search's cost share one line of the dialog.
constexpr double JointOptions::*joint_weights[] = {&JointOptions::distance_weight,    &JointOptions::orientation_weight,
                                                   &JointOptions::continuity_weight,  &JointOptions::descriptor_weight,
                                                   &JointOptions::bijectivity_weight, &JointOptions::reference_weight};

QString weights_text(const JointOptions& options) {
  QStringList items;
  for (const auto weight : joint_weights) items << QString::number(options.*weight);
  return items.join(",");
}

void set_weights(const QString& text, JointOptions& options) {
  const QStringList items = text.split(',');
  bool good = items.size() == static_cast<int>(std::size(joint_weights));
  for (int i = 0; good && i < items.size(); ++i) options.*joint_weights[i] = items[i].toDouble(&good);
  if (!good)
    throw InvalidOption("the weights must be six numbers such as " + weights_text({}).toStdString() + ", got " +
                        text.toStdString());
}

RichParameterList parameters() {
  const Options defaults;
  const PairsOptions& pairs = defaults.pairs;
  const JointOptions& joint = defaults.joint;
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
                        "Vertices. Meshes of over 1.5 times as many are searched simplified; 0 = never.");
  add_advanced<RichInt>(list, "rank", defaults.rank, "Symmetry by rank",
                        "1 = the best that is found, 2 = the next best, ... up to 30.");
  add_advanced<RichFloat>(list, "max_fitness", defaults.max_fitness, "Largest fitness",
                          "Vertices above get no partner (-1): try 0.08. 0 = keep all.");
  add_advanced<RichBool>(list, "local_refinement", defaults.local_refinement, "Local refinement",
                         "Joint: move all partners of samples to where distances agree best.");
  add_advanced<RichBool>(list, "noise_filter", defaults.noise_filter, "Noise filter",
                         "Joint: average over neighbours how far distances are off.");
  add_advanced<RichFloat>(list, "mutation_probability", joint.mutation_probability, "Mutation probability",
                          "Per gene (Joint) or pair (Pairs) and generation, 0 to 1.");
  add_advanced<RichInt>(list, "joint_samples", joint.samples, "Joint: samples",
                        "Evenly spaced samples that the search works on, 20 to 1000.");
  add_advanced<RichInt>(list, "joint_sites", joint.sites, "Joint: sites",
                        "Evenly spaced candidates for their partners, at least as many, up to 5000.");
  add_advanced<RichInt>(list, "joint_population", joint.population, "Joint: population",
                        "Maps in competition, 4 to 10000.");
  add_advanced<RichInt>(list, "joint_generations", joint.max_generations, "Joint: generations", "At most, 0 to 10000.");
  add_advanced<RichString>(list, "joint_weights", weights_text(joint), "Joint: weights",
                           "Distance, orientation, continuity, descriptor, bijectivity, reference.");
  add_advanced<RichEnum>(list, "pairs_error", static_cast<int>(pairs.error), QStringList{"Squared", "Linear"},
                         "Pairs: fitness",
                         "The relative error of the distances to the axis points, squared or absolute.");
  add_advanced<RichInt>(list, "pairs_samples", pairs.samples, "Pairs: samples", "On both sides together, 20 to 20000.");
  add_advanced<RichEnum>(list, "pairs_sampling", static_cast<int>(pairs.sampling),
                         QStringList{"Evenly spaced", "Uniform"}, "Pairs: sampling", "How the samples are chosen.");
  add_advanced<RichInt>(list, "pairs_individuals", pairs.individuals, "Pairs: individuals",
                        "Pairs in competition per reference vertex, 1 to 100.");
  add_advanced<RichInt>(list, "pairs_regions", pairs.regions, "Pairs: regions",
                        "Distance regions per axis point, for the crossover, 2 to 100.");
  add_advanced<RichFloat>(list, "pairs_outlier_z", pairs.outlier_z, "Pairs: outlier threshold",
                          "A pair whose Z-error is above is mutated; at least 0.");
  add_advanced<RichFloat>(list, "pairs_barrier_z", pairs.mutation_barrier_z, "Pairs: mutation barrier",
                          "A pair whose Z-error is below is kept as it is; at most 0.");
  add_advanced<RichInt>(list, "pairs_generations", pairs.max_generations, "Pairs: generations",
                        "At most, 1 to 100000.");
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
  options.local_refinement = list.getBool("local_refinement");
  options.noise_filter = list.getBool("noise_filter");

  options.joint.samples = list.getInt("joint_samples");
  options.joint.sites = list.getInt("joint_sites");
  options.joint.population = list.getInt("joint_population");
  options.joint.max_generations = list.getInt("joint_generations");
  set_weights(list.getString("joint_weights"), options.joint);
  options.joint.mutation_probability = decimal(list.getFloat("mutation_probability"));

  options.pairs.error = static_cast<PairError>(list.getEnum("pairs_error"));
  options.pairs.samples = list.getInt("pairs_samples");
  options.pairs.sampling = static_cast<Sampling>(list.getEnum("pairs_sampling"));
  options.pairs.individuals = list.getInt("pairs_individuals");
  options.pairs.regions = list.getInt("pairs_regions");
  options.pairs.outlier_z = decimal(list.getFloat("pairs_outlier_z"));
  options.pairs.mutation_barrier_z = decimal(list.getFloat("pairs_barrier_z"));
  options.pairs.mutation_probability = options.joint.mutation_probability;
  options.pairs.max_generations = list.getInt("pairs_generations");
  return options;
}

// The text rules; without it four selected vertices do; without those, and if allowed, there are none.
References choose_references(const std::string& text, bool automatic, const CMeshO& m, const TriangleMesh& mesh) {
  const References given = parse_references(text);
  if (!given.empty()) return given;
  std::vector<int> selected;
  for (std::size_t i = 0; i < m.vert.size(); ++i)
    if (m.vert[i].IsS()) selected.push_back(static_cast<int>(i));
  if (selected.size() == 4)
    return references_from_selection(mesh, {selected[0], selected[1], selected[2], selected[3]});
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
          std::to_string(result.partner.size()) + " vertices matched, " + std::to_string(result.pairs.size()) +
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
  const TriangleMesh mesh = to_triangle_mesh(m);
  options.references = choose_references(run.parameters.getString("references").toStdString(),
                                         run.parameters.getBool("automatic"), m, mesh);

  const Result result = find_symmetry(mesh, options, context_of(run));
  if (!path.empty()) write_result(path, mesh, result);
  store_partners(layer, {result.partner, result.fitness, result.side});
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
