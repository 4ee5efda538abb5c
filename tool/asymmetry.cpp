// SPDX-License-Identifier: GPL-3.0-or-later
// ga_symmetry asymmetry: where the two sides differ.
#include "ga_symmetry/asymmetry.h"

#include <memory>
#include <string>

#include "arguments.h"
#include "commands.h"
#include "ga_symmetry/io.h"
#include "table.h"
#include "util/csv.h"

namespace ga_symmetry::tool {
namespace {

struct Arguments {
  std::string mesh, partners, output;
  AsymmetryOptions options;
};

void run(const Arguments& a, const Context& interrupt) {
  const bool drawing = wants_drawing(a.output);
  ProgressBar bar;
  const TriangleMesh mesh = read_mesh(a.mesh, interrupt);
  const auto values = asymmetry(mesh, read_checked_partners(a.partners, mesh), a.options, bar.watch(interrupt));
  bar.clear();
  if (drawing) return deliver(a.output, to_ply({mesh.position, values, {}, mesh.triangle}));
  CsvWriter table("vertex,asymmetry");
  for (std::size_t v = 0; v < values.size(); ++v) table.cell(static_cast<int>(v)).cell(values[v]).end_row();
  deliver(a.output, table.text());
}

}  // namespace

void add_asymmetry(CLI::App& app, Run& chosen) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& command = *app.add_subcommand("asymmetry", "Measure where the two sides differ");
  add_mesh(command, arguments->mesh);
  add_partners(command, arguments->partners);
  add_choice(command, "--measure", arguments->options.measure,
             {{"area", AsymmetryMeasure::area},
              {"length", AsymmetryMeasure::length},
              {"curvature", AsymmetryMeasure::curvature}},
             "What is compared around each vertex");
  command
      .add_option("--radius", arguments->options.radius,
                  "Of the discs that are compared, over the square root of the surface's area, up to 1")
      ->capture_default_str();
  add_threads(command, arguments->options.threads);
  add_output(command, arguments->output, "Result: .csv (vertex,asymmetry) or .ply (the mesh with it as quality)");
  command.footer(
      "Positive: the vertex's own side has more; area and length: 0.1 = 10 % more. A vertex without a partner gets "
      "0.\n\n"
      "Examples:\n"
      "  ga_symmetry find skull.ply -o skull.csv\n"
      "  ga_symmetry asymmetry skull.ply skull.csv -o differences.ply\n"
      "  ga_symmetry asymmetry skull.ply skull.csv --measure curvature --radius 0.05 -o differences.csv");
  command.callback([arguments, &chosen] { chosen = [arguments](const Context& c) { run(*arguments, c); }; });
}

}  // namespace ga_symmetry::tool
