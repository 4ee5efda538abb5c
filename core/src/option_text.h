// The options that few people change, as one line of text.
#pragma once
#include <string>
#include <vector>

#include "ga_symmetry/symmetry.h"

namespace ga_symmetry {

/// Reads `key=value` items, separated by commas or blanks: `joint_sites=400, fitness=linear`. The keys are named as the
/// command line's options; what is not named stays as it is. Ranges are checked by find_symmetry.
/// @throws InvalidOption  for an unknown key, one given twice, or a value of another kind
void set_options(const std::string& text, Options& options);

/// What `set_options` reads.
struct OptionKey {
  std::string name;
  std::string value;    ///< default
  std::string meaning;  ///< with the range
};
std::vector<OptionKey> option_keys();

}  // namespace ga_symmetry
