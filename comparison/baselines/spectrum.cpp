// SPDX-License-Identifier: GPL-3.0-or-later
#include "baselines/spectrum.h"

#include <Spectra/SymEigsShiftSolver.h>

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "ga_symmetry/errors.h"
#include "util/parallel.h"

namespace ga_symmetry::baselines {
namespace {

// Spectra's own operation factorises by LU, which takes several times as long.
class ShiftInvert {
 public:
  using Scalar = double;
  explicit ShiftInvert(const Eigen::SparseMatrix<double>& matrix) : matrix_(matrix) {}
  Eigen::Index rows() const { return matrix_.rows(); }
  Eigen::Index cols() const { return matrix_.cols(); }
  void set_shift(double sigma) {
    Eigen::SparseMatrix<double> identity(rows(), cols());
    identity.setIdentity();
    solver_.compute(matrix_ - sigma * identity);
  }
  void perform_op(const double* in, double* out) const {
    Eigen::Map<Eigen::VectorXd>(out, rows()) = solver_.solve(Eigen::Map<const Eigen::VectorXd>(in, rows()));
  }

 private:
  const Eigen::SparseMatrix<double>& matrix_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
};

}  // namespace

Spectrum laplacian_spectrum(const Surface& s, int count) {
  constexpr double kMaxCotangent = 20;  // needles would dominate everything around them
  const int n = s.vertices();
  count = std::min(count, n - 1);
  Eigen::VectorXd scale(n);  // masses ^ -1/2 makes the problem an ordinary one
  for (int v = 0; v < n; ++v) scale[v] = 1 / std::sqrt(s.vertex_area[v] / s.area);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(12) * s.triangles());
  for (int corner = 0; corner < 3 * s.triangles(); ++corner) {
    const int a = s.triangle[next_corner(corner)], b = s.triangle[previous_corner(corner)];
    const Eigen::Vector3d p(s.point(s.triangle[corner])), u = Eigen::Vector3d(s.point(a)) - p,
                                                          w = Eigen::Vector3d(s.point(b)) - p;
    const double half = 0.5 * std::clamp(u.dot(w) / u.cross(w).norm(), -kMaxCotangent, kMaxCotangent);
    entries.emplace_back(a, a, half * scale[a] * scale[a]);
    entries.emplace_back(b, b, half * scale[b] * scale[b]);
    entries.emplace_back(a, b, -half * scale[a] * scale[b]);
    entries.emplace_back(b, a, -half * scale[a] * scale[b]);
  }
  Eigen::SparseMatrix<double> laplacian(n, n);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  ShiftInvert operation(laplacian);
  // Of equal eigenvalues at the end of the list some may be missed, so the end is cut off.
  const int wanted = std::min(n - 1, count + 10);
  Spectra::SymEigsShiftSolver<ShiftInvert> solver(operation, wanted, std::min(n, 2 * wanted + 1), -0.1);
  solver.init();
  if (solver.compute(Spectra::SortRule::LargestMagn, 1000, 1e-8, Spectra::SortRule::SmallestAlge) < wanted)
    throw InvalidMesh("the eigenfunctions of the Laplacian do not converge: remesh the surface with better triangles");
  return {solver.eigenvalues().head(count).cwiseMax(0), scale.asDiagonal() * solver.eigenvectors(count)};
}

std::vector<int> nearest_rows(const Eigen::MatrixXd& queries, const Eigen::MatrixXd& points, int threads) {
  constexpr int kBlock = 64;
  const int count = static_cast<int>(queries.rows());
  const Eigen::VectorXd half_norm = 0.5 * points.rowwise().squaredNorm();
  std::vector<int> out(count);
  parallel_for((count + kBlock - 1) / kBlock, threads, [&](int block, int) {
    const int first = block * kBlock, rows = std::min(kBlock, count - first);
    // |q - p|^2 / 2 without what does not depend on p
    const Eigen::MatrixXd distance = (-points * queries.middleRows(first, rows).transpose()).colwise() + half_norm;
    for (int i = 0; i < rows; ++i) {
      Eigen::Index best;
      distance.col(i).minCoeff(&best);
      out[first + i] = static_cast<int>(best);
    }
  });
  return out;
}

}  // namespace ga_symmetry::baselines
