// SPDX-License-Identifier: GPL-3.0-or-later
// The subcommands: each adds its options to the command line and says what to run once they are parsed.
#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <stdexcept>

#include "ga_symmetry/context.h"

namespace ga_symmetry::tool {

/// Stopped by the user, where there is more to say than that nothing was written.
struct Interrupted : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Runs a subcommand. Errors of the core pass through. @throws CLI::ValidationError  for wrong usage  @throws
/// Interrupted
using Run = std::function<void(const Context&)>;

/// Registers the subcommand; `chosen` becomes its Run when the user names it.
void add_find(CLI::App& app, Run& chosen);
void add_pairs(CLI::App& app, Run& chosen);
void add_axis(CLI::App& app, Run& chosen);
void add_mirror(CLI::App& app, Run& chosen);
void add_asymmetry(CLI::App& app, Run& chosen);
void add_samples(CLI::App& app, Run& chosen);
void add_score(CLI::App& app, Run& chosen);
void add_compare(CLI::App& app, Run& chosen);  // only where GA_SYMMETRY_COMPARISON is on

}  // namespace ga_symmetry::tool
