// What the writers share with others that show or read back a result.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/result.h"
#include "ga_symmetry/triangle_mesh.h"

namespace ga_symmetry {

/// Fitness at the red end of the colour ramp, whose blue end is 0: the 95th percentile over the vertices with a
/// partner, so that a few bad vertices do not turn all others blue. 0 if there are none.
double ramp_top(const std::vector<int>& partner, const std::vector<double>& fitness);

/// Tells meshes apart, so that a result is not applied to another mesh: FNV-1a 64 over the number of vertices and
/// triangles (64 bits each), the positions (float32 each) and the triangles (32 bits each), all little-endian.
std::uint64_t mesh_checksum(const TriangleMesh& mesh);
/// As it stands in files: `fnv1a64:` and 16 hexadecimal digits.
std::string checksum_text(const TriangleMesh& mesh);

/// Writes the bytes; the file appears whole or not at all. @throws FileError
void write_file(const std::string& path, const std::string& bytes);

/// write_result for several files: all of them are written under other names before the first one appears.
/// @throws InvalidOption, FileError  as write_result; then none was changed, unless the very renaming failed
/// @throws Cancelled  then none was changed
void write_results(const std::vector<std::string>& paths, const TriangleMesh& mesh, const Result& result,
                   const Context& context = {});

}  // namespace ga_symmetry
