// SPDX-License-Identifier: GPL-3.0-or-later
// The core's options as parameters of a filter.
#pragma once
#include "ga_symmetry/option_table.h"
#include "meshlab_adapter.h"

namespace ga_symmetry {

/// An option as a parameter of the same name; one that few people look for is folded away where MeshLab can.
/// @param more  what only this filter says of it
void add_option(RichParameterList& list, const OptionInfo& info, const char* more = "");

/// Sets the option to what its parameter says. @throws InvalidOption
void read_option(const RichParameterList& list, const OptionInfo& info, Options& options);

}  // namespace ga_symmetry
