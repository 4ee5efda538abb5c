// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/laplacian.h"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <vector>

#include "ga_symmetry/errors.h"
#include "util/multiply.h"
#include "util/parallel.h"
#include "util/random.h"

namespace ga_symmetry {

Laplacian cotangent_laplacian(const Surface& s) {
  const int n = s.vertices();
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(12) * s.triangles());
  for_each_cotangent(s, [&](int corner, double weight) {
    const int a = s.triangle[next_corner(corner)], b = s.triangle[previous_corner(corner)];
    weight = std::max(weight, 0.0);
    entries.emplace_back(a, a, weight);
    entries.emplace_back(b, b, weight);
    entries.emplace_back(a, b, -weight);
    entries.emplace_back(b, a, -weight);
  });
  Laplacian out;
  out.stiffness.resize(n, n);
  out.stiffness.setFromTriplets(entries.begin(), entries.end());
  out.mass.resize(n, n);
  out.mass.setIdentity();
  for (int v = 0; v < n; ++v) out.mass.coeffRef(v, v) = s.vertex_area[v];
  return out;
}

namespace {

// Takes from the block what lies in the space of the columns before it. In pieces whose size does not depend on the
// number of threads: nor do the sums. @return how much of each column that was: before.cols() x block.cols()
Eigen::MatrixXf orthogonalize(const Eigen::Ref<const Eigen::MatrixXf>& before, Eigen::MatrixXf& block, int threads) {
  Eigen::MatrixXf part(before.cols(), block.cols());
  multiply(before.transpose(), block, part, threads);
  constexpr int kRows = 1024;
  parallel_blocks(static_cast<int>(before.rows()), kRows, threads, [&](int first, int end, int) {
    block.middleRows(first, end - first).noalias() -= before.middleRows(first, end - first) * part;
  });
  return part;
}

}  // namespace

Eigen::MatrixXf eigenfunctions(const Surface& s, int count, int threads, const Context& context) {
  constexpr int kBlock = 4;     // columns that are multiplied at once; a shape's symmetries make eigenvalues multiple
  constexpr int kSpare = 60;    // dimensions of the space beyond twice those asked for
  constexpr double kShift = 1;  // in eigenvalues of the unit area, of which the first that is not 0 is about 10
  const int n = s.vertices();
  count = std::min(count, n / 2);
  const int blocks = std::min((2 * count + kSpare) / kBlock, n / kBlock), size = blocks * kBlock;
  if (count < 1 || blocks < 1) return Eigen::MatrixXf(n, 0);
  count = std::min(count, size);

  // (L + s M) x = M y becomes symmetric for sqrt(M) x.
  const Laplacian laplacian = cotangent_laplacian(s);
  const Eigen::VectorXd root = (laplacian.mass.diagonal() / s.area).cwiseSqrt();
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(laplacian.stiffness +
                                                                  kShift / s.area * laplacian.mass);
  const auto invert = [&](const Eigen::MatrixXf& block) {
    Eigen::MatrixXf out(n, kBlock);
    constexpr int kColumns = 2;
    parallel_for(kBlock / kColumns, threads, [&](int part, int) {
      const Eigen::MatrixXd right = root.asDiagonal() * block.middleCols(part * kColumns, kColumns).cast<double>();
      out.middleCols(part * kColumns, kColumns) = (root.asDiagonal() * solver.solve(right)).cast<float>();
    });
    return out;
  };
  // Block Lanczos: what is inverted lies in the space of its own block, the one before and a new one, so that the
  // operator in this basis is a band. What rounding adds of the others is taken away each time.
  Eigen::MatrixXf space(n, size);
  Eigen::MatrixXd projected = Eigen::MatrixXd::Zero(size, size);  // the upper half
  Random random(1);                                               // any vectors will do to start from
  Eigen::MatrixXf block(n, kBlock);
  for (int v = 0; v < n; ++v)
    for (int k = 0; k < kBlock; ++k) block(v, k) = static_cast<float>(draw_unit(random) - 0.5);
  block = root.cast<float>().asDiagonal() * block;
  for (int b = 0; b < blocks; ++b) {
    if (context.cancelled()) throw Cancelled();
    const int here = b * kBlock, end = here + kBlock, before = std::max(0, here - kBlock);
    const Eigen::HouseholderQR<Eigen::MatrixXf> basis(block);
    space.middleCols(here, kBlock) = basis.householderQ() * Eigen::MatrixXf::Identity(n, kBlock);
    block = invert(space.middleCols(here, kBlock));
    projected.block(before, here, end - before, kBlock) =
        orthogonalize(space.middleCols(before, end - before), block, threads).cast<double>();
    if (end < size) orthogonalize(space.leftCols(end), block, threads);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(projected.transpose());  // reads the lower half
  const Eigen::MatrixXf most = ritz.eigenvectors().rightCols(count).rowwise().reverse().cast<float>();
  Eigen::MatrixXf out(n, count);
  multiply(root.cwiseInverse().cast<float>().asDiagonal() * space, most, out, threads);
  return out;
}

}  // namespace ga_symmetry
