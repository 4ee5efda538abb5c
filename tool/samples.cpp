// SPDX-License-Identifier: GPL-3.0-or-later
// ga_symmetry samples: evenly spaced vertices and the patches around them.
#include "ga_symmetry/samples.h"

#include <memory>
#include <string>
#include <vector>

#include "arguments.h"
#include "commands.h"
#include "ga_symmetry/io.h"
#include "table.h"
#include "util/csv.h"

namespace ga_symmetry::tool {
namespace {

struct Arguments {
  std::string mesh, output;
  int count = 100, threads = 0;
};

void run(const Arguments& a, const Context& context) {
  const bool drawing = wants_drawing(a.output);
  const TriangleMesh mesh = read_mesh(a.mesh, context.part(0, 0.3));
  const SpacedSamples samples = spaced_samples(mesh, a.count, false, a.threads, context.part(0.3, 1, "samples"));
  CsvWriter table("vertex,patch,sample");
  for (int v = 0; v < mesh.vertices(); ++v)
    if (const int patch = samples.patch[v]; patch >= 0) table.cell(v).cell(patch).cell(samples.vertex[patch]).end_row();
  const std::vector<double> quality(samples.patch.begin(), samples.patch.end());
  deliver(a.output, drawing ? to_ply({mesh.position, quality, {}, mesh.triangle}) : table.text());
}

}  // namespace

void add_samples(CLI::App& app, Run& chosen) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& command = *app.add_subcommand("samples", "Choose evenly spaced vertices, by geodesic distance");
  add_mesh(command, arguments->mesh);
  command.add_option("--count", arguments->count, "Samples, at least 1")->capture_default_str();
  add_threads(command, arguments->threads);
  add_output(command, arguments->output,
             "Result: .csv (vertex,patch,sample: its nearest sample's number and vertex) or .ply (the mesh with the "
             "patch as quality)");
  command.footer(
      "The first k samples are the same whatever the count.\n\n"
      "Examples:\n"
      "  ga_symmetry samples body.ply --count 200 -o patches.ply\n"
      "  ga_symmetry samples body.ply | awk -F, '$1 == $3'      the samples only");
  command.callback([arguments, &chosen] { chosen = [arguments](const Context& c) { run(*arguments, c); }; });
}

}  // namespace ga_symmetry::tool
