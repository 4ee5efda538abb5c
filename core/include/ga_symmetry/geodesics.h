// Geodesic distance fields by fast marching.
#pragma once
#include <Eigen/Core>
#include <limits>
#include <memory>
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/surface.h"

namespace ga_symmetry {

/// sources x vertices, each field contiguous; unit of the surface. +inf = not reached.
using DistanceFields = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Reusable solver: everything that depends on the surface alone is computed once. Thread-safe after construction.
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
  void field(int source, float* out, Workspace& workspace) const;

  /// One field per source, on `threads` threads (0 = all cores). @throws Cancelled
  DistanceFields fields(const std::vector<int>& sources, int threads, const Context& context = {}) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ga_symmetry
