// SPDX-License-Identifier: GPL-3.0-or-later
// ga_symmetry pairs: evenly spread pairs of a symmetry that was found before.
#include <memory>
#include <string>

#include "arguments.h"
#include "commands.h"
#include "ga_symmetry/axis.h"
#include "ga_symmetry/io.h"
#include "table.h"
#include "util/csv.h"

namespace ga_symmetry::tool {
namespace {

struct Arguments {
  std::string mesh, partners, output;
  int count = 50;
};

void run(const Arguments& a, const Context& interrupt) {
  const bool drawing = wants_drawing(a.output);
  ProgressBar bar;
  const TriangleMesh mesh = read_mesh(a.mesh, interrupt);
  const auto pairs = spread_pairs(mesh, read_checked_partners(a.partners, mesh), a.count, bar.watch(interrupt));
  bar.clear();
  CsvWriter table("vertex,partner,fitness");
  Drawing links;
  for (const SymmetricPair& pair : pairs) {
    table.cell(pair.vertex).cell(pair.partner).cell(pair.fitness).end_row();
    const int n = static_cast<int>(links.quality.size());
    links.edges.push_back({n, n + 1});
    for (const int v : {pair.vertex, pair.partner}) {
      links.position.insert(links.position.end(), &mesh.position[3 * v], &mesh.position[3 * v] + 3);
      links.quality.push_back(pair.fitness);
    }
  }
  deliver(a.output, drawing ? to_ply(links) : table.text());
}

}  // namespace

void add_pairs(CLI::App& app, Run& chosen) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& command = *app.add_subcommand("pairs", "Choose evenly spread pairs of partners");
  add_mesh(command, arguments->mesh);
  add_partners(command, arguments->partners);
  command.add_option("--count", arguments->count, "Pairs, at least 1")->capture_default_str();
  add_output(command, arguments->output,
             "Result: .csv (vertex,partner,fitness) or .ply (lines that link the partners)");
  command.footer(
      "Examples:\n"
      "  ga_symmetry find body.ply -o body.csv\n"
      "  ga_symmetry pairs body.ply body.csv --count 30\n"
      "  ga_symmetry pairs body.ply body.csv -o links.ply");
  command.callback([arguments, &chosen] { chosen = [arguments](const Context& c) { run(*arguments, c); }; });
}

}  // namespace ga_symmetry::tool
