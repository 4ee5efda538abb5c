// SPDX-License-Identifier: GPL-3.0-or-later
// What the subcommands write beside tables: drawings for any mesh viewer.
#pragma once
#include <array>
#include <string>
#include <vector>

namespace ga_symmetry::tool {

/// Points with a value each, and what joins them.
struct Drawing {
  std::vector<double> position;  ///< x,y,z per point
  std::vector<double> quality;   ///< per point; or none
  std::vector<std::array<int, 2>> edges;
  std::vector<int> triangles;  ///< three points each
};

/// As PLY in text form, the values as `quality`.
std::string to_ply(const Drawing& drawing);

/// Is a file of this name a drawing? @throws CLI::ValidationError  unless it ends in .csv or .ply, or there is none
bool wants_drawing(const std::string& path);

/// Writes the file, whole or not at all; no path = the standard output. @throws FileError
void deliver(const std::string& path, const std::string& bytes);

}  // namespace ga_symmetry::tool
