// SPDX-License-Identifier: GPL-3.0-or-later
#include "baselines/spectral.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "ga_symmetry/errors.h"

namespace ga_symmetry::baselines {
namespace {

// Rows of functions as points in which distances are comparable: the functions over the roots of their eigenvalues.
Eigen::MatrixXd embedding(const Spectrum& spectrum, Eigen::Index functions) {
  const Eigen::VectorXd scale = spectrum.value.segment(1, functions).cwiseMax(1e-9).cwiseSqrt().cwiseInverse();
  return spectrum.function.middleCols(1, functions) * scale.asDiagonal();
}

// How far the mapped references are from where they should be, over how far apart the pairs are.
double reference_error(const Eigen::MatrixXd& points, const Eigen::MatrixXd& mapped, const References& references) {
  double off = 0, apart = 0;
  for (int a : references.axis) off += (mapped.row(a) - points.row(a)).squaredNorm();
  for (const auto& [l, r] : references.pairs) {
    off += (mapped.row(l) - points.row(r)).squaredNorm() + (mapped.row(r) - points.row(l)).squaredNorm();
    apart += 2 * (points.row(l) - points.row(r)).squaredNorm();
  }
  return apart > 0 ? off / apart : 0;
}

struct Pattern {
  Eigen::VectorXd sign;  // without the constant function
  double score = 0;
  bool reversing = false;
};

// The score of a pattern, and the matches of the samples.
std::pair<double, std::vector<int>> match_samples(const Eigen::MatrixXd& samples, const Eigen::VectorXd& sign) {
  const Eigen::MatrixXd mirrored = samples * sign.asDiagonal();
  std::vector<int> match = nearest_rows(mirrored, samples, 1);
  const double moved = (mirrored - samples).squaredNorm();
  return {(mirrored - samples(match, Eigen::all)).squaredNorm() / std::max(moved, 1e-300), std::move(match)};
}

}  // namespace

std::vector<int> space_samples(const Surface& surface, int count) {
  const Eigen::Map<const Eigen::Matrix<double, 3, Eigen::Dynamic>> points(surface.position.data(), 3,
                                                                          surface.vertices());
  Eigen::VectorXd distance = (points.colwise() - points.rowwise().mean()).colwise().squaredNorm();
  std::vector<int> out;
  for (count = std::min(count, surface.vertices()); static_cast<int>(out.size()) < count;) {
    Eigen::Index next;
    distance.maxCoeff(&next);
    const Eigen::VectorXd here = (points.colwise() - points.col(next)).colwise().squaredNorm();
    distance = out.empty() ? here : distance.cwiseMin(here);
    out.push_back(static_cast<int>(next));
  }
  return out;
}

double reversed_share(const Surface& s, const std::vector<int>& partner) {
  const auto normal = [&](int a, int b, int c) -> Eigen::Vector3d {
    const Eigen::Vector3d p(s.point(a)), q(s.point(b)), r(s.point(c));
    return (q - p).cross(r - p);
  };
  std::vector<Eigen::Vector3d> outward(s.vertices(), Eigen::Vector3d::Zero());
  for (int c = 0; c < 3 * s.triangles(); ++c)
    outward[s.triangle[c]] += normal(s.triangle[c], s.triangle[next_corner(c)], s.triangle[previous_corner(c)]);
  int reversed = 0, kept = 0;
  for (int f = 0; f < s.triangles(); ++f) {
    const int a = partner[s.triangle[3 * f]], b = partner[s.triangle[3 * f + 1]], c = partner[s.triangle[3 * f + 2]];
    if (a < 0 || b < 0 || c < 0) continue;
    const double turn = normal(a, b, c).dot(outward[a] + outward[b] + outward[c]);
    reversed += turn < 0;
    kept += turn > 0;
  }
  return reversed + kept > 0 ? static_cast<double>(reversed) / (reversed + kept) : 0;
}

std::vector<int> to_partners(const Spectrum& spectrum, const FunctionalMap& map, int threads) {
  const Eigen::MatrixXd functions = spectrum.function.leftCols(map.rows());
  return nearest_rows(functions * map, functions, threads);
}

FunctionalMap to_functional_map(const Spectrum& spectrum, const std::vector<int>& vertices,
                                const std::vector<int>& partner, int functions) {
  const Eigen::MatrixXd from = spectrum.function(vertices, Eigen::seqN(0, functions));
  const Eigen::MatrixXd to = spectrum.function(partner, Eigen::seqN(0, functions));
  return (from.transpose() * from).ldlt().solve(from.transpose() * to);
}

std::vector<FunctionalMap> sign_patterns(const Surface& surface, const Spectrum& spectrum, const References& references,
                                         const SignOptions& options, int threads) {
  const int available = static_cast<int>(spectrum.value.size()) - 1;
  if (available < 1) throw InvalidMesh("the surface has too few vertices for eigenfunctions");
  const int enumerated = std::min(options.enumerated, available), functions = std::min(options.functions, available);
  const std::vector<int> vertices = space_samples(surface, 300);
  const Eigen::MatrixXd points = embedding(spectrum, functions), samples = points(vertices, Eigen::all);
  const Eigen::MatrixXd first = samples.leftCols(enumerated);
  std::vector<int> around;  // some samples and their neighbours: their triangles tell the orientation
  for (std::size_t i = 0; i < vertices.size() && i < 100; ++i)
    for (int c = surface.first_corner[vertices[i]]; c < surface.first_corner[vertices[i] + 1]; ++c)
      around.insert(around.end(), {vertices[i], surface.triangle[next_corner(surface.corner_at[c])],
                                   surface.triangle[previous_corner(surface.corner_at[c])]});
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());

  std::vector<Pattern> patterns;
  for (int bits = 1; bits < 1 << enumerated; ++bits) {  // 0 is the identity
    Pattern p{Eigen::VectorXd::Ones(functions)};
    for (int i = 0; i < enumerated; ++i)
      if (bits >> i & 1) p.sign[i] = -1;
    p.score = match_samples(first, p.sign.head(enumerated)).first +
              reference_error(points.leftCols(enumerated),
                              points.leftCols(enumerated) * p.sign.head(enumerated).asDiagonal(), references);
    patterns.push_back(p);
  }
  const auto better = [](const Pattern& a, const Pattern& b) {
    return std::make_pair(!a.reversing, a.score) < std::make_pair(!b.reversing, b.score);
  };
  std::stable_sort(patterns.begin(), patterns.end(), better);
  patterns.resize(std::min<std::size_t>(patterns.size(), 8 * static_cast<std::size_t>(options.starts)));
  for (Pattern& p : patterns) {
    for (int k = enumerated; k < functions; ++k) {
      const std::vector<int> match = match_samples(samples.leftCols(k), p.sign.head(k)).second;
      const Eigen::VectorXd next = samples.col(k);
      p.sign[k] = next.dot(next(match)) < 0 ? -1 : 1;
    }
    const Eigen::MatrixXd mirrored = points * p.sign.asDiagonal();
    p.score = match_samples(samples, p.sign).first + reference_error(points, mirrored, references);
    if (!options.reversing || !surface.orientable) continue;
    const std::vector<int> match = nearest_rows(mirrored(around, Eigen::all), points, threads);
    std::vector<int> partner(surface.vertices(), -1);
    for (std::size_t i = 0; i < around.size(); ++i) partner[around[i]] = match[i];
    p.reversing = reversed_share(surface, partner) > 0.5;
  }
  std::stable_sort(patterns.begin(), patterns.end(), better);
  std::vector<FunctionalMap> out;
  for (const Pattern& p : patterns) {
    if (static_cast<int>(out.size()) == options.starts) break;
    Eigen::VectorXd diagonal(functions + 1);
    diagonal << 1, p.sign;
    out.push_back(diagonal.asDiagonal());
  }
  return out;
}

std::vector<int> zoomout(const Surface& surface, const Spectrum& spectrum, const std::vector<FunctionalMap>& starts,
                         const References& references, const ZoomOutOptions& options, int threads,
                         const Context& context) {
  const int functions = std::min(options.functions, static_cast<int>(spectrum.value.size()));
  const std::vector<int> vertices = space_samples(surface, options.samples > 0 ? options.samples : surface.vertices());
  const Eigen::MatrixXd rows = spectrum.function(vertices, Eigen::all), points = embedding(spectrum, functions - 1);
  std::vector<int> best;
  std::pair<bool, double> lowest{true, std::numeric_limits<double>::infinity()};
  for (const FunctionalMap& start : starts) {
    FunctionalMap map = start;
    for (int k = static_cast<int>(map.rows()); k < functions;) {
      if (context.cancelled()) throw Cancelled();
      std::vector<int> partner = nearest_rows(rows.leftCols(k) * map, rows.leftCols(k), threads);
      for (int& p : partner) p = vertices[p];
      k = std::min(functions, k + options.step);
      map = to_functional_map(spectrum, vertices, partner, k);
    }
    const Eigen::Index k = map.rows();
    const std::vector<int> partner = to_partners(spectrum, map, threads);
    const std::pair<bool, double> rank{
        options.reversing && surface.orientable && reversed_share(surface, partner) <= 0.5,
        (map.transpose() * map - Eigen::MatrixXd::Identity(k, k)).squaredNorm() / static_cast<double>(k) +
            reference_error(points, points(partner, Eigen::all), references)};
    if (best.empty() || rank < lowest) lowest = rank, best = partner;
  }
  return best;
}

}  // namespace ga_symmetry::baselines
