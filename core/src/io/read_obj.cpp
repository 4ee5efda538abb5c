// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>
#include <string_view>

#include "ga_symmetry/errors.h"
#include "io/mesh_formats.h"
#include "util/text_scan.h"

namespace ga_symmetry {
namespace {

// Lines of an OBJ: one that ends in \ goes on in the next.
class ObjLines {
 public:
  explicit ObjLines(std::string_view text) : lines_(text) {}
  bool next(std::string_view& line) {
    if (!lines_.next(line)) return false;
    if (!goes_on(line)) return true;
    joined_ = line;
    for (std::string_view part; goes_on(joined_) && lines_.next(part);)
      joined_.replace(joined_.rfind('\\'), joined_.npos, " ").append(part);
    line = joined_;
    return true;
  }
  long number() const { return lines_.number(); }
  std::size_t left() const { return lines_.rest().size(); }

 private:
  static bool goes_on(std::string_view line) {
    const std::size_t end = line.find_last_not_of(" \t\r");
    return end != line.npos && line[end] == '\\';
  }
  LineReader lines_;
  std::string joined_;
};

void read_vertex(TextScanner& words, TriangleMesh& mesh) {
  for (int k = 0; k < 3; ++k) {
    double x;
    if (!words.next_in_line()) refuse_line(words.line(), "a vertex needs three coordinates");
    if (!words.read(x)) refuse_line(words.line(), quoted(words.word()) + " is not a coordinate");
    mesh.position.push_back(x);
  }
}

// Of a corner such as 7/1/3 the first number counts; a negative one counts back from the last vertex so far.
void read_face(TextScanner& words, TriangleMesh& mesh) {
  Fan fan(mesh.triangle);
  const int vertices = mesh.vertices();
  while (words.next_in_line()) {
    const std::string_view word = words.word();
    const auto index = parse_number<int>(word.substr(0, word.find('/')));
    if (!index || *index == 0 || *index > vertices || *index < -vertices)
      refuse_line(words.line(), quoted(word) + " is not one of the " + std::to_string(vertices) + " vertices so far");
    fan.add(*index > 0 ? *index - 1 : vertices + *index);
    words.drop(word.size());
  }
}

}  // namespace

TriangleMesh read_obj(std::string_view text, const Context& context) {
  TriangleMesh mesh;
  ObjLines lines(text);
  for (std::string_view line; lines.next(line);) {
    report_reading(lines.number(), static_cast<double>(text.size() - lines.left()), static_cast<double>(text.size()),
                   context);
    TextScanner words(line, '#', lines.number());
    if (!words.next_in_line()) continue;
    const std::string_view keyword = words.word();
    if (keyword != "v" && keyword != "f") continue;
    words.drop(keyword.size());
    keyword == "v" ? read_vertex(words, mesh) : read_face(words, mesh);
  }
  if (mesh.position.empty()) throw FileError("it has no vertices");
  return mesh;
}

}  // namespace ga_symmetry
