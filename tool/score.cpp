// SPDX-License-Identifier: GPL-3.0-or-later
// ga_symmetry score: how good a result is where the truth is known.
#include <cstdio>
#include <memory>
#include <string>

#include "commands.h"
#include "ga_symmetry/evaluation.h"
#include "ga_symmetry/io.h"

namespace ga_symmetry::tool {

void add_score(CLI::App& app, Run& chosen) {
  struct Arguments {
    std::string mesh, truth, result;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& score = *app.add_subcommand("score", "Measure a result against the truth");
  score.add_option("MESH", arguments->mesh, "Triangle mesh")->required()->type_name("");
  score.add_option("TRUTH", arguments->truth, "Lines `v w`: the partner of vertex v is vertex w")
      ->required()
      ->type_name("");
  score.add_option("RESULT", arguments->result, "CSV with the columns vertex and partner, or JSON")
      ->required()
      ->type_name("");
  score.footer(
      "Prints the mean error (geodesic by first-order fast marching, over sqrt(area)), the share of errors below\n"
      "0.1262 (corr), the share of vertices with a partner (coverage) and of those whose partner's partner is near\n"
      "(involution).\n\n"
      "Example:\n  ga_symmetry score body.off body.truth body.csv");
  score.callback([arguments, &chosen] {
    chosen = [arguments](const Context& context) {
      const TriangleMesh mesh = read_mesh(arguments->mesh, context);
      const Evaluation e =
          evaluate_partners(mesh, read_truth(arguments->truth), read_partners(arguments->result, mesh).partner);
      std::printf("mean %.4f corr %.4f coverage %.4f involution %.4f lines %zu\n", e.mean, e.corr, e.coverage,
                  e.involution, e.lines);
    };
  });
}

}  // namespace ga_symmetry::tool
