// SPDX-License-Identifier: GPL-3.0-or-later
// Readers of the mesh formats; private to the core. Each checks what it reads in the same pass: a file cut short, a
// face of vertices that do not exist or a lying header ends in a refusal, and no header makes room for more than the
// file can hold.
//
// Polygons become fans about their first vertex; faces of less than three vertices are skipped.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/mesh.h"

namespace ga_symmetry {

/// Reports progress.
/// @param text  the whole file
/// @throws FileError  what is wrong and where, without the file's name
/// @throws Cancelled
TriangleMesh read_off(std::string_view text, const Context& context);
TriangleMesh read_ply(std::string_view text, const Context& context);
TriangleMesh read_obj(std::string_view text, const Context& context);
TriangleMesh read_stl(std::string_view text, const Context& context);

// What they share:

[[noreturn]] void refuse_line(long line, const std::string& why);

/// Reports from time to time how far a reader is, of rows or bytes alike.
inline void report_reading(long row, double done, double all, const Context& context) {
  if (row % 1024 == 0) context.report(done / all, "reading");
}

/// Splits a polygon whose vertices are added one by one.
class Fan {
 public:
  explicit Fan(std::vector<int>& triangle) : triangle_(triangle) {}
  void add(int vertex) {
    if (corners_ == 0) first_ = vertex;
    if (corners_ >= 2) triangle_.insert(triangle_.end(), {first_, last_, vertex});
    last_ = vertex;
    ++corners_;
  }

 private:
  std::vector<int>& triangle_;
  int first_ = 0, last_ = 0;
  long corners_ = 0;
};

}  // namespace ga_symmetry
