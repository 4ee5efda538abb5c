// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of numbers at the vertices of a mesh, such as weights.
#pragma once
#include <string>
#include <vector>

namespace ga_symmetry {

struct ValueTable {
  std::vector<std::string> names;            ///< of the columns, without `vertex`
  std::vector<std::vector<double>> columns;  ///< per column: one number a vertex
};

/// Reads a CSV whose header names a column `vertex` (0-based) and columns of numbers; every vertex once, in any order.
/// @param wanted  columns to read, of those that are there; none = all
/// @throws FileError  with the line, and without a row for each vertex
ValueTable read_value_table(const std::string& path, int vertices, const std::vector<std::string>& wanted = {});

}  // namespace ga_symmetry
