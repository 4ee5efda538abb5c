// SPDX-License-Identifier: GPL-3.0-or-later
// Mesh files: the first byte chooses the ending, the rest is the file; or the rest chooses a PLY header whose
// properties have any type, and what is left is the data below it.
#include <array>
#include <cstdlib>

#include "fuzz.h"
#include "ga_symmetry/io.h"
#include "ga_symmetry/mesh.h"

namespace {

using namespace ga_symmetry;

std::string ply(fuzz::Bytes& in) {
  constexpr std::array<const char*, 8> kTypes{"char", "uchar", "short", "ushort", "int", "uint", "float", "double"};
  constexpr std::array<const char*, 3> kFormats{"ascii", "binary_little_endian", "binary_big_endian"};
  const auto type = [&] { return std::string(kTypes[in.take<std::uint8_t>() % kTypes.size()]) + " "; };
  const auto list = [&] { return "list " + type() + type(); };
  std::string out = std::string("ply\nformat ") + kFormats[in.take<std::uint8_t>() % kFormats.size()] + " 1.0\n";
  const auto element = [&](const char* name, std::initializer_list<const char*> values, const char* vertices) {
    out += std::string("element ") + name + " " + std::to_string(in.take<std::uint8_t>()) + "\n";
    const auto others = [&] {
      for (int count = in.take<std::uint8_t>() % 3; count-- > 0;)
        out += "property " + (in.take<std::uint8_t>() % 2 ? list() : type()) + "other\n";
    };
    for (const char* value : values) out += "property " + type() + value + "\n", others();
    if (vertices) out += "property " + list() + vertices + "\n";
    others();
  };
  const int elements = in.take<std::uint8_t>();
  element("vertex", {"x", "y", "z"}, nullptr);
  if (elements & 1) element("edge", {"vertex1", "vertex2"}, nullptr);
  if (elements & 2) element("face", {}, elements & 4 ? "vertex_index" : "vertex_indices");
  if (elements & 8) element("tristrips", {}, "vertex_indices");
  return out + "end_header\n" + in.rest();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::array<const char*, 5> kEndings{".off", ".ply", ".obj", ".stl", ".ply"};
  if (size == 0) return 0;
  const std::size_t kind = data[0] % kEndings.size();
  fuzz::Bytes in(data + 1, size - 1);
  const std::string path = fuzz::as_file(kEndings[kind], kind == 4 ? ply(in) : in.rest());
  fuzz::expect_result_or_line([&] {
    const TriangleMesh mesh = read_mesh(path);
    if (mesh.position.size() % 3 || mesh.triangle.size() % 3) std::abort();
    for (const int v : mesh.triangle)
      if (v < 0 || v >= mesh.vertices()) std::abort();
  });
  return 0;
}
