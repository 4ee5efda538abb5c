// SPDX-License-Identifier: GPL-3.0-or-later
// ga_symmetry find: a mesh in, its partners out; or many.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "arguments.h"
#include "commands.h"
#include "find_many.h"
#include "ga_symmetry/io.h"
#include "ga_symmetry/symmetry.h"

namespace ga_symmetry::tool {
namespace {

enum class Summary { unasked, text, json };

struct Arguments {
  std::vector<std::string> meshes, outputs, formats;
  std::string references;
  ColorBy color_by = ColorBy::fitness;
  bool reference_files = false, redo = false, list = false;
  Summary summary = Summary::unasked;
  bool quiet = false;
  Options options;
  std::vector<std::string> given;  // of the options
};

constexpr const char* kExamples =
    "Examples:\n"
    "  ga_symmetry find body.ply -o body.csv                     search without references\n"
    "  ga_symmetry find body.ply --refs 12,40,7,9 -o body.csv    12 and 40 on the axis, 7 and 9 a pair\n"
    "  ga_symmetry find body.ply --refs 12,40,7:9,3:5 -o body.csv -o body.ply\n"
    "  ga_symmetry find body.ply --refs 12,40,7,9 --method pairs --fitness linear\n"
    "  ga_symmetry find body.ply --summary json -o body.csv | jq .mean_fitness\n"
    "  ga_symmetry find flower.ply --list                        all its reflections and rotations\n"
    "  ga_symmetry find scans/ -o results/                       every mesh of a folder, results/NAME.csv for each\n"
    "  ga_symmetry find a.ply b.ply --refs-files -o results/ --format csv,ply\n"
    "\n"
    "Without -o a summary is printed and no file is written.\n"
    "Exit status: 0 done, 1 could not (nothing is written; of many: for some), 2 wrong usage, 130 interrupted.";

std::string join(const References& references) {
  std::string out;
  const auto add = [&](const std::string& item) { out += (out.empty() ? "" : ",") + item; };
  for (int v : references.axis) add(std::to_string(v));
  for (const auto& p : references.pairs) add(std::to_string(p[0]) + ":" + std::to_string(p[1]));
  return out.empty() ? "none" : out;
}

void print_summary(const Result& r) {
  std::printf("symmetry      %s of order %d, %zu found, confidence %.2f\n", to_string(r.kind), r.order,
              r.symmetries.size(), r.confidence);
  if (!r.surface.empty()) std::printf("surface       %s\n", r.surface.c_str());
  std::printf("references    %s\n", join({r.axis_references, r.pair_references}).c_str());
  std::printf("pairs         %zu\n", r.pairs.size());
  std::printf("matched       %d of %zu vertices\n", r.matched, r.partners.partner.size());
  std::printf("mean fitness  %.6g\n", r.mean_fitness);
  std::printf("generations   %zu (stopped: %s)\n", r.log.size(), to_string(r.stop));
  std::printf("seconds      ");
  double total = 0;
  for (const StageTime& s : r.seconds) {
    std::printf(" %s %.2f,", s.stage.c_str(), s.seconds);
    total += s.seconds;
  }
  std::printf(" total %.2f\n", total);
}

void print_summary_json(const Result& r) {
  nlohmann::ordered_json json{{"kind", to_string(r.kind)},
                              {"order", r.order},
                              {"symmetries", r.symmetries.size()},
                              {"confidence", r.confidence},
                              {"axis_references", r.axis_references},
                              {"pair_references", r.pair_references},
                              {"pairs", r.pairs.size()},
                              {"vertices", r.partners.partner.size()},
                              {"matched", r.matched},
                              {"mean_fitness", r.mean_fitness},
                              {"generations", r.log.size()},
                              {"stop", to_string(r.stop)},
                              {"surface", r.surface},
                              {"warnings", r.warnings}};
  for (const StageTime& s : r.seconds) json["seconds"][s.stage] = s.seconds;
  std::printf("%s\n", json.dump(2).c_str());
}

bool is_folder(const std::string& path) {
  return std::filesystem::is_directory(path) || (!path.empty() && path.back() == '/');
}

References references_of(const Arguments& a, const std::string& mesh) {
  if (!a.reference_files) return parse_references(a.references);
  return read_references(std::filesystem::path(mesh).replace_extension(".refs").string());
}

// What is wrong whatever the mesh is said before the first is read.
void check_arguments(const Arguments& a) {
  Options options = a.options;
  if (a.list) options.method = Method::joint;
  // References of files are not known yet; these stand for them.
  options.references = a.reference_files ? References{{0, 1}, {{2, 3}}} : parse_references(a.references);
  for (const IdleOption& idle : idle_options(options, a.list))
    if (std::find(a.given.begin(), a.given.end(), idle.name) != a.given.end())
      throw CLI::ValidationError(flag_of(option_info(idle.name)), "does nothing " + idle.why);
  check_options(options);
}

Result find_one(const Arguments& a, const std::string& path, const std::vector<std::string>& outputs,
                const std::string& place, const Context& interrupt) {
  Options options = a.options;
  options.references = references_of(a, path);
  ProgressBar bar(!a.quiet, place);
  const Context context = bar.watch(interrupt);
  const TriangleMesh mesh = read_mesh(path, context.part(0, 0.1));
  Result result = find_symmetry(mesh, options, context.part(0.1, 0.9));
  if (!outputs.empty()) write_results(outputs, mesh, result, context.part(0.9, 1), a.color_by);
  return result;
}

void run_one(const Arguments& a, const Context& interrupt) {
  for (const std::string& path : a.outputs) check_result_path(path);
  const Result result = find_one(a, a.meshes[0], a.outputs, "", interrupt);
  if (!a.quiet)
    for (const std::string& warning : result.warnings)
      std::fprintf(stderr, "ga_symmetry: warning: %s\n", warning.c_str());
  if (a.summary == Summary::json)
    print_summary_json(result);
  else if (a.outputs.empty() || a.summary == Summary::text)
    print_summary(result);
}

void run_many(const Arguments& a, const Context& interrupt) {
  const auto refuse = [](const char* option, const std::string& why) { throw CLI::ValidationError(option, why); };
  if (a.outputs.size() != 1) refuse("--output", "must be one folder for several meshes");
  const std::string ending = std::filesystem::path(a.outputs[0]).extension().string();
  if (!is_folder(a.outputs[0]) && (ending == ".csv" || ending == ".json" || ending == ".ply"))
    refuse("--output", "must be a folder for several meshes, got " + a.outputs[0]);
  if (a.summary != Summary::unasked) refuse("--summary", "is for one mesh: the folder's summary.csv has them all");
  ManyMeshes many{a.meshes, a.outputs[0], a.formats, a.redo, a.quiet};
  if (many.formats.empty()) many.formats = {"csv"};
  find_many(many, [&](const std::string& mesh, const std::vector<std::string>& outputs, const std::string& place) {
    return find_one(a, mesh, outputs, place, interrupt);
  });
}

void run_list(const Arguments& a, const Context& interrupt) {
  if (a.meshes.size() > 1 || !a.outputs.empty())
    throw CLI::ValidationError("--list", "is for one mesh, and without -o");
  Options options = a.options;
  options.references = references_of(a, a.meshes[0]);
  std::vector<FoundSymmetry> found;
  {
    ProgressBar bar(!a.quiet);
    const Context context = bar.watch(interrupt);
    const TriangleMesh mesh = read_mesh(a.meshes[0], context.part(0, 0.1));
    found = list_symmetries(mesh, options, context.part(0.1, 1));
  }
  if (a.summary == Summary::json) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const FoundSymmetry& s : found)
      json.push_back({{"kind", to_string(s.kind)}, {"rank", s.rank}, {"order", s.order}, {"score", s.score}});
    std::printf("%s\n", json.dump(2).c_str());
    return;
  }
  std::printf("kind        rank  order  score\n");
  for (const FoundSymmetry& s : found)
    std::printf("%-10s %5d %6s %6.3f\n", to_string(s.kind), s.rank, s.order ? std::to_string(s.order).c_str() : "-",
                s.score);
}

void run(const Arguments& a, const Context& interrupt) {
  if (a.reference_files && !a.references.empty())
    throw CLI::ValidationError("--refs-files", "and --refs cannot both be given");
  check_arguments(a);
  const auto refuse_folder_options = [&](const char* why) {
    if (a.redo || !a.formats.empty()) throw CLI::ValidationError(a.redo ? "--redo" : "--format", why);
  };
  if (a.list) {
    refuse_folder_options("goes with a folder, which --list does not write");
    return run_list(a, interrupt);
  }
  if (a.meshes.size() > 1 || is_folder(a.meshes[0]) || std::any_of(a.outputs.begin(), a.outputs.end(), is_folder))
    return run_many(a, interrupt);
  refuse_folder_options("goes with a folder: -o FOLDER/");
  run_one(a, interrupt);
}

}  // namespace

void add_find(CLI::App& app, Run& chosen) {
  const auto arguments = std::make_shared<Arguments>();
  Options& options = arguments->options;
  CLI::App& find = *app.add_subcommand("find", "Find for every vertex its symmetric partner");
  find.footer(kExamples);
  find.add_option("MESH", arguments->meshes,
                  "Triangle mesh: .ply, .off, .obj or .stl; or several, or folders of them, with -o FOLDER")
      ->required()
      ->type_name("");
  find.add_option("-o,--output", arguments->outputs,
                  "Result, may be given several times: .csv (vertex,partner,fitness,side), .json (everything) or .ply "
                  "(the coloured mesh). A folder for many meshes: FOLDER/NAME.csv for each, and FOLDER/summary.csv; "
                  "meshes whose outputs are there are skipped, and one that fails does not stop the rest")
      ->allow_extra_args(false)
      ->type_name("FILE");
  const auto add_core_options = [&](CLI::App& group, std::optional<Method> method) {
    for (const OptionInfo& info : option_table())
      if (info.method == method && info.kind != OptionKind::references)
        add_core_option(group, info, options, arguments->given);
  };
  find.add_option(
          "--refs", arguments->references,
          "Known vertices, 0-based; " + option_info("references").help + "; without it they are found automatically")
      ->type_name("a0,a1,l,r");
  find.add_flag("--refs-files", arguments->reference_files,
                "Take the references of NAME.off from NAME.refs beside it, written as for --refs");
  find.add_option("--format", arguments->formats, "Of the outputs in a folder, may be several: csv,ply [csv]")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember({"csv", "json", "ply"}).description(""))
      ->type_name("csv|json|ply");
  find.add_flag("--redo", arguments->redo, "In a folder, also meshes whose outputs are there");
  add_core_options(find, std::nullopt);
  find.add_flag("--list", arguments->list,
                "Print all symmetries that the mesh has, reflections and rotations, best first, and write no partners");
  add_choice(find, "--summary", arguments->summary, {{"text", Summary::text}, {"json", Summary::json}},
             "Print the summary in this form, also beside -o");
  add_choice(find, "--color", arguments->color_by,
             {{"fitness", ColorBy::fitness}, {"symmetry", ColorBy::symmetry}, {"sides", ColorBy::sides}},
             "Of a .ply. fitness: blue at 0 to red at 0.2 and more; symmetry: both hands have one colour, the axis is "
             "dark; sides: left blue, right orange");
  find.add_flag("--quiet", arguments->quiet, "No progress and no warnings");

  add_core_options(*find.add_option_group("Method joint"), Method::joint);
  add_core_options(*find.add_option_group("Method pairs"), Method::pairs);

  find.callback([arguments, &chosen] { chosen = [arguments](const Context& context) { run(*arguments, context); }; });
}

}  // namespace ga_symmetry::tool
