// What the subcommands write: tables of numbers, and drawings for any mesh viewer.
#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace ga_symmetry::tool {

/// Comma-separated rows, built cell by cell; numbers are the shortest that read back as the same.
class Table {
 public:
  explicit Table(std::string_view header);
  Table& cell(int value);
  Table& cell(double value);
  void end_row();
  const std::string& text() const { return text_; }

 private:
  void append(std::string_view cell);
  std::string text_;
};

/// Points with a value each, and what joins them.
struct Drawing {
  std::vector<double> position;  ///< x,y,z per point
  std::vector<double> quality;   ///< per point
  std::vector<std::array<int, 2>> edges;
  std::vector<int> triangles;  ///< three points each
};

/// As PLY in text form, the values as `quality`.
std::string to_ply(const Drawing& drawing);

/// Is a file of this name a drawing? @throws CLI::ValidationError  unless it ends in .csv or .ply, or there is none
bool wants_drawing(const std::string& path);

/// Writes the file, whole or not at all; no path = the standard output. @throws FileError
void deliver(const std::string& path, const std::string& bytes);

}  // namespace ga_symmetry::tool
