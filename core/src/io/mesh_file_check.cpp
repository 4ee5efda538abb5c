#include "io/mesh_file_check.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "ga_symmetry/errors.h"
#include "util/text_scan.h"

namespace ga_symmetry {
namespace {

[[noreturn]] void refuse(const std::string& why) { throw FileError(why); }
[[noreturn]] void refuse_line(long line, const std::string& why) {
  refuse("line " + std::to_string(line) + ": " + why);
}

bool is_real(std::string_view word) {
  if (parse_number<double>(word)) return true;
  double value;  // 1e-400 and 1e400 are numbers too: they become 0 and infinity
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc::result_out_of_range && end == word.data() + word.size();
}

void report_row(long row, long rows, const Context& context) {
  if (row % 4096 == 0) context.report(static_cast<double>(row) / static_cast<double>(rows), "reading");
}

void check_counts(long vertices, long faces, std::size_t bytes) {
  constexpr std::size_t kLeastBytes = 6;  // "0 0 0\n"; no row of a text or binary file is shorter
  if (vertices < 0 || faces < 0) refuse("the header gives a negative number of vertices or faces");
  if (static_cast<std::size_t>(vertices) > bytes / kLeastBytes || static_cast<std::size_t>(faces) > bytes / kLeastBytes)
    refuse("the header promises " + std::to_string(vertices) + " vertices and " + std::to_string(faces) +
           " faces, more than the file can hold: it is cut short or damaged");
}

// Words of an OFF file as vcglib cuts them: a list may go on in the next line, and comments are whole lines.
class OffWords {
 public:
  explicit OffWords(std::string_view text) : lines_(text) {}
  bool next_line() {
    std::string_view line;
    do {
      if (!lines_.next(line)) return false;
    } while (line.empty() || line[0] == '#' || line[0] == '\r');
    line = line.substr(0, line.find_last_not_of('\r') + 1);
    words_ = split(line, " \t");
    at_ = 0;
    return true;
  }
  std::string_view next(const char* what) {
    if (at_ == words_.size() && (!next_line() || words_.empty()))
      refuse_line(number(), std::string("the file ends or has a blank line where ") + what + " should follow");
    return words_[at_++];
  }
  void next_real() {
    const std::string_view word = next("a coordinate");
    if (!is_real(word)) refuse_line(number(), quoted(word) + " is not a number");
  }
  long next_integer(const char* what) {
    const std::string_view word = next(what);
    const auto value = parse_number<int>(word);
    if (!value) refuse_line(number(), quoted(word) + " is not an integer");
    return *value;
  }
  std::size_t left_in_line() const { return words_.size() - at_; }
  void drop(std::size_t count) { at_ += count; }
  long number() const { return lines_.number(); }

 private:
  LineReader lines_;
  std::vector<std::string_view> words_;
  std::size_t at_ = 0;
};

}  // namespace

void check_off(std::string_view text, const Context& context) {
  OffWords words(text);
  if (!words.next_line()) refuse("the file is empty");
  std::string_view magic = words.left_in_line() ? words.next("the word OFF") : std::string_view();
  if (magic.size() < 3 || magic.substr(magic.size() - 3) != "OFF") refuse("it does not begin with the word OFF");
  magic.remove_suffix(3);
  if (magic.find_first_not_of("STCN") != magic.npos)
    refuse(quoted(magic) + "OFF is not supported: only three coordinates per vertex, as text");
  const bool textured = magic.find("ST") != magic.npos, colored = magic.find('C') != magic.npos,
             normals = magic.find('N') != magic.npos;
  if (!words.left_in_line() && !words.next_line()) refuse("the file ends before the number of vertices");
  if (words.left_in_line() < 3) refuse_line(words.number(), "the numbers of vertices, faces and edges are missing");
  const long vertices = words.next_integer("the number of vertices"), faces = words.next_integer("the number of faces");
  words.next_integer("the number of edges");
  check_counts(vertices, faces, text.size());
  if (!words.next_line() && vertices > 0) refuse("the file ends before the first vertex");
  for (long v = 0; v < vertices; ++v) {
    report_row(v, vertices + faces, context);
    for (int k = 0; k < (normals ? 6 : 3); ++k) words.next_real();
    if (colored) {  // 0 to 4 numbers, to the end of the line or the texture coordinates
      const std::size_t texture = textured ? 2 : 0;
      if (words.left_in_line() < texture || words.left_in_line() > texture + 4)
        refuse_line(words.number(), "a colour has 0 to 4 numbers, in the line of its vertex");
      words.drop(words.left_in_line() - texture);
    }
    for (int k = 0; k < (textured ? 2 : 0); ++k) words.next_real();
  }
  for (long f = 0; f < faces; ++f) {
    report_row(vertices + f, vertices + faces, context);
    if (!words.next_line() || !words.left_in_line())
      refuse_line(words.number(), "the file ends or has a blank line where face " + std::to_string(f) + " of " +
                                      std::to_string(faces) + " should follow");
    const long corners = words.next_integer("a face");
    if (corners < 3) refuse_line(words.number(), "a face needs at least 3 vertices, got " + std::to_string(corners));
    for (long k = 0; k < corners; ++k) {
      const long v = words.next_integer("a vertex of the face");
      if (v < 0 || v >= vertices)
        refuse_line(words.number(), "a face refers to vertex " + std::to_string(v) + " of " + std::to_string(vertices));
    }
  }
}

namespace {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class PlyFormat { ascii, little_endian, big_endian };

struct PlyProperty {
  std::string name;
  PlyType type;
  bool list = false;
  PlyType count = PlyType::uint8;
};

struct PlyElement {
  std::string name;
  long rows = 0;
  std::vector<PlyProperty> properties;
  const PlyProperty* find(std::string_view property) const {
    for (const PlyProperty& p : properties)
      if (p.name == property) return &p;
    return nullptr;
  }
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
};

PlyType ply_type(std::string_view name, long line) {
  constexpr std::array<std::array<std::string_view, 2>, 8> kNames{{{"char", "int8"},
                                                                   {"uchar", "uint8"},
                                                                   {"short", "int16"},
                                                                   {"ushort", "uint16"},
                                                                   {"int", "int32"},
                                                                   {"uint", "uint32"},
                                                                   {"float", "float32"},
                                                                   {"double", "float64"}}};
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (name == kNames[i][0] || name == kNames[i][1]) return static_cast<PlyType>(i);
  refuse_line(line, quoted(name) + " is not a PLY type");
}

std::size_t size_of(PlyType type) {
  constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

PlyHeader ply_header(LineReader& lines) {
  constexpr std::size_t kLongestLine = 200;  // below every fixed buffer through which vcglib passes lines and names
  PlyHeader header;
  std::string_view line;
  for (bool formatted = false; lines.next(line);) {
    const long number = lines.number();
    if (lines.rest().empty() && line != "end_header") refuse("the file ends within its header");
    if (line.size() > kLongestLine) refuse_line(number, "the header line is too long");
    if (line.find('\0') != line.npos) refuse_line(number, "the header is damaged");
    const std::vector<std::string_view> words = split(line, " \t\r");
    if (words.empty()) refuse_line(number, "a blank line within the header");
    if (number == 1) {
      if (words[0] != "ply" || line.substr(0, 3) != "ply") refuse("it does not begin with the word ply");
    } else if (words[0] == "comment" || words[0] == "obj_info") {
      if (line.find('<') != line.npos && line.find("TextureFile") != line.npos)
        refuse_line(number, "texture names with < are not supported: remove the comment");
    } else if (!formatted) {
      if (words.size() < 3 || words[0] != "format") refuse_line(number, "the format should be given here");
      if (words[1] == "binary_little_endian")
        header.format = PlyFormat::little_endian;
      else if (words[1] == "binary_big_endian")
        header.format = PlyFormat::big_endian;
      else if (words[1] != "ascii")
        refuse_line(number, quoted(words[1]) + " is not a PLY format");
      formatted = true;
    } else if (words[0] == "end_header") {
      return header;
    } else if (words[0] == "element" && words.size() == 3) {
      const auto rows = parse_number<int>(words[2]);
      if (!rows || *rows < 0) refuse_line(number, quoted(words[2]) + " is not a number of elements");
      for (const PlyElement& e : header.elements)
        if (e.name == words[1]) refuse_line(number, "a second element " + quoted(words[1]));
      header.elements.push_back({std::string(words[1]), *rows, {}});
    } else if (words[0] == "property" && !header.elements.empty() && words.size() == 3) {
      header.elements.back().properties.push_back({std::string(words[2]), ply_type(words[1], number)});
    } else if (words[0] == "property" && !header.elements.empty() && words.size() == 5 && words[1] == "list") {
      header.elements.back().properties.push_back(
          {std::string(words[4]), ply_type(words[3], number), true, ply_type(words[2], number)});
    } else {
      refuse_line(number, quoted(line) + " is not understood");
    }
  }
  refuse("the file ends within its header");
}

// The property that holds the faces' vertices, of a type that vcglib reads.
const PlyProperty* face_list(const PlyElement& face) {
  if (face.find("vertex_indices") && face.find("vertex_index")) refuse("its faces have two lists of vertices");
  for (const char* name : {"vertex_indices", "vertex_index"}) {
    const PlyProperty* p = face.find(name);
    if (!p) continue;
    const bool short_count = p->count == PlyType::uint8 || p->count == PlyType::int8 || p->count == PlyType::int32;
    const bool long_name = std::strlen(name) == std::strlen("vertex_indices");
    const bool known = (p->type == PlyType::int32 && short_count) ||
                       (long_name && p->type == PlyType::uint32 && (short_count || p->count == PlyType::uint16)) ||
                       (long_name && p->type == PlyType::int16 && short_count);
    if (!p->list || !known)
      refuse(std::string("the type of the list ") + name + " is not supported: save it as `property list uchar int`");
    return p;
  }
  refuse("its faces have no list vertex_indices");
}

// Reads values in the order of the file.
class PlyValues {
 public:
  PlyValues(std::string_view data, PlyFormat format) : data_(data), format_(format) {}
  void skip(PlyType type) {
    if (format_ != PlyFormat::ascii) {
      take(size_of(type));
    } else if (type == PlyType::float32 || type == PlyType::float64) {
      const std::string_view word = next_word();
      if (!is_real(word)) refuse(quoted(word) + " is not a number");
    } else {
      integer(type);
    }
  }
  long integer(PlyType type) {
    if (format_ == PlyFormat::ascii) return ascii_integer(type);
    const std::size_t size = size_of(type);
    const char* bytes = take(size);
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t at = format_ == PlyFormat::little_endian ? size - 1 - i : i;
      value = value << 8 | static_cast<unsigned char>(bytes[at]);
    }
    if (type == PlyType::int8) return static_cast<std::int8_t>(value);
    if (type == PlyType::int16) return static_cast<std::int16_t>(value);
    if (type == PlyType::int32) return static_cast<std::int32_t>(value);
    return value;
  }

 private:
  long ascii_integer(PlyType type) {
    const std::string_view word = next_word();
    const auto value = parse_number<long>(word);
    const int bits = 8 * static_cast<int>(size_of(type));
    const bool is_signed = type == PlyType::int8 || type == PlyType::int16 || type == PlyType::int32;
    const long low = is_signed ? -(1L << (bits - 1)) : 0, high = (1L << (is_signed ? bits - 1 : bits)) - 1;
    if (!value || *value < low || *value > high)
      refuse(quoted(word) + " is not an integer of the type that was promised");
    return *value;
  }
  const char* take(std::size_t bytes) {
    if (data_.size() < bytes) refuse("the file ends early: it is cut short or damaged");
    const char* at = data_.data();
    data_.remove_prefix(bytes);
    return at;
  }
  std::string_view next_word() {
    constexpr std::string_view kSpace = " \t\n\r\f\v";
    take(std::min(data_.find_first_not_of(kSpace), data_.size()));
    if (data_.empty()) refuse("the file ends early: it is cut short or damaged");
    const std::size_t length = std::min(data_.find_first_of(kSpace), data_.size());
    return {take(length), length};
  }
  std::string_view data_;
  PlyFormat format_;
};

void check_vertex_element(const PlyElement& vertex, PlyFormat format) {
  for (const char* name : {"x", "y", "z"}) {
    const PlyProperty* p = vertex.find(name);
    if (!p || p->list || (p->type != PlyType::float32 && p->type != PlyType::float64))
      refuse(std::string("its vertices have no coordinate ") + name + " of type float or double");
    if (p->type == PlyType::float64 && format == PlyFormat::big_endian)
      refuse("big-endian doubles are not supported: save it as little-endian or as text");
  }
}

// vcglib reads edges, checks their vertices, and does without them here; but only as two int.
void check_edge_element(const PlyElement& edge, long vertices) {
  if (vertices < 0) refuse("its edges come before its vertices");
  for (const char* name : {"vertex1", "vertex2"}) {
    const PlyProperty* p = edge.find(name);
    if (!p || p->list || p->type != PlyType::int32)
      refuse(std::string("its edges have no ") + name + " of type int: save it with faces only");
  }
}

}  // namespace

void check_ply(std::string_view text, const Context& context) {
  LineReader lines(text);
  const PlyHeader header = ply_header(lines);
  long vertices = -1;
  long rows = 0, row_of_all = 0;
  for (const PlyElement& element : header.elements) rows += element.rows;
  PlyValues values(lines.rest(), header.format);
  for (const PlyElement& element : header.elements) {
    const PlyProperty* corners = nullptr;
    if (element.rows > 0 && element.properties.empty())
      refuse("the element " + quoted(element.name) + " has no properties");
    if (element.name == "vertex") {
      check_vertex_element(element, header.format);
      check_counts(element.rows, 0, text.size());
      vertices = element.rows;
    } else if (element.name == "face" && element.rows > 0) {
      if (vertices < 0) refuse("its faces come before its vertices");
      corners = face_list(element);
      check_counts(0, element.rows, text.size());
    } else if (element.name == "edge" && element.rows > 0) {
      check_edge_element(element, vertices);
    } else if (element.rows > 0 && (element.name == "tristrips" || element.name == "range_grid"))
      refuse("the element " + quoted(element.name) + " is not supported: save it with faces only");
    for (long row = 0; row < element.rows; ++row) {
      report_row(row_of_all++, rows, context);
      for (const PlyProperty& p : element.properties) {
        if (!p.list) {
          values.skip(p.type);
          continue;
        }
        const long count = values.integer(p.count);
        if (&p != corners) {
          // vcglib skips a binary list as if its count were one byte, and takes an empty one for the end of the file.
          if (count < 0 || (header.format != PlyFormat::ascii && (p.count != PlyType::uint8 || count == 0)))
            refuse("the list " + quoted(p.name) + " is not supported: save the mesh without it");
          for (long i = 0; i < count; ++i) values.skip(p.type);
          continue;
        }
        if (count < 3 || count > 255)
          refuse("face " + std::to_string(row) + " has " + std::to_string(count) + " vertices; 3 to 255 are supported");
        for (long i = 0; i < count; ++i) {
          const long v = values.integer(p.type);
          if (v < 0 || v >= vertices)
            refuse("face " + std::to_string(row) + " refers to vertex " + std::to_string(v) + " of " +
                   std::to_string(vertices));
        }
      }
    }
  }
  if (vertices < 0) refuse("it has no element vertex");
}

}  // namespace ga_symmetry
