// SPDX-License-Identifier: GPL-3.0-or-later
#include "ga_symmetry/partners.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "ga_symmetry/errors.h"
#include "util/random.h"

namespace ga_symmetry {
namespace {

double median(std::vector<double> values) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// Partners of neighbours are neighbours, on any shape; in a table of another mesh they are strangers.
bool keeps_neighbours(const std::vector<int>& partner, const TriangleMesh& mesh) {
  constexpr int kTrials = 1000;
  std::vector<int> corners;  // whose next corner has a partner, too
  for (int c = 0; c < static_cast<int>(mesh.triangle.size()); ++c)
    if (partner[mesh.triangle[c]] >= 0 && partner[mesh.triangle[c % 3 == 2 ? c - 2 : c + 1]] >= 0) corners.push_back(c);
  if (corners.empty()) return true;
  const auto apart = [&](int a, int b) {
    const double *p = &mesh.position[3 * static_cast<std::size_t>(partner[a])],
                 *q = &mesh.position[3 * static_cast<std::size_t>(partner[b])];
    return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
  };
  Random random(1);
  std::vector<double> neighbours, strangers;
  for (int i = 0; i < kTrials; ++i) {
    const int c = corners[draw_below(random, corners.size())], d = corners[draw_below(random, corners.size())];
    neighbours.push_back(apart(mesh.triangle[c], mesh.triangle[c % 3 == 2 ? c - 2 : c + 1]));
    strangers.push_back(apart(mesh.triangle[c], mesh.triangle[d]));
  }
  return median(neighbours) <= 0.5 * median(strangers);
}

}  // namespace

void check_partners(const Partners& p, const TriangleMesh& mesh) {
  const auto n = static_cast<std::size_t>(mesh.vertices());
  if (p.partner.size() != n || p.fitness.size() != n || p.side.size() != n)
    throw InvalidOption("there must be a partner, a fitness and a side for each of the mesh's " + std::to_string(n) +
                        " vertices, got " + std::to_string(p.partner.size()) + ", " + std::to_string(p.fitness.size()) +
                        " and " + std::to_string(p.side.size()) + ": find the partners of this mesh again");
  for (std::size_t v = 0; v < n; ++v)
    if (p.partner[v] < -1 || p.partner[v] >= mesh.vertices() || !(p.fitness[v] >= 0) || std::abs(p.side[v]) > 1)
      throw InvalidOption("vertex " + std::to_string(v) + " has the partner " + std::to_string(p.partner[v]) +
                          ", the fitness " + std::to_string(p.fitness[v]) + " and the side " +
                          std::to_string(p.side[v]) + ", which cannot be: find the partners of this mesh again");
  if (!keeps_neighbours(p.partner, mesh))
    throw InvalidOption(
        "the partners are not of this mesh: those of neighbours lie as far apart as if drawn at random; find the "
        "partners of this mesh again");
}

}  // namespace ga_symmetry
