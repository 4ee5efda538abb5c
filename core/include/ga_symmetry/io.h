// SPDX-License-Identifier: GPL-3.0-or-later
// Reading and writing: meshes, partners, results.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "ga_symmetry/colors.h"
#include "ga_symmetry/context.h"
#include "ga_symmetry/mesh.h"
#include "ga_symmetry/partners.h"
#include "ga_symmetry/result.h"

namespace ga_symmetry {

/// Reads PLY, OFF, OBJ or STL, told by the ending. Polygons and triangle strips become triangles, faces of less than
/// three vertices are skipped, corners of an STL at one place are one vertex; nothing else is kept of the file.
/// @throws FileError  with the reason, if the file cannot be read as a triangle mesh
/// @throws Cancelled
TriangleMesh read_mesh(const std::string& path, const Context& context = {});

/// Writes the result; the ending of `path` chooses the format. The file appears whole or not at all.
///  .csv   header `vertex,partner,fitness,side`, one row per vertex, 0-based
///  .json  everything in Result
///  .ply   the mesh coloured by fitness, with quality and the three attributes per vertex
/// @throws InvalidOption  for another ending
/// @throws FileError      if the file cannot be written
void write_result(const std::string& path, const TriangleMesh& mesh, const Result& result);

/// A path that write_result would refuse is refused here, before the work. @throws InvalidOption, FileError
void check_result_path(const std::string& path);

/// write_result for several files: all of them are written under other names before the first one appears.
/// @throws InvalidOption, FileError  as write_result; then none was changed, unless the very renaming failed
/// @param paths  of the files @param mesh  the one that the result is of
/// @param result  to write @param context  progress and cancelling @param color_by  of a .ply
/// @throws Cancelled  then none was changed
void write_results(const std::vector<std::string>& paths, const TriangleMesh& mesh, const Result& result,
                   const Context& context = {}, ColorBy color_by = ColorBy::fitness);

/// Reads what write_result wrote. `.json`: only for the mesh it was made for, told by its checksum. Any other name is a
/// CSV whose header names at least `vertex` and `partner`; every vertex once, in any order. Without the columns
/// `fitness` and `side` those stay empty.
/// @throws FileError
Partners read_partners(const std::string& path, const TriangleMesh& mesh);

/// Reads partners with all columns, and checks them by check_partners. @throws FileError
Partners read_checked_partners(const std::string& path, const TriangleMesh& mesh);

/// Tells meshes apart, so that a result is not applied to another mesh: FNV-1a 64 over the number of vertices and
/// triangles (64 bits each), the positions (float32 each) and the triangles (32 bits each), all little-endian.
std::uint64_t mesh_checksum(const TriangleMesh& mesh);
/// As it stands in files: `fnv1a64:` and 16 hexadecimal digits.
std::string checksum_text(const TriangleMesh& mesh);

/// Writes the bytes; the file appears whole or not at all. @throws FileError
void write_file(const std::string& path, const std::string& bytes);

}  // namespace ga_symmetry
