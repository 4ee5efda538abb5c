// SPDX-License-Identifier: GPL-3.0-or-later
// Other programs as a part of the work.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "ga_symmetry/context.h"

namespace ga_symmetry::comparison {

/// Runs a program and waits for it; if the work is cancelled meanwhile, it is ended.
/// @param words   its name, looked up in PATH, and its arguments
/// @param output  file for what it prints, to both streams
/// @return its exit status; -1 if it could not be run, was killed, or nobody can tell how it ended, as where SIGCHLD is
///         ignored
/// @throws Cancelled
int run_program(const std::vector<std::string>& words, const std::filesystem::path& output, const Context& context);

}  // namespace ga_symmetry::comparison
