// SPDX-License-Identifier: GPL-3.0-or-later
#include "baselines/features.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geodesics/sampling.h"

namespace ga_symmetry::baselines {
namespace {

Eigen::VectorXd average_geodesic_distance(const Surface& surface, const GeodesicSolver& solver, int threads) {
  const Landmarks samples = evenly_spaced_samples(surface, solver, std::min(100, surface.vertices()), threads);
  const std::vector<int> patch = nearest_source(samples.field);
  Eigen::VectorXf area = Eigen::VectorXf::Zero(static_cast<Eigen::Index>(samples.vertex.size()));
  for (int v = 0; v < surface.vertices(); ++v) area[patch[v]] += static_cast<float>(surface.vertex_area[v]);
  return (samples.field.transpose() * area).cast<double>() / (surface.area * surface.unit());
}

}  // namespace

Eigen::MatrixXd wave_kernel_signature(const Spectrum& spectrum, int energies) {
  const Eigen::Index used = spectrum.value.size() - 1;  // the constant function says nothing
  const Eigen::ArrayXd log_value = spectrum.value.tail(used).array().max(1e-6).log();
  const Eigen::ArrayXXd squares = spectrum.function.rightCols(used).array().square();
  const double first = log_value[0], last = log_value[used - 1] / 1.02;
  const double step = (last - first) / energies, sigma = 7 * step;
  Eigen::MatrixXd out(squares.rows(), energies);
  for (int k = 0; k < energies; ++k) {
    const double energy = first + 2 * sigma + k * (last - first - 4 * sigma) / (energies - 1);
    const Eigen::ArrayXd weight = (-(energy - log_value).square() / (2 * sigma * sigma)).exp();
    out.col(k) = (squares.matrix() * weight.matrix()) / weight.sum();
  }
  return out;
}

Eigen::MatrixXd symmetry_features(const Surface& surface, const GeodesicSolver& solver, const Spectrum& spectrum,
                                  int threads) {
  constexpr int kEnergies = 100;
  Eigen::MatrixXd out(surface.vertices(), 1 + kEnergies);
  out.col(0) = average_geodesic_distance(surface, solver, threads);
  out.rightCols(kEnergies) = wave_kernel_signature(spectrum, kEnergies);
  for (Eigen::Index k = 0; k < out.cols(); ++k) {
    out.col(k).array() -= out.col(k).mean();
    const double deviation = std::sqrt(out.col(k).squaredNorm() / static_cast<double>(out.rows()));
    if (deviation > 0) out.col(k) /= deviation * (k == 0 ? 1 : std::sqrt(kEnergies));
  }
  return out;
}

std::vector<int> match_across(const Eigen::MatrixXd& features, const std::vector<int>& side, int threads) {
  std::vector<int> out(side.size()), member[2];
  std::iota(out.begin(), out.end(), 0);
  for (int v = 0; v < static_cast<int>(side.size()); ++v)
    if (side[v] != 0) member[side[v] > 0].push_back(v);
  if (member[0].empty() || member[1].empty()) return out;
  for (const auto& [from, to] : {std::pair(member[0], member[1]), std::pair(member[1], member[0])}) {
    const std::vector<int> match = nearest_rows(features(from, Eigen::all), features(to, Eigen::all), threads);
    for (std::size_t i = 0; i < from.size(); ++i) out[from[i]] = to[match[i]];
  }
  return out;
}

}  // namespace ga_symmetry::baselines
