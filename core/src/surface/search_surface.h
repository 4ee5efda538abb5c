// SPDX-License-Identifier: GPL-3.0-or-later
// The surface that is searched for a mesh, and the way back to the mesh's own vertices.
#pragma once
#include <string>
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/options.h"
#include "geodesics/anchors.h"
#include "surface/surface.h"

namespace ga_symmetry {

/// One connected surface of moderate size for a mesh in whatever parts and of whatever resolution. That of a mesh in
/// one part is the mesh itself, refined or simplified where its faces are too large or too many. Of several parts the
/// largest leads where the others add little to it; else the surface is a wrap around all of them.
class SearchSurface {
 public:
  /// @param options  `proxy`: vertices of the surface, about; `method`: pairs wants the mesh itself where it is one
  /// part
  /// @throws Cancelled
  SearchSurface(Surface of_mesh, const Options& options, const Context& context = {});

  /// The mesh in its own resolution and parts.
  const Surface& of_mesh() const { return mesh_; }
  /// What is searched.
  const Surface& searched() const { return direct_ ? mesh_ : searched_; }
  /// Whether that is the mesh itself, vertex by vertex.
  bool direct() const { return direct_; }
  /// Per vertex of the mesh's surface: where it stands on the searched one; empty if that is the same.
  const std::vector<SurfacePoint>& place() const { return place_; }
  /// Per vertex of the mesh's surface: its part. @return parts in all
  const std::vector<int>& part() const { return part_; }
  int parts() const { return parts_; }
  /// What was done inside, in one line; "" = nothing.
  std::string summary() const;
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// The vertices of the searched surface that stand for those of the mesh.
  /// @throws InvalidOption  for a vertex that does not exist, is on no face that is worked on, or is given twice
  SurfaceReferences locate(const References& references) const;

 private:
  bool lead(const Surface& mesh, int vertices, const Context& context);
  void wrap_all(const Surface& mesh, int vertices, const Context& context);

  Surface mesh_, searched_;
  bool direct_ = false;
  std::vector<SurfacePoint> place_;
  std::vector<int> part_;
  int parts_ = 1;
  std::vector<std::string> done_, warnings_;
};

}  // namespace ga_symmetry
