// SPDX-License-Identifier: GPL-3.0-or-later
// ga_symmetry find over many meshes: one after the other, each with its own outputs, and a table of all.
#pragma once
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "ga_symmetry/result.h"

namespace ga_symmetry::tool {

struct ManyMeshes {
  std::vector<std::string> meshes;   ///< files, and folders whose meshes are meant
  std::string folder;                ///< for the outputs and summary.csv; made if it is missing
  std::vector<std::string> formats;  ///< of the outputs: csv, json, ply
  bool redo = false;                 ///< also meshes whose outputs are there
  bool quiet = false;
};

/// Finds the symmetry of one mesh and writes the outputs. @param place  among the others, such as "3/20 dog"
using FindOne =
    std::function<Result(const std::string& mesh, const std::vector<std::string>& outputs, const std::string& place)>;

/// A mesh NAME.off gives FOLDER/NAME.csv. One whose outputs are all there is skipped: an output appears whole or not at
/// all. One that fails does not stop the rest. FOLDER/summary.csv has a row for each mesh, those of earlier runs too,
/// and is brought up to date after each.
/// @throws InvalidOption, FileError  before any work: two meshes of one name, no mesh, an output that is a mesh
/// @throws Error  after all work, if some meshes failed
/// @throws Interrupted
void find_many(const ManyMeshes& many, const FindOne& find_one);

}  // namespace ga_symmetry::tool
