// SPDX-License-Identifier: GPL-3.0-or-later
// ga_symmetry mirror: a table of values at the vertices, or sculpted shape, carried to the other side.
#include "ga_symmetry/mirror.h"

#include <cstdio>
#include <memory>
#include <string>

#include "arguments.h"
#include "commands.h"
#include "ga_symmetry/io.h"
#include "io/value_table.h"
#include "table.h"
#include "util/csv.h"

namespace ga_symmetry::tool {
namespace {

struct Arguments {
  std::string mesh, partners, values, output;
  Transfer transfer = Transfer::left_to_right;
  int threads = 0;
};

bool is_table(const std::string& path) { return path.size() >= 4 && path.compare(path.size() - 4, 4, ".csv") == 0; }

void report(const TransferPlan& plan, const char* what) {
  std::fprintf(stderr, "ga_symmetry: %d vertices changed, %d kept their %s for want of a partner\n", plan.changed,
               plan.without_partner, what);
}

void mirror_values(const Arguments& a, const Context& interrupt) {
  if (wants_drawing(a.output)) throw CLI::ValidationError("--output", "must end in .csv, got " + a.output);
  const TriangleMesh mesh = read_mesh(a.mesh, interrupt);
  const TransferPlan plan = plan_transfer(read_checked_partners(a.partners, mesh), a.transfer);
  ValueTable values = read_value_table(a.values, mesh.vertices());
  for (auto& column : values.columns) column = transferred(column, plan, a.transfer);
  CsvWriter table("");
  table.cell("vertex");
  for (const std::string& name : values.names) table.cell(name);
  table.end_row();
  for (int v = 0; v < mesh.vertices(); ++v) {
    table.cell(v);
    for (const auto& column : values.columns) table.cell(column[v]);
    table.end_row();
  }
  deliver(a.output, table.text());
  report(plan, "values");
}

void mirror_sculpt(const Arguments& a, const Context& interrupt) {
  if (a.output.empty() || !wants_drawing(a.output))
    throw CLI::ValidationError("--output", "must end in .ply for a sculpted mesh, got " + a.output);
  ProgressBar bar;
  const TriangleMesh before = read_mesh(a.mesh, interrupt), after = read_mesh(a.values, interrupt);
  const Partners partners = read_checked_partners(a.partners, before);
  const std::vector<double> position =
      transferred_shape(before, after, partners, a.transfer, a.threads, bar.watch(interrupt));
  bar.clear();
  deliver(a.output, to_ply({position, {}, {}, after.triangle}));
  report(plan_transfer(partners, a.transfer), "shape");
}

void run(const Arguments& a, const Context& interrupt) {
  is_table(a.values) ? mirror_values(a, interrupt) : mirror_sculpt(a, interrupt);
}

}  // namespace

void add_mirror(CLI::App& app, Run& chosen) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& command = *app.add_subcommand("mirror", "Carry weights, other values or sculpted shape to the other side");
  add_mesh(command, arguments->mesh);
  add_partners(command, arguments->partners);
  command
      .add_option("VALUES", arguments->values,
                  "CSV with the column vertex and columns of numbers, every vertex once; or the mesh after sculpting, "
                  "with the same vertices")
      ->required()
      ->type_name("");
  add_choice(command, "--direction", arguments->transfer,
             {{"left-to-right", Transfer::left_to_right},
              {"right-to-left", Transfer::right_to_left},
              {"swap", Transfer::swap},
              {"average", Transfer::average}},
             "Who takes whose values");
  add_threads(command, arguments->threads);
  add_output(command, arguments->output, "Result: .csv with the same columns; .ply of a sculpted mesh");
  command.footer(
      "A vertex without a partner keeps its values. Sculpted shape is the difference between the two meshes; average "
      "makes it symmetric. Left is where the side is +1 in PARTNERS.\n\n"
      "Examples:\n"
      "  ga_symmetry find body.ply -o body.csv\n"
      "  ga_symmetry mirror body.ply body.csv weights.csv -o mirrored.csv\n"
      "  ga_symmetry mirror body.ply body.csv weights.csv --direction average -o even.csv\n"
      "  ga_symmetry mirror body.ply body.csv sculpted.ply -o both_sides.ply");
  command.callback([arguments, &chosen] { chosen = [arguments](const Context& c) { run(*arguments, c); }; });
}

}  // namespace ga_symmetry::tool
