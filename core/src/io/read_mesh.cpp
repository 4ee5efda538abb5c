// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <new>
#include <string>

#include "ga_symmetry/errors.h"
#include "ga_symmetry/io.h"
#include "io/mesh_formats.h"
#include "util/text_scan.h"

namespace ga_symmetry {

void refuse_line(long line, const std::string& why) { throw FileError("line " + std::to_string(line) + ": " + why); }

TriangleMesh read_mesh(const std::string& path, const Context& context) {
  try {
    std::string ending = std::filesystem::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
    if (ending != ".ply" && ending != ".off" && ending != ".obj" && ending != ".stl")
      throw FileError("its name must end in .ply, .off, .obj or .stl");
    const std::string text = read_text(path);
    if (ending == ".ply") return read_ply(text, context);
    if (ending == ".off") return read_off(text, context);
    if (ending == ".stl") return read_stl(text, context);
    return read_obj(text, context);
  } catch (const Cancelled&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw FileError("cannot read " + path + ": it does not fit into memory");
  } catch (const std::exception& e) {
    throw FileError("cannot read " + path + ": " + e.what());
  }
}

}  // namespace ga_symmetry
