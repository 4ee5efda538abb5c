#include <vcg/complex/complex.h>
#include <wrap/io_trimesh/import_off.h>
#include <wrap/io_trimesh/import_ply.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <unordered_map>
#include <vector>

#include "ga_symmetry/errors.h"
#include "ga_symmetry/mesh.h"
#include "io/mesh_file_check.h"
#include "util/text_scan.h"

namespace ga_symmetry {
namespace {

class FileVertex;
class FileEdge;
class FileFace;
struct FileTypes : vcg::UsedTypes<vcg::Use<FileVertex>::AsVertexType, vcg::Use<FileEdge>::AsEdgeType,
                                  vcg::Use<FileFace>::AsFaceType> {};
class FileVertex : public vcg::Vertex<FileTypes, vcg::vertex::Coord3d, vcg::vertex::Normal3d, vcg::vertex::BitFlags> {};
class FileEdge : public vcg::Edge<FileTypes, vcg::edge::VertexRef> {};
class FileFace : public vcg::Face<FileTypes, vcg::face::VertexRef, vcg::face::BitFlags> {};
class FileMesh : public vcg::tri::TriMesh<std::vector<FileVertex>, std::vector<FileEdge>, std::vector<FileFace>> {};

std::string read_file(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw FileError("there is no such file");
  if (!fs::is_regular_file(status)) throw FileError("it is not a file");
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) throw FileError(error.message());
  if (size == 0) throw FileError("the file is empty");
  if (size > static_cast<std::uintmax_t>(std::numeric_limits<int>::max()))  // vcglib counts bytes in int
    throw FileError("the file is larger than 2 GB");
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  std::string text(size, '\0');
  if (!in.read(text.data(), static_cast<std::streamsize>(size)))
    throw FileError(errno ? std::generic_category().message(errno) : "it cannot be read");
  return text;
}

// vcglib's importers tell a plain function how far they are, and heed no answer but an exception.
thread_local const Context* importing = nullptr;
bool report_import(int percent, const char*) {
  importing->report(std::clamp(0.01 * percent, 0.0, 1.0), "reading");
  return true;
}

struct Importing {
  explicit Importing(const Context& context) { importing = &context; }
  Importing(const Importing&) = delete;
  ~Importing() { importing = nullptr; }
};

template <class Importer>
void import(FileMesh& mesh, const std::string& path, const Context& context) {
  const Context second_half = context.part(0.5, 1);
  const Importing guard(second_half);
  int mask = 0;
  if (const int error = Importer::Open(mesh, path.c_str(), mask, report_import))
    throw FileError(Importer::ErrorMsg(error));
}

// A file may carry the flags of the program that wrote it; "deleted" and the like mean nothing here.
TriangleMesh without_flags(FileMesh& mesh) {
  for (FileVertex& v : mesh.vert) v.Flags() = 0;
  for (FileFace& f : mesh.face) f.Flags() = 0;
  return to_triangle_mesh(mesh);
}

TriangleMesh read_off(const std::string& path, std::string_view text, const Context& context) {
  check_off(text, context.part(0, 0.5));
  FileMesh mesh;
  import <vcg::tri::io::ImporterOFF<FileMesh>>(mesh, path, context);
  return without_flags(mesh);
}

TriangleMesh read_ply(const std::string& path, std::string_view text, const Context& context) {
  check_ply(text, context.part(0, 0.5));
  FileMesh mesh;
  import <vcg::tri::io::ImporterPLY<FileMesh>>(mesh, path, context);
  return without_flags(mesh);
}

// Coordinates of the corners of a binary STL's triangles, or nothing if the size is not the one it promises.
std::vector<float> binary_stl_corners(std::string_view text) {
  constexpr std::size_t kHeader = 80, kFacet = 50, kNormal = 12, kCorners = 36;
  const auto word = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(text[at + i]);
    return value;
  };
  if (text.size() < kHeader + 4 || (text.size() - kHeader - 4) / kFacet < word(kHeader)) return {};
  const std::size_t facets = word(kHeader);
  std::vector<float> corners;
  corners.reserve(9 * facets);
  for (std::size_t f = 0; f < facets; ++f)
    for (std::size_t at = 0; at < kCorners; at += 4) {
      const std::uint32_t bits = word(kHeader + 4 + kFacet * f + kNormal + at);
      float x;
      std::memcpy(&x, &bits, sizeof x);
      corners.push_back(x);
    }
  return corners;
}

std::vector<float> ascii_stl_corners(std::string_view text, const Context& context) {
  std::vector<float> corners;
  std::size_t facets = 0;
  bool closed = false;
  LineReader lines(text);
  std::string_view line;
  while (lines.next(line)) {
    if (lines.number() % 4096 == 0 && context.cancelled()) throw Cancelled();
    const std::vector<std::string_view> words = split(line);
    if (words.empty()) continue;
    closed = words[0] == "endsolid";
    facets += words[0] == "endfacet";
    if (words[0] != "vertex") continue;
    for (std::size_t k = 1; k <= 3; ++k) {
      const auto x = k < words.size() ? parse_number<double>(words[k]) : std::nullopt;
      if (!x) throw FileError("line " + std::to_string(lines.number()) + ": a vertex needs three coordinates");
      corners.push_back(static_cast<float>(*x));
    }
  }
  if (!closed) throw FileError("the file ends within a solid: it is cut short or damaged");
  if (corners.size() != 9 * facets) throw FileError("its facets are not all triangles");
  return corners;
}

// vcglib's importer does not end on a text without a line end, and searches the header of a binary file, which need not
// end in a zero, for words past its end. Corners of the same coordinates are one vertex, faces that this leaves with
// less than three are dropped.
TriangleMesh read_stl(std::string_view text, const Context& context) {
  std::vector<float> corners = binary_stl_corners(text);
  if (corners.empty() && text.substr(0, 5) == "solid") corners = ascii_stl_corners(text, context);
  if (corners.empty()) throw FileError("it holds no triangles, or is not an STL of the size that it promises");
  using Corner = std::array<float, 3>;
  struct Hash {
    std::size_t operator()(const Corner& c) const {
      return std::hash<std::string_view>()({reinterpret_cast<const char*>(c.data()), sizeof c});
    }
  };
  std::unordered_map<Corner, int, Hash> vertex_at;
  vertex_at.reserve(corners.size() / 12);  // a closed surface has half as many vertices as triangles, or less
  TriangleMesh mesh;
  for (std::size_t f = 0; f < corners.size() / 9; ++f) {
    if (f % 4096 == 0 && context.cancelled()) throw Cancelled();
    std::array<int, 3> face;
    for (int k = 0; k < 3; ++k) {
      Corner corner;
      for (int i = 0; i < 3; ++i) corner[i] = corners[9 * f + 3 * k + i] + 0.0f;                 // -0 is 0
      if (!std::all_of(corner.begin(), corner.end(), [](float x) { return std::isfinite(x); }))  // and so equal to none
        throw FileError("triangle " + std::to_string(f) + " has a coordinate that is not finite");
      const auto [it, fresh] = vertex_at.try_emplace(corner, mesh.vertices());
      if (fresh) mesh.position.insert(mesh.position.end(), corner.begin(), corner.end());
      face[k] = it->second;
    }
    if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0])
      mesh.triangle.insert(mesh.triangle.end(), face.begin(), face.end());
  }
  return mesh;
}

// The vcglib of MeshLab 2020.09 leaves out every face at the first vertex: it checks the same index twice, and takes
// its own 0 for an error. Hence this reader of what a triangle mesh needs: v and f, negative indices, a \ at a line's
// end. Polygons become fans, as in vcglib's importers.
TriangleMesh read_obj(std::string_view text, const Context& context) {
  TriangleMesh mesh;
  LineReader lines(text);
  std::string line;
  const auto next_line = [&] {
    std::string_view part;
    if (!lines.next(part)) return false;
    line = part;
    for (std::size_t end; (end = line.find_last_not_of(" \t\r")) != line.npos && line[end] == '\\' && lines.next(part);)
      line.replace(end, line.npos, " ").append(part);
    return true;
  };
  const auto refuse = [&](const std::string& why) {
    throw FileError("line " + std::to_string(lines.number()) + ": " + why);
  };
  std::vector<int> face;
  while (next_line()) {
    if (lines.number() % 4096 == 0 && context.cancelled()) throw Cancelled();
    const std::vector<std::string_view> words = split(std::string_view(line).substr(0, line.find('#')));
    if (words.empty() || (words[0] != "v" && words[0] != "f")) continue;
    if (words[0] == "v") {
      if (words.size() < 4) refuse("a vertex needs three coordinates");
      for (int k = 1; k <= 3; ++k) {
        const auto x = parse_number<double>(words[k]);
        if (!x) refuse(quoted(words[k]) + " is not a coordinate");
        mesh.position.push_back(*x);
      }
      continue;
    }
    if (words.size() < 4) refuse("a face needs at least 3 vertices");
    face.clear();
    for (std::size_t k = 1; k < words.size(); ++k) {
      const auto index = parse_number<int>(words[k].substr(0, words[k].find('/')));
      const int vertices = mesh.vertices();
      if (!index || *index == 0 || *index > vertices || *index < -vertices)
        refuse(quoted(words[k]) + " is not one of the " + std::to_string(vertices) + " vertices so far");
      face.push_back(*index > 0 ? *index - 1 : vertices + *index);
    }
    for (std::size_t k = 2; k < face.size(); ++k)
      mesh.triangle.insert(mesh.triangle.end(), {face[0], face[k - 1], face[k]});
  }
  if (mesh.position.empty()) throw FileError("it has no vertices");
  return mesh;
}

}  // namespace

TriangleMesh read_mesh(const std::string& path, const Context& context) {
  try {
    std::string ending = std::filesystem::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
    if (ending != ".ply" && ending != ".off" && ending != ".obj" && ending != ".stl")
      throw FileError("its name must end in .ply, .off, .obj or .stl");
    const std::string text = read_file(path);
    if (ending == ".ply") return read_ply(path, text, context);
    if (ending == ".off") return read_off(path, text, context);
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
