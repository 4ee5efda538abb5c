// SPDX-License-Identifier: GPL-3.0-or-later
// ga_symmetry axis: the centre line of a symmetry that was found before.
#include "ga_symmetry/axis.h"

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
  int threads = 0;
};

void run(const Arguments& a, const Context& interrupt) {
  const bool drawing = wants_drawing(a.output);
  ProgressBar bar;
  const TriangleMesh mesh = read_mesh(a.mesh, interrupt);
  const Partners partners = read_checked_partners(a.partners, mesh);
  const auto lines = axis_lines(mesh, partners, a.threads, bar.watch(interrupt));
  bar.clear();
  CsvWriter table("line,x,y,z,fitness");
  Drawing drawn;
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t k = 0; k < lines[i].size(); ++k) {
      const auto position = position_of(mesh, lines[i][k]);
      const double fitness = value_at(partners.fitness, lines[i][k]);
      table.cell(static_cast<int>(i)).cell(position[0]).cell(position[1]).cell(position[2]).cell(fitness).end_row();
      const int n = static_cast<int>(drawn.quality.size());
      if (k > 0) drawn.edges.push_back({n - 1, n});
      drawn.position.insert(drawn.position.end(), position.begin(), position.end());
      drawn.quality.push_back(fitness);
    }
  deliver(a.output, drawing ? to_ply(drawn) : table.text());
}

}  // namespace

void add_axis(CLI::App& app, Run& chosen) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& command = *app.add_subcommand("axis", "Trace the line where left meets right");
  add_mesh(command, arguments->mesh);
  add_partners(command, arguments->partners);
  add_threads(command, arguments->threads);
  add_output(command, arguments->output,
             "Result: .csv (line,x,y,z,fitness, one row a point; a closed line repeats its first) or .ply (the line)");
  command.footer(
      "Examples:\n"
      "  ga_symmetry find body.ply -o body.csv\n"
      "  ga_symmetry axis body.ply body.csv -o axis.ply");
  command.callback([arguments, &chosen] { chosen = [arguments](const Context& c) { run(*arguments, c); }; });
}

}  // namespace ga_symmetry::tool
