// SPDX-License-Identifier: GPL-3.0-or-later
// ga_symmetry compare: this program's searches and others' side by side, where the truth is known.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "arguments.h"
#include "commands.h"
#include "measurement.h"
#include "methods.h"
#include "report.h"

namespace ga_symmetry::tool {
namespace {

struct Arguments {
  std::vector<std::string> meshes;
  std::string truth, output;
  comparison::Plan plan{{"naive", "kdtree", "pairs-squared", "pairs-linear", "features", "spectral", "zoomout", "joint",
                         "joint-zoomout", "spectral-auto", "zoomout-auto", "reversing-zoomout-auto", "joint-auto"},
                        {1, 2, 3}};
};

std::string join(const std::vector<std::string>& words, const char* between = ",") {
  std::string out;
  for (const std::string& w : words) out += (out.empty() ? "" : between) + w;
  return out;
}

// The call with all its defaults, as one would type it.
std::string command_line(const Arguments& a) {
  std::vector<std::string> words{"ga_symmetry", "compare"}, seeds;
  const auto add = [&](std::string word) {
    if (word.find_first_of(" '\"$&;()*?<>|\\") != word.npos) word = "'" + word + "'";
    words.push_back(word);
  };
  for (std::uint64_t seed : a.plan.seeds) seeds.push_back(std::to_string(seed));
  for (const std::string& mesh : a.meshes) add(mesh);
  if (!a.truth.empty()) words.push_back("--truth"), add(a.truth);
  words.push_back("--seeds"), add(join(seeds));
  words.push_back("--methods"), add(join(a.plan.methods));
  words.push_back("--repeats"), add(std::to_string(a.plan.repeats));
  if (a.plan.threads) words.push_back("--threads"), add(std::to_string(a.plan.threads));
  words.push_back("-o"), add(a.output);
  return join(words, " ");
}

void run(const Arguments& a, const Context& interrupt) {
  comparison::check_report_folder(a.output);
  comparison::check_plan(a.plan);
  ProgressBar bar;
  const Context context = bar.watch(interrupt);
  context.report(0, "reading");
  const auto subjects = comparison::read_subjects(a.meshes, a.truth, interrupt);
  const comparison::Comparison figures = comparison::measure(subjects, a.plan, context);
  context.report(1, "report");
  const std::string missing = comparison::write_report(a.output, command_line(a), figures, interrupt);
  bar.clear();
  for (const std::string& note : figures.notes) std::fprintf(stderr, "ga_symmetry: %s\n", note.c_str());
  if (!missing.empty()) std::fprintf(stderr, "ga_symmetry: %s\n", missing.c_str());
  const std::filesystem::path folder(a.output), page = folder / "report.html";
  std::printf("%s\n", (std::filesystem::exists(page) ? page : folder).string().c_str());
}

}  // namespace

void add_compare(CLI::App& app, Run& chosen) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& command =
      *app.add_subcommand("compare", "Compare the searches with other methods, where the truth is known");
  command.add_option("MESH", arguments->meshes, "Triangle meshes: .ply, .off, .obj or .stl")->required()->type_name("");
  command
      .add_option("--truth", arguments->truth,
                  "Folder with NAME.truth and NAME.refs, or NAME.vts and NAME.sym.vts, or NAME.pid and NAME.sym.info; "
                  "without it each mesh's own")
      ->type_name("DIR");
  command.add_option("-o,--output", arguments->output, "Folder for the report, which must not exist")
      ->required()
      ->type_name("DIR");
  command.add_option("--seeds", arguments->plan.seeds, "Of the random numbers [1,2,3]")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::NonNegativeNumber.description(""))
      ->type_name("N,N");
  std::vector<std::string> names;
  for (const comparison::Method& m : comparison::methods()) names.push_back(m.name);
  command
      .add_option("--methods", arguments->plan.methods,
                  "Of " + join(names, ", ") + " [all but zoomout-full and joint-zoomout-auto]")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NAME,NAME");
  command.add_option("--repeats", arguments->plan.repeats, "Each method so often, for the times")
      ->capture_default_str();
  add_threads(command, arguments->plan.threads);
  command.footer(
      "Writes CSV and JSON files of every number, and report.html, which needs no network. The page takes "
      "python3-jinja2, "
      "its plots python3-matplotlib.\n\n"
      "Examples:\n"
      "  ga_symmetry compare sample_meshes/person_*.off -o report\n"
      "  ga_symmetry compare scans/*.off --truth landmarks --seeds 1,2,3,4,5 --repeats 3 -o report\n"
      "  ga_symmetry compare body.off --methods joint,zoomout,naive -o report");
  command.callback([arguments, &chosen] { chosen = [arguments](const Context& c) { run(*arguments, c); }; });
}

}  // namespace ga_symmetry::tool
