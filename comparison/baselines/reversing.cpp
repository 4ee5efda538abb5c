// SPDX-License-Identifier: GPL-3.0-or-later
#include "baselines/reversing.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "baselines/features.h"

namespace ga_symmetry::baselines {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

// g -> n . (grad f x grad g) in the functions: the integral of each function times the area form df ^ dg, which is
// constant over a triangle.
Matrix along_level_lines(const Surface& s, const Matrix& functions, const Vector& f) {
  Matrix of_vertices = Matrix::Zero(functions.rows(), functions.cols());
  for (int t = 0; t < s.triangles(); ++t) {
    const int* v = &s.triangle[3 * static_cast<std::size_t>(t)];
    const auto b = functions.row(v[1]) - functions.row(v[0]), c = functions.row(v[2]) - functions.row(v[0]);
    const Eigen::RowVectorXd form = ((f[v[1]] - f[v[0]]) * c - (f[v[2]] - f[v[0]]) * b) / 6;
    for (int k = 0; k < 3; ++k) of_vertices.row(v[k]) += form;
  }
  return functions.transpose() * of_vertices;
}

// Adds what makes C A = sign A C to the normal equations for C, column after column.
void add_commuting(const Matrix& a, double sign, double weight, Matrix& normal) {
  const Eigen::Index k = a.rows();
  const double scale = a.norm();
  if (scale == 0) return;
  Matrix equations = Matrix::Zero(k * k, k * k);
  for (Eigen::Index i = 0; i < k; ++i) {
    equations.block(i * k, i * k, k, k) -= sign * a / scale;
    for (Eigen::Index j = 0; j < k; ++j) equations.block(i * k, j * k, k, k).diagonal().array() += a(j, i) / scale;
  }
  normal.noalias() += weight * equations.transpose() * equations;
}

}  // namespace

FunctionalMap reversing_map(const Surface& surface, const Spectrum& spectrum, const ReversingOptions& options) {
  const Eigen::Index k = std::min<Eigen::Index>(options.functions, spectrum.value.size());
  const Matrix functions = spectrum.function.leftCols(k);
  const Vector mass = Eigen::Map<const Vector>(surface.vertex_area.data(), surface.vertices()) / surface.area;
  const Matrix signature = wave_kernel_signature(spectrum, options.energies);
  Matrix normal = Matrix::Zero(k * k, k * k), kept = Matrix::Zero(k, k);
  for (Eigen::Index e = options.every - 1; e < signature.cols(); e += options.every) {
    Vector f = signature.col(e);
    f.array() -= mass.dot(f);
    const double norm = std::sqrt(mass.dot(f.cwiseAbs2()));
    if (norm == 0) continue;
    f /= norm;
    const Vector coefficients = functions.transpose() * mass.asDiagonal() * f;
    kept += options.descriptors * coefficients * coefficients.transpose();
    const Matrix product = functions.transpose() * (mass.cwiseProduct(f).asDiagonal() * functions);
    add_commuting(product, 1, options.products, normal);
    add_commuting(along_level_lines(surface, functions, f), -1, options.orientation, normal);
  }
  add_commuting(spectrum.value.head(k).asDiagonal().toDenseMatrix(), 1, options.laplacian, normal);
  // C f = f for every descriptor.
  for (Eigen::Index i = 0; i < k; ++i)
    for (Eigen::Index j = 0; j < k; ++j) normal.block(i * k, j * k, k, k).diagonal().array() += kept(i, j);
  const Vector solution = normal.ldlt().solve(Eigen::Map<const Vector>(kept.data(), k * k));
  const Eigen::JacobiSVD<Matrix> parts(Eigen::Map<const Matrix>(solution.data(), k, k),
                                       Eigen::ComputeFullU | Eigen::ComputeFullV);
  return parts.matrixU() * parts.matrixV().transpose();
}

}  // namespace ga_symmetry::baselines
