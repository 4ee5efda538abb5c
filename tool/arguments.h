// SPDX-License-Identifier: GPL-3.0-or-later
// What several subcommands share on the command line and on the screen.
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/option_table.h"

namespace ga_symmetry::tool {

/// An option whose value is one of a few words; `value` holds the default, which need not be one of them.
template <class Value>
void add_choice(CLI::App& app, const std::string& name, Value& value,
                const std::vector<std::pair<std::string, Value>>& choices, const std::string& help) {
  std::string names, current;
  for (const auto& [text, choice] : choices) {
    names += (names.empty() ? "" : "|") + text;
    if (choice == value) current = text;
  }
  const auto choose = [=, &value](const std::string& given) {
    for (const auto& [text, choice] : choices)
      if (text == given) return static_cast<void>(value = choice);
    throw CLI::ValidationError(name, "must be " + names + ", got " + given);
  };
  app.add_option_function<std::string>(name, choose, current.empty() ? help : help + " [" + current + "]")
      ->type_name(names);
}

/// An option of the core as the command line has it: --joint-sites; a flag that is on by default: --no-noise-filter.
std::string flag_of(const OptionInfo& info);
/// An option of the core. Its value, once given, goes to `options`, and its name to `given`.
void add_core_option(CLI::App& app, const OptionInfo& info, Options& options, std::vector<std::string>& given);

void add_mesh(CLI::App& app, std::string& path);
void add_partners(CLI::App& app, std::string& path);
void add_threads(CLI::App& app, int& threads);
/// -o FILE, once; without it the table goes to the standard output.
void add_output(CLI::App& app, std::string& path, const std::string& help);

/// Shows how far a computation is, where the standard error is a terminal.
class ProgressBar {
 public:
  /// @param place  among other meshes, shown too
  explicit ProgressBar(bool wanted = true, const std::string& place = "");
  ~ProgressBar() { clear(); }
  /// The context to compute with; refers to this bar.
  Context watch(const Context& context);
  void clear();

 private:
  void show(double fraction, const char* stage);
  bool shown_;
  std::string place_, line_;
};

}  // namespace ga_symmetry::tool
