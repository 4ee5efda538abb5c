// SPDX-License-Identifier: GPL-3.0-or-later
#include "table.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>

#include "ga_symmetry/errors.h"
#include "ga_symmetry/io.h"
#include "util/csv.h"

namespace ga_symmetry::tool {
std::string to_ply(const Drawing& d) {
  const std::size_t points = d.position.size() / 3;
  std::string out = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(points) +
                    "\nproperty double x\nproperty double y\nproperty double z\n";
  if (!d.quality.empty()) out += "property double quality\n";
  if (!d.triangles.empty())
    out += "element face " + std::to_string(d.triangles.size() / 3) + "\nproperty list uchar int vertex_indices\n";
  if (!d.edges.empty())
    out += "element edge " + std::to_string(d.edges.size()) + "\nproperty int vertex1\nproperty int vertex2\n";
  out += "end_header\n";
  for (std::size_t i = 0; i < points; ++i) {
    for (int k = 0; k < 3; ++k) out += (k ? " " : "") + number_text(d.position[3 * i + k]);
    if (!d.quality.empty()) out += ' ' + number_text(d.quality[i]);
    out += '\n';
  }
  for (std::size_t i = 0; i < d.triangles.size(); i += 3) {
    out += '3';
    for (int k = 0; k < 3; ++k) out += ' ' + number_text(d.triangles[i + k]);
    out += '\n';
  }
  for (const auto& [a, b] : d.edges) out += number_text(a) + ' ' + number_text(b) + '\n';
  return out;
}

bool wants_drawing(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (!path.empty() && ending != ".csv" && ending != ".ply")
    throw CLI::ValidationError("--output", "must end in .csv or .ply, got " + path);
  return ending == ".ply";
}

void deliver(const std::string& path, const std::string& bytes) {
  if (!path.empty()) return write_file(path, bytes);
  if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() || std::fflush(stdout) != 0)
    throw FileError("cannot write to the standard output: is the disk full?");
}

}  // namespace ga_symmetry::tool
