// SPDX-License-Identifier: GPL-3.0-or-later
// Reading mesh files, in bytes a second: the core's readers beside vcglib's importers, on the same files.
#include <benchmark/benchmark.h>
#include <unistd.h>
#include <vcg/complex/complex.h>
#include <wrap/io_trimesh/import_off.h>
#include <wrap/io_trimesh/import_ply.h>

#include <charconv>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>

#include "ga_symmetry/io.h"
#include "spheres.h"

namespace {

using namespace ga_symmetry;

class Vertex;
class Face;
struct Types : vcg::UsedTypes<vcg::Use<Vertex>::AsVertexType, vcg::Use<Face>::AsFaceType> {};
class Vertex : public vcg::Vertex<Types, vcg::vertex::Coord3d, vcg::vertex::BitFlags> {};
class Face : public vcg::Face<Types, vcg::face::VertexRef, vcg::face::BitFlags> {};
class Mesh : public vcg::tri::TriMesh<std::vector<Vertex>, std::vector<Face>> {};

template <class Number>
void append(std::string& out, Number value, const char* before = " ") {
  char text[32];
  out += before;
  out.append(text, std::to_chars(text, text + sizeof text, value).ptr);
}

// A sphere of 102,012 vertices in a format.
std::string bytes_of(const std::string& format) {
  const TriangleMesh mesh = spheres::icosphere(101, 0.002);
  const bool binary = format == "binary.ply", obj = format == "text.obj", off = format == "text.off";
  std::string out;
  if (off)
    out = "OFF\n" + std::to_string(mesh.vertices()) + " " + std::to_string(mesh.triangles()) + " 0\n";
  else if (!obj)
    out = std::string("ply\nformat ") + (binary ? "binary_little_endian" : "ascii") + " 1.0\nelement vertex " +
          std::to_string(mesh.vertices()) + "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
          std::to_string(mesh.triangles()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  const auto raw = [&](auto value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    out.append(bytes, sizeof value);
  };
  for (std::size_t i = 0; i < mesh.position.size(); ++i) {
    const auto x = static_cast<float>(mesh.position[i]);
    if (binary) {
      raw(x);
      continue;
    }
    append(out, x, i % 3 ? " " : obj ? "v " : "");
    if (i % 3 == 2) out += '\n';
  }
  for (std::size_t c = 0; c < mesh.triangle.size(); ++c) {
    if (binary) {
      if (c % 3 == 0) out += '\3';
      raw(mesh.triangle[c]);
      continue;
    }
    if (c % 3 == 0) out += obj ? "f" : "3";
    append(out, mesh.triangle[c] + (obj ? 1 : 0));
    if (c % 3 == 2) out += '\n';
  }
  return out;
}

// The file, written once and gone at the end.
const std::string& file_of(const std::string& format) {
  struct Folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("ga_symmetry-readers-" + std::to_string(::getpid()));
    std::map<std::string, std::string> files;
    Folder() { std::filesystem::create_directory(path); }
    ~Folder() { std::filesystem::remove_all(path); }
  };
  static Folder folder;
  std::string& path = folder.files[format];
  if (path.empty()) {
    path = (folder.path / format).string();
    write_file(path, bytes_of(format));
  }
  return path;
}

void count_bytes(benchmark::State& state, const std::string& path) {
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(std::filesystem::file_size(path)));
}

void core_reader(benchmark::State& state, const std::string& format) {
  const std::string& path = file_of(format);
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(read_mesh(path));
  count_bytes(state, path);
}

template <class Importer>
void vcglib_importer(benchmark::State& state, const std::string& format) {
  const std::string& path = file_of(format);
  for ([[maybe_unused]] auto _ : state) {
    Mesh mesh;
    int mask = 0;
    if (Importer::Open(mesh, path.c_str(), mask)) state.SkipWithError("vcglib refuses it");
  }
  count_bytes(state, path);
}

// The macro below takes no template.
constexpr auto vcglib_off = vcglib_importer<vcg::tri::io::ImporterOFF<Mesh>>;
constexpr auto vcglib_ply = vcglib_importer<vcg::tri::io::ImporterPLY<Mesh>>;
BENCHMARK_CAPTURE(core_reader, off, "text.off")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(vcglib_off, off, "text.off")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(core_reader, ply_text, "text.ply")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(vcglib_ply, ply_text, "text.ply")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(core_reader, ply_binary, "binary.ply")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(vcglib_ply, ply_binary, "binary.ply")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(core_reader, obj, "text.obj")->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
