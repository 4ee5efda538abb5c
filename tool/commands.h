// The subcommands: each adds its options to the command line and says what to run once they are parsed.
#pragma once
#include <CLI/CLI.hpp>
#include <functional>

#include "ga_symmetry/context.h"

namespace ga_symmetry::tool {

/// Runs a subcommand. Errors of the core pass through. @throws CLI::ValidationError  for wrong usage
using Run = std::function<void(const Context&)>;

/// Registers the subcommand; `chosen` becomes its Run when the user names it.
void add_find(CLI::App& app, Run& chosen);
void add_pairs(CLI::App& app, Run& chosen);
void add_axis(CLI::App& app, Run& chosen);
void add_mirror(CLI::App& app, Run& chosen);
void add_asymmetry(CLI::App& app, Run& chosen);
void add_samples(CLI::App& app, Run& chosen);
void add_score(CLI::App& app, Run& chosen);
void add_compare(CLI::App& app, Run& chosen);

}  // namespace ga_symmetry::tool
