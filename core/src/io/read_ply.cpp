// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ga_symmetry/errors.h"
#include "io/mesh_formats.h"
#include "util/text_scan.h"

namespace ga_symmetry {
namespace {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class Format { ascii, little_endian, big_endian };

struct Property {
  std::string name;
  Type type;
  bool list = false;
  Type count = Type::uint8;
};

struct Element {
  std::string name;
  long rows = 0;
  std::vector<Property> properties;
  const Property* find(std::string_view property) const {
    for (const Property& p : properties)
      if (p.name == property) return &p;
    return nullptr;
  }
};

struct Header {
  Format format = Format::ascii;
  std::vector<Element> elements;
};

bool is_integer(Type type) { return type != Type::float32 && type != Type::float64; }

std::size_t size_of(Type type) {
  constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

Type type_of(std::string_view name, long line) {
  constexpr std::array<std::array<std::string_view, 2>, 8> kNames{{{"char", "int8"},
                                                                   {"uchar", "uint8"},
                                                                   {"short", "int16"},
                                                                   {"ushort", "uint16"},
                                                                   {"int", "int32"},
                                                                   {"uint", "uint32"},
                                                                   {"float", "float32"},
                                                                   {"double", "float64"}}};
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (name == kNames[i][0] || name == kNames[i][1]) return static_cast<Type>(i);
  refuse_line(line, quoted(name) + " is not a PLY type");
}

Format format_of(std::string_view name, long line) {
  if (name == "ascii") return Format::ascii;
  if (name == "binary_little_endian") return Format::little_endian;
  if (name == "binary_big_endian") return Format::big_endian;
  refuse_line(line, quoted(name) + " is not a PLY format");
}

Header read_header(LineReader& lines) {
  Header header;
  bool formatted = false;
  for (std::string_view line; lines.next(line);) {
    const long number = lines.number();
    const std::vector<std::string_view> words = split(line, " \t\r");
    if (number == 1) {
      if (words.empty() || words[0] != "ply") throw FileError("it does not begin with the word ply");
    } else if (lines.rest().empty() && (words.empty() || words[0] != "end_header")) {
      break;  // the line is cut off, too
    } else if (words.empty() || words[0] == "comment" || words[0] == "obj_info") {
      continue;
    } else if (!formatted) {
      if (words.size() < 3 || words[0] != "format") refuse_line(number, "the format should be given here");
      header.format = format_of(words[1], number);
      formatted = true;
    } else if (words[0] == "end_header") {
      return header;
    } else if (words[0] == "element" && words.size() == 3) {
      const auto rows = parse_number<int>(words[2]);
      if (!rows || *rows < 0) refuse_line(number, quoted(words[2]) + " is not a number of elements");
      for (const Element& e : header.elements)
        if (e.name == words[1]) refuse_line(number, "a second element " + quoted(words[1]));
      header.elements.push_back({std::string(words[1]), *rows, {}});
    } else if (words[0] == "property" && !header.elements.empty() && words.size() == 3) {
      header.elements.back().properties.push_back({std::string(words[2]), type_of(words[1], number)});
    } else if (words[0] == "property" && !header.elements.empty() && words.size() == 5 && words[1] == "list") {
      const Type count = type_of(words[2], number);
      if (!is_integer(count)) refuse_line(number, "a list cannot have " + quoted(words[2]) + " many values");
      header.elements.back().properties.push_back({std::string(words[4]), type_of(words[3], number), true, count});
    } else {
      refuse_line(number, quoted(line) + " is not understood");
    }
  }
  throw FileError("the file ends within its header");
}

[[noreturn]] void refuse_end() { throw FileError("the file ends early: it is cut short or damaged"); }

// Values of a text file in their order; where lines end does not matter.
class TextValues {
 public:
  TextValues(std::string_view text, long line) : scan_(text, TextScanner::kNoComments, line) {}
  static std::size_t least_bytes(Type) { return 2; }            // a digit and a blank
  std::size_t left() const { return scan_.rest().size() + 1; }  // the last value needs no blank
  std::string where() const { return "line " + std::to_string(scan_.line()) + ": "; }
  void skip(Type) {
    to_value();
    scan_.drop_word();
  }
  void skip_many(Type type, long count) {
    for (long i = 0; i < count; ++i) skip(type);
  }
  double real(Type type) {
    to_value();
    if (type == Type::float32) return read<float>();
    if (type == Type::float64) return read<double>();
    return static_cast<double>(integer(type));
  }
  std::int64_t integer(Type type) {
    using Limits = std::array<std::int64_t, 2>;
    constexpr std::array<Limits, 6> kLimits{
        {{-128, 127}, {0, 255}, {-32768, 32767}, {0, 65535}, {-2147483648LL, 2147483647}, {0, 4294967295LL}}};
    to_value();
    const Limits limits = kLimits[static_cast<std::size_t>(type)];
    std::int64_t value;
    const std::string_view rest = scan_.rest();
    if (!scan_.read(value) || value < limits[0] || value > limits[1])
      throw FileError(where() + quoted(rest.substr(0, rest.find_first_of(" \t\n\r\f\v"))) +
                      " is not an integer of the type that was promised");
    return value;
  }

 private:
  void to_value() {
    if (!scan_.next()) refuse_end();
  }
  template <class Real>
  double read() {
    Real value;
    if (!scan_.read(value)) throw FileError(where() + quoted(scan_.word()) + " is not a number");
    return value;
  }
  TextScanner scan_;
};

class BinaryValues {
 public:
  BinaryValues(std::string_view data, bool big_endian)
      : at_(data.data()), end_(data.data() + data.size()), big_endian_(big_endian) {}
  static std::size_t least_bytes(Type type) { return size_of(type); }
  std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }
  static std::string where() { return ""; }
  void skip(Type type) { take(size_of(type)); }
  void skip_many(Type type, long count) { take(static_cast<std::size_t>(count) * size_of(type)); }
  double real(Type type) {
    if (type == Type::float32) return from_bits<float>(bits<std::uint32_t>());
    if (type == Type::float64) return from_bits<double>(bits<std::uint64_t>());
    return static_cast<double>(integer(type));
  }
  std::int64_t integer(Type type) {
    switch (type) {
      case Type::int8:
        return static_cast<std::int8_t>(bits<std::uint8_t>());
      case Type::uint8:
        return bits<std::uint8_t>();
      case Type::int16:
        return static_cast<std::int16_t>(bits<std::uint16_t>());
      case Type::uint16:
        return bits<std::uint16_t>();
      case Type::int32:
        return static_cast<std::int32_t>(bits<std::uint32_t>());
      default:
        return bits<std::uint32_t>();
    }
  }

 private:
  const char* take(std::size_t bytes) {
    if (left() < bytes) refuse_end();
    const char* from = at_;
    at_ += bytes;
    return from;
  }
  template <class Bits>
  Bits bits() {
    const char* from = take(sizeof(Bits));
    Bits value = 0;
    for (std::size_t i = 0; i < sizeof(Bits); ++i) {
      const std::size_t place = big_endian_ ? sizeof(Bits) - 1 - i : i;
      value = static_cast<Bits>(value | static_cast<Bits>(static_cast<unsigned char>(from[i])) << 8 * place);
    }
    return value;
  }
  template <class Real, class Bits>
  static Real from_bits(Bits bits) {
    static_assert(sizeof(Real) == sizeof(Bits) && std::numeric_limits<Real>::is_iec559);
    Real value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }
  const char* at_;
  const char* end_;
  bool big_endian_;
};

// Walks over the elements in the order of the header and keeps what makes a mesh.
template <class Values>
class Reader {
 public:
  Reader(Values values, const Header& header, const Context& context) : values_(values), context_(context) {
    for (const Element& element : header.elements) all_rows_ += static_cast<double>(element.rows);
  }
  TriangleMesh read(const Header& header) {
    for (const Element& element : header.elements) {
      if (element.rows == 0 && element.name != "vertex") continue;
      check_rows(element);
      if (element.name == "vertex")
        read_vertices(element);
      else if (element.name == "face")
        read_polygons(element, false);
      else if (element.name == "tristrips")
        read_polygons(element, true);
      else if (element.name == "range_grid")
        throw FileError("range grids are not supported: save it as a mesh of faces");
      else
        for_rows(element, [&](const Property& p) { skip(p); });
    }
    if (vertices_ < 0) throw FileError("it has no element vertex");
    return std::move(mesh_);
  }

 private:
  void check_rows(const Element& element) const {
    if (element.rows > 0 && element.properties.empty())
      throw FileError("the element " + quoted(element.name) + " has no properties");
    if (static_cast<std::size_t>(element.rows) > values_.left() / std::max<std::size_t>(row_bytes(element), 1))
      throw FileError("the header promises " + std::to_string(element.rows) + " rows of the element " +
                      quoted(element.name) + ", more than the file can hold: it is cut short or damaged");
  }
  static std::size_t row_bytes(const Element& element) {
    std::size_t bytes = 0;
    for (const Property& p : element.properties) bytes += Values::least_bytes(p.list ? p.count : p.type);
    return bytes;
  }
  template <class Take>
  void for_rows(const Element& element, const Take& take) {
    for (row_ = 0; row_ < element.rows; ++row_) {
      report_reading(row_, rows_before_ + static_cast<double>(row_), all_rows_, context_);
      for (const Property& p : element.properties) take(p);
    }
    rows_before_ += static_cast<double>(element.rows);
  }
  void skip(const Property& p) { p.list ? values_.skip_many(p.type, count(p)) : values_.skip(p.type); }
  long count(const Property& p) {
    const std::int64_t n = values_.integer(p.count);
    if (n < 0) throw FileError(values_.where() + "the list " + quoted(p.name) + " has a negative number of values");
    return static_cast<long>(n);
  }

  void read_vertices(const Element& element) {
    const std::array<const Property*, 3> xyz{element.find("x"), element.find("y"), element.find("z")};
    for (std::size_t k = 0; k < 3; ++k)
      if (!xyz[k] || xyz[k]->list) throw FileError(std::string("its vertices have no coordinate ") + "xyz"[k]);
    mesh_.position.resize(3 * static_cast<std::size_t>(element.rows));
    for_rows(element, [&](const Property& p) {
      const std::size_t k = &p == xyz[0] ? 0 : &p == xyz[1] ? 1 : &p == xyz[2] ? 2 : 3;
      if (k == 3)
        skip(p);
      else
        mesh_.position[3 * static_cast<std::size_t>(row_) + k] = values_.real(p.type);
    });
    vertices_ = element.rows;
  }

  void read_polygons(const Element& element, bool strips) {
    if (vertices_ < 0) throw FileError("its faces come before its vertices");
    const Property* corners = element.find("vertex_indices");
    if (!corners) corners = element.find("vertex_index");
    if (!corners || !corners->list || !is_integer(corners->type))
      throw FileError("the element " + quoted(element.name) +
                      " has no list vertex_indices of integers: save it as `property list uchar int`");
    const std::size_t triangle_bytes =
        row_bytes(element) + 3 * Values::least_bytes(corners->type);  // of a row of three vertices
    if (!strips)
      mesh_.triangle.reserve(mesh_.triangle.size() +
                             3 * std::min(static_cast<std::size_t>(element.rows), values_.left() / triangle_bytes));
    for_rows(element, [&](const Property& p) {
      if (&p != corners)
        skip(p);
      else if (strips)
        read_strip(p);
      else
        read_polygon(p);
    });
  }

  void read_polygon(const Property& p) {
    Fan fan(mesh_.triangle);
    for (long left = count(p); left > 0; --left) fan.add(vertex(values_.integer(p.type)));
  }

  // Of Stanford's models: each vertex makes a triangle with the two before it, every other one turned; -1 begins anew.
  void read_strip(const Property& p) {
    std::array<int, 2> last{};
    long length = 0;
    for (long left = count(p); left > 0; --left) {
      const std::int64_t index = values_.integer(p.type);
      if (index == -1) {
        length = 0;
        continue;
      }
      const int v = vertex(index);
      if (length >= 2) mesh_.triangle.insert(mesh_.triangle.end(), {last[length % 2], last[1 - length % 2], v});
      last[0] = std::exchange(last[1], v);
      ++length;
    }
  }

  int vertex(std::int64_t index) const {
    if (index < 0 || index >= vertices_)
      throw FileError(values_.where() + "face " + std::to_string(row_) + " refers to vertex " + std::to_string(index) +
                      " of " + std::to_string(vertices_));
    return static_cast<int>(index);
  }

  Values values_;
  const Context& context_;
  TriangleMesh mesh_;
  long vertices_ = -1;
  long row_ = 0;
  double rows_before_ = 0, all_rows_ = 0;
};

}  // namespace

TriangleMesh read_ply(std::string_view text, const Context& context) {
  LineReader lines(text);
  const Header header = read_header(lines);
  if (header.format == Format::ascii)
    return Reader(TextValues(lines.rest(), lines.number() + 1), header, context).read(header);
  return Reader(BinaryValues(lines.rest(), header.format == Format::big_endian), header, context).read(header);
}

}  // namespace ga_symmetry
