// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/spectral.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

#include "ga_symmetry/errors.h"
#include "matching/face_point.h"
#include "surface/laplacian.h"
#include "surface/neighbors.h"
#include "util/multiply.h"
#include "util/parallel.h"

namespace ga_symmetry {
namespace {

// How many functions one step after the other goes by. Fewer would forget what distances have found; more than these
// took as long as all before them, for 2 % of the error.
constexpr std::array kFunctions{kFewFunctions, 60, 90, 120, kAllFunctions};

constexpr int kVertices = 256;  // that a thread takes at a time

using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// What the functions are at the points, times the vertices' weights.
Rows weighted_at_points(const Rows& of_vertex, const std::vector<SurfacePoint>& points, const Eigen::VectorXf& weights,
                        int threads) {
  Rows out(of_vertex.rows(), of_vertex.cols());
  parallel_blocks(static_cast<int>(out.rows()), kVertices, threads, [&](int begin, int end, int) {
    for (int v = begin; v < end; ++v) {
      const auto& [corner, weight] = points[v];
      out.row(v) = static_cast<float>(weight[0]) * of_vertex.row(corner[0]);
      for (int k = 1; k < 3; ++k)
        if (weight[k] != 0) out.row(v) += static_cast<float>(weight[k]) * of_vertex.row(corner[k]);
      out.row(v) *= weights[v];
    }
  });
  return out;
}

}  // namespace

SpectralRefinement::SpectralRefinement(const Surface& surface, int threads, const Context& context)
    : functions_(eigenfunctions(surface, kFunctions.back(), threads, context)) {}

SurfaceMap SpectralRefinement::refine(const Matching& m, SurfaceMap map, int from, int threads,
                                      const Context& context) const {
  const Surface& surface = m.surface;
  const int n = surface.vertices();
  const int most = static_cast<int>(functions_.cols());
  if (most < kFewFunctions) return map;
  const int last = *std::prev(std::upper_bound(kFunctions.begin(), kFunctions.end(), most));
  const Eigen::Map<const Eigen::VectorXd> area(surface.vertex_area.data(), n);
  const Eigen::VectorXf share = (area / surface.area).cast<float>();
  for (const int k : kFunctions) {
    if (k < std::min(from, last) || k > last) continue;
    const Rows basis = functions_.leftCols(k);
    Eigen::MatrixXf matrix(k, k);
    multiply(basis.transpose(), weighted_at_points(basis, map.point, share, threads), matrix, threads);
    if (m.reflection) matrix = (matrix + matrix.transpose()).eval() / 2;
    Rows to(n, k);
    multiply(basis, matrix.transpose(), to, threads);
    const std::vector<float> even(k, 1.f);
    const auto error = [&](int v, int c) { return (basis.row(v) - to.row(c)).squaredNorm(); };
    const auto descend = [&](int v, int c, float& least) {
      least = error(v, c);
      for (bool moved = true; moved;) {
        moved = false;
        for_each_neighbor(surface, c, [&](int w) {
          const float e = error(v, w);
          if (e < least || (e == least && w < c)) least = e, c = w, moved = true;
        });
      }
      return c;
    };
    const std::vector<int> before = map.partner;  // so that the order of vertices and threads does not matter
    parallel_blocks(n, kVertices, threads, [&](int begin, int end, int) {
      if (context.cancelled()) throw Cancelled();
      for (int v = begin; v < end; ++v) {
        float least;
        int best = descend(v, before[v], least);
        for_each_neighbor(surface, v, [&](int w) {
          if (before[w] == best || error(v, before[w]) > 4 * least) return;
          float e;
          const int c = descend(v, before[w], e);
          if (e < least || (e == least && c < best)) least = e, best = c;
        });
        map.partner[v] = best;
        map.point[v] = nearest_on_faces(
            surface, [&](int c) { return to.row(c).data(); }, k, even.data(), basis.row(v).data(), best);
      }
    });
  }
  return map;
}

}  // namespace ga_symmetry
