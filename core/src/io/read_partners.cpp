// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "ga_symmetry/errors.h"
#include "ga_symmetry/io.h"
#include "io/value_table.h"
#include "util/text_scan.h"

namespace ga_symmetry {
namespace {

// Conversion alone would cut off what is no integer, or is none that fits.
std::vector<int> checked_integers(const nlohmann::json& values, const char* name, int vertices, int lowest, int end) {
  std::vector<int> out;
  for (const auto& value : values) {
    const bool huge = value.is_number_unsigned() && value.get<std::uint64_t>() >= static_cast<std::uint64_t>(end);
    const auto integer = value.is_number_integer() && !huge ? value.get<std::int64_t>() : end;
    if (integer < lowest || integer >= end)
      throw FileError(std::string("its ") + name + " of vertex " + std::to_string(out.size()) +
                      " is out of range: write it anew with `ga_symmetry find`");
    out.push_back(static_cast<int>(integer));
  }
  if (out.size() != static_cast<std::size_t>(vertices))
    throw FileError(std::string("it has not a ") + name + " for every vertex: write it anew with `ga_symmetry find`");
  return out;
}

Partners from_json(const std::string& text, const TriangleMesh& mesh) {
  const auto json = nlohmann::json::parse(text);
  if (json.value("format", "") != "ga_symmetry result" || json.value("version", 0) != 1)
    throw FileError("it is not a result of ga_symmetry, version 1");
  const auto& made_for = json.at("mesh");
  if (made_for.at("vertices") != mesh.vertices() || made_for.at("triangles") != mesh.triangles())
    throw FileError("it is of a mesh of " + made_for.at("vertices").dump() + " vertices and " +
                    made_for.at("triangles").dump() + " triangles, this one has " + std::to_string(mesh.vertices()) +
                    " and " + std::to_string(mesh.triangles()) + ": open the mesh it was made for");
  if (made_for.at("checksum") != checksum_text(mesh))
    throw FileError(
        "it is of another mesh of the same size, or vertices have been moved since (the checksum differs): open the "
        "mesh it was made for, or use the .csv if only the pose has changed");
  const int n = mesh.vertices();
  return {checked_integers(json.at("partner"), "partner", n, -1, n), json.at("fitness"),
          checked_integers(json.at("side"), "side", n, -1, 2)};
}

Partners from_csv(const std::string& path, int vertices) {
  Partners out;
  ValueTable table = read_value_table(path, vertices, {"partner", "fitness", "side"});
  const auto refuse = [&](std::size_t v, const char* why) {
    throw FileError("cannot read " + path + ": vertex " + std::to_string(v) + ": " + why);
  };
  const auto integers = [&](const std::vector<double>& column, int lowest, int end, const char* rule) {
    std::vector<int> values;
    for (const double value : column) {
      if (!(value >= lowest && value < end && value == std::floor(value))) refuse(values.size(), rule);
      values.push_back(static_cast<int>(value));
    }
    return values;
  };
  for (std::size_t i = 0; i < table.names.size(); ++i) {
    std::vector<double>& column = table.columns[i];
    if (table.names[i] == "partner") {
      out.partner = integers(column, -1, vertices, "the partner must be a vertex of the mesh, or -1 for none");
    } else if (table.names[i] == "side") {
      out.side = integers(column, -1, 2, "the side must be -1, 0 or 1");
    } else {
      for (std::size_t v = 0; v < column.size(); ++v)
        if (!(column[v] >= 0)) refuse(v, "the fitness must be at least 0");
      out.fitness = std::move(column);
    }
  }
  if (out.partner.empty()) throw FileError("cannot read " + path + ": the header must name the column partner");
  return out;
}

}  // namespace

Partners read_partners(const std::string& path, const TriangleMesh& mesh) {
  if (std::filesystem::path(path).extension() != ".json") return from_csv(path, mesh.vertices());
  try {
    return from_json(read_text(path), mesh);
  } catch (const nlohmann::json::exception&) {
    throw FileError("cannot read " + path + ": it is damaged or not a result of ga_symmetry");
  } catch (const FileError& error) {
    throw FileError("cannot read " + path + ": " + error.what());
  }
}

Partners read_checked_partners(const std::string& path, const TriangleMesh& mesh) {
  Partners partners = read_partners(path, mesh);
  if (partners.fitness.empty() || partners.side.empty())
    throw FileError("cannot use " + path + ": it lacks the columns fitness and side; write it with `ga_symmetry find`");
  try {
    check_partners(partners, mesh);
  } catch (const InvalidOption& error) {
    throw FileError("cannot use " + path + ": " + error.what());
  }
  return partners;
}

}  // namespace ga_symmetry
