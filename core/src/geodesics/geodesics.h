// SPDX-License-Identifier: GPL-3.0-or-later
// Geodesic distance fields by fast marching.
#pragma once
#include <Eigen/Core>
#include <limits>
#include <memory>
#include <vector>

#include "ga_symmetry/context.h"
#include "surface/surface.h"

namespace ga_symmetry {

/// sources x vertices, each field contiguous; unit of the surface. +inf = not reached.
using DistanceFields = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Vertices of a surface with the distance field of each: the fields are the expensive part, so they are kept.
struct Landmarks {
  std::vector<int> vertex;  ///< surface vertex of each landmark
  DistanceFields field;     ///< landmarks x vertices: row i is the field of vertex[i], unit of the surface
};

/// Reusable solver: everything that depends on the surface alone is computed once. Thread-safe after construction.
///
/// A front of distance runs over the triangles. It carries its own curvature, which changes with the way travelled and
/// with the Gaussian curvature of the surface; so the error falls with the square of the edge length, and on flat parts
/// the distance is exact wherever a straight line reaches. d(a,b) and d(b,a) differ by the error: take the mean where
/// symmetry matters. The numbering of the vertices changes nothing but the order of the answer.
/// Memory: about 130 bytes a vertex, and 16 for each workspace.
/// Source: Kimmel & Sethian 1998, with the circular front of Novotni & Klein 2002. Differs: the radius of the front is
/// tracked instead of being taken for the distance, which is wrong wherever the surface is curved; and a vertex is
/// visited again where obtuse triangles hide its true distance at first.
class GeodesicSolver {
 public:
  explicit GeodesicSolver(const Surface& surface);
  ~GeodesicSolver();
  GeodesicSolver(const GeodesicSolver&) = delete;
  GeodesicSolver& operator=(const GeodesicSolver&) = delete;

  /// Scratch memory of one thread.
  struct Workspace;
  struct WorkspaceDeleter {
    void operator()(Workspace* w) const;
  };
  using WorkspacePointer = std::unique_ptr<Workspace, WorkspaceDeleter>;
  WorkspacePointer make_workspace() const;

  /// Distance from `source` to every vertex, written to out[0 .. vertices). No allocation.
  /// @throws InvalidOption  if the source is out of range, here and below
  void field(int source, float* out, Workspace& workspace) const;

  /// The part of the field up to `limit`: the cost is that of the vertices reached, not of the surface. Distances are
  /// those of the whole field, but may be too long within an edge of the limit.
  /// @param out  +inf everywhere but at the vertices in `reached`, where it is made +inf again first
  /// @param reached  empty for a fresh `out`, then as the last call left it; gets the vertices whose distance was
  ///        written to `out`, in no particular order
  void field_within(int source, float limit, float* out, std::vector<int>& reached, Workspace& workspace) const;

  /// Distance to the nearest of several sources, and which of them it is (its place in `sources`; of a repeated vertex
  /// the first). The cost is that of one field. Along the border of two sources' regions the distance may be too long
  /// by a fraction of an edge.
  /// @param distance, label  written at 0 .. vertices
  /// @throws InvalidOption  also if there is no source
  void nearest(const std::vector<int>& sources, float* distance, int* label, Workspace& workspace) const;

  /// One field per source, on `threads` threads (0 = all cores); advances the context. @throws InvalidOption, Cancelled
  DistanceFields fields(const std::vector<int>& sources, int threads, const Context& context = {}) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ga_symmetry
