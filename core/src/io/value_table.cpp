// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/value_table.h"

#include <algorithm>

#include "util/text_scan.h"

namespace ga_symmetry {
namespace {

constexpr const char* kSeparators = ", \t\r";

ValueTable parse(const std::string& text, int vertices, const std::vector<std::string>& wanted) {
  LineReader lines(text);
  const auto refuse = [&](const std::string& why) {
    throw FileError("line " + std::to_string(lines.number()) + ": " + why);
  };
  std::string_view line;
  lines.next(line);
  const std::vector<std::string_view> header = split(line, kSeparators);
  const auto vertex_at = static_cast<std::size_t>(std::find(header.begin(), header.end(), "vertex") - header.begin());
  if (vertex_at == header.size()) refuse("the header must name the column vertex");
  ValueTable table;
  std::vector<std::size_t> place;  // in a row, of each column
  for (std::size_t i = 0; i < header.size(); ++i) {
    if (i == vertex_at || (!wanted.empty() && std::find(wanted.begin(), wanted.end(), header[i]) == wanted.end()))
      continue;
    table.names.emplace_back(header[i]);
    place.push_back(i);
  }
  table.columns.assign(place.size(), std::vector<double>(static_cast<std::size_t>(vertices)));
  std::vector<bool> listed(static_cast<std::size_t>(vertices));
  while (lines.next(line)) {
    const std::vector<std::string_view> cells = split(line, kSeparators);
    if (cells.empty()) continue;
    if (cells.size() != header.size()) refuse("it has not as many cells as the header");
    const auto v = parse_number<int>(cells[vertex_at]);
    if (!v || *v < 0 || *v >= vertices)
      refuse("there is no such vertex in a mesh of " + std::to_string(vertices) + " vertices");
    if (listed[*v]) refuse("vertex " + std::to_string(*v) + " is listed twice");
    listed[*v] = true;
    for (std::size_t i = 0; i < place.size(); ++i) {
      const auto value = parse_number<double>(cells[place[i]]);
      if (!value) refuse("the column " + table.names[i] + " must hold numbers");
      table.columns[i][*v] = *value;
    }
  }
  if (const auto missing = std::count(listed.begin(), listed.end(), false))
    throw FileError(std::to_string(missing) + " of the mesh's " + std::to_string(vertices) + " vertices are missing");
  return table;
}

}  // namespace

ValueTable read_value_table(const std::string& path, int vertices, const std::vector<std::string>& wanted) {
  try {
    return parse(read_text(path), vertices, wanted);
  } catch (const FileError& error) {
    throw FileError("cannot read " + path + ": " + error.what());
  }
}

}  // namespace ga_symmetry
