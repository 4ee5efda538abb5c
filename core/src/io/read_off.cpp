// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/space/triangle3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "ga_symmetry/errors.h"
#include "io/mesh_formats.h"
#include "util/text_scan.h"

namespace ga_symmetry {
namespace {

struct Header {
  long vertices = 0, faces = 0;
  bool textured = false, colored = false, normals = false;
};

// The words of the file. A vertex or a list of vertices may go on in the next line.
class OffWords {
 public:
  explicit OffWords(std::string_view text) : scan(text, '#') {}
  template <class Number>
  Number next(const char* what, const char* kind) {
    if (!scan.next()) refuse_line(scan.line(), std::string("the file ends where ") + what + " should follow");
    Number value;
    if (!scan.read(value)) refuse_line(scan.line(), quoted(scan.word()) + " is not " + kind);
    return value;
  }
  double next_real() { return next<double>("a coordinate", "a number"); }
  int next_integer(const char* what) { return next<int>(what, "an integer"); }

  TextScanner scan;
};

Header read_header(OffWords& words, std::size_t bytes) {
  TextScanner& scan = words.scan;
  Header header;
  constexpr std::string_view kMagic = "OFF";
  const std::string_view word = scan.next() ? scan.word() : std::string_view();
  const std::size_t at = word.find(kMagic);
  // Some files have the number of vertices right behind the word.
  const std::string_view behind = at == word.npos ? "" : word.substr(at + kMagic.size());
  if (at == word.npos || (!behind.empty() && !(behind[0] >= '0' && behind[0] <= '9')))
    throw FileError("it does not begin with the word OFF");
  const std::string_view prefix = word.substr(0, at);
  if (prefix.find_first_not_of("STCN") != prefix.npos)
    throw FileError(quoted(word) + " is not supported: save it with three coordinates per vertex, as text");
  header.textured = prefix.find("ST") != prefix.npos;
  header.colored = prefix.find('C') != prefix.npos;
  header.normals = prefix.find('N') != prefix.npos;
  scan.drop(at + kMagic.size());
  if (scan.next_in_line() && scan.word() == "BINARY")
    throw FileError("its binary form is not supported: save it as text");
  if (!scan.next()) throw FileError("the file ends before the number of vertices");
  header.vertices = words.next_integer("the number of vertices");
  if (!scan.next_in_line()) refuse_line(scan.line(), "the numbers of vertices, faces and edges are missing");
  header.faces = words.next_integer("the number of faces");
  constexpr std::size_t kVertexBytes = 6, kFaceBytes = 2;  // "0 0 0\n" and "0\n"; no row is shorter
  if (header.vertices < 0 || header.faces < 0)
    throw FileError("the header gives a negative number of vertices or faces");
  if (static_cast<std::size_t>(header.vertices) > bytes / kVertexBytes ||
      static_cast<std::size_t>(header.faces) > bytes / kFaceBytes)
    throw FileError("the header promises " + std::to_string(header.vertices) + " vertices and " +
                    std::to_string(header.faces) + " faces, more than the file can hold: it is cut short or damaged");
  return header;
}

void read_vertex(OffWords& words, const Header& header, TriangleMesh& mesh) {
  TextScanner& scan = words.scan;
  for (int k = 0; k < 3; ++k) mesh.position.push_back(words.next_real());
  for (int k = 0; k < (header.normals ? 3 : 0); ++k) words.next_real();
  constexpr int kTexture = 2;
  if (header.colored) {  // by an index or 3 or 4 components, in the line of the vertex
    int left = header.textured ? -kTexture : 0;
    for (; scan.next_in_line(); ++left) scan.drop_word();
    if (left < 0 || left > 4) refuse_line(scan.line(), "a colour has 0 to 4 numbers, in the line of its vertex");
  } else if (header.textured) {
    for (int k = 0; k < kTexture; ++k) words.next_real();
  }
}

// Splits quads as vcglib's OFF importer does, and MeshLab with it (BitQuad::QuadTriangulate): along the diagonal with
// the better worst triangle, unless that folds the quad or is the diagonal of another one.
class QuadSplitter {
 public:
  void add(std::array<int, 4> q, TriangleMesh& mesh) {
    const auto p = [&](int corner) {
      const double* x = &mesh.position[3 * static_cast<std::size_t>(q[corner])];
      return vcg::Point3d(x[0], x[1], x[2]);
    };
    const auto angle = [&](int a, int b, int c, int d) {
      return vcg::Angle(vcg::Normal(p(a), p(b), p(c)), vcg::Normal(p(a), p(c), p(d)));
    };
    const auto quality = [&](int a, int b, int c, int d) {
      return std::min(vcg::QualityRadii(p(a), p(b), p(c)), vcg::QualityRadii(p(a), p(c), p(d)));
    };
    const bool folds = angle(1, 2, 3, 0) > M_PI / 2 && angle(0, 1, 2, 3) < M_PI / 2;
    if (quality(0, 1, 2, 3) < quality(1, 2, 3, 0) && !folds) std::rotate(q.begin(), q.begin() + 1, q.end());
    if (!diagonals_.insert(std::minmax(q[0], q[2])).second) std::rotate(q.begin(), q.begin() + 1, q.end());
    mesh.triangle.insert(mesh.triangle.end(), {q[0], q[1], q[2], q[0], q[2], q[3]});
  }

 private:
  std::set<std::pair<int, int>> diagonals_;
};

}  // namespace

TriangleMesh read_off(std::string_view text, const Context& context) {
  OffWords words(text);
  TextScanner& scan = words.scan;
  const Header header = read_header(words, text.size());
  const auto rows = static_cast<double>(header.vertices + header.faces);
  TriangleMesh mesh;
  mesh.position.reserve(3 * static_cast<std::size_t>(header.vertices));
  constexpr std::size_t kTriangleBytes = 8;  // "3 0 1 2\n"
  mesh.triangle.reserve(3 * std::min(static_cast<std::size_t>(header.faces), text.size() / kTriangleBytes));
  scan.next_line();
  for (long v = 0; v < header.vertices; ++v) {
    report_reading(v, static_cast<double>(v), rows, context);
    read_vertex(words, header, mesh);
  }
  if (header.vertices > 0) scan.next_line();
  QuadSplitter quads;
  for (long f = 0; f < header.faces; ++f) {
    report_reading(f, static_cast<double>(header.vertices + f), rows, context);
    if (!scan.next())
      refuse_line(scan.line(), "the file ends where face " + std::to_string(f) + " of " + std::to_string(header.faces) +
                                   " should follow");
    const int corners = words.next_integer("a face");
    if (corners < 0) refuse_line(scan.line(), "a face of " + std::to_string(corners) + " vertices");
    const auto next_vertex = [&] {
      const int v = words.next_integer("a vertex of the face");
      if (v < 0 || v >= header.vertices)
        refuse_line(scan.line(),
                    "a face refers to vertex " + std::to_string(v) + " of " + std::to_string(header.vertices));
      return v;
    };
    if (corners == 4) {
      std::array<int, 4> quad;
      for (int& v : quad) v = next_vertex();
      quads.add(quad, mesh);
    } else {
      Fan fan(mesh.triangle);
      for (int k = 0; k < corners; ++k) fan.add(next_vertex());
    }
    scan.next_line();  // past colours
  }
  return mesh;
}

}  // namespace ga_symmetry
