// SPDX-License-Identifier: GPL-3.0-or-later
// The options by name: what command lines, dialogs, scripts and documents are made of.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ga_symmetry/options.h"

namespace ga_symmetry {

/// What values an option takes.
enum class OptionKind { flag, integer, real, choice, references };

/// Whom it is for: everyone, those who look for more, those who know the search.
enum class OptionLevel { basic, advanced, expert };

/// What there is to say of one option.
struct OptionInfo {
  std::string name;                        ///< such as `joint_sites`
  OptionKind kind = OptionKind::flag;      ///< of its values
  OptionLevel level = OptionLevel::basic;  ///< whom it is for
  std::optional<Method> method;            ///< the only one that it is for
  std::vector<std::string> choices;        ///< of a choice
  std::string range;                       ///< of a number, such as "4 to 10000"
  std::string default_value;               ///< as set_option takes it
  std::string label;                       ///< a few words for a dialog; of experts' options ""
  std::string help;                        ///< a sentence without a full stop, and without the range and the default
};

/// Every option of `Options`.
const std::vector<OptionInfo>& option_table();
/// @throws InvalidOption  for an unknown name
const OptionInfo& option_info(const std::string& name);

/// Sets one option from a text: `true` or `false`, a number, a word of the choices, or as parse_references takes it.
/// @throws InvalidOption  for an unknown name, or a value of another kind or out of its range, and has changed nothing;
///                        the message on a value begins with the name
void set_option(Options& options, const std::string& name, const std::string& value);

/// Sets experts' options from a line of `name=value` items, separated by commas or blanks:
/// `joint_sites=400, fitness=linear`.
/// @throws InvalidOption  as set_option; also for an item of another form, and a name given twice
void set_expert_options(Options& options, const std::string& line);

/// An option that does nothing beside the others, whatever its value.
struct IdleOption {
  std::string name;      ///< as in the table
  std::string why;       ///< such as "with the method pairs"
  bool changed = false;  ///< its value is not the default
};
/// What find_symmetry does not look at; or list_symmetries, if `listing`.
std::vector<IdleOption> idle_options(const Options& options, bool listing = false);

}  // namespace ga_symmetry
