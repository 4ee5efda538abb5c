// SPDX-License-Identifier: GPL-3.0-or-later
#include "ga_symmetry/colors.h"

#include <vcg/space/color4.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "ga_symmetry/errors.h"

namespace ga_symmetry {
namespace {

constexpr Color kNone{128, 128, 128}, kLeft{49, 116, 196}, kRight{232, 133, 41}, kMiddle{30, 30, 30};
constexpr double kAxis = 0.02;  // of the diagonal: within that of its partner a vertex is dark

// Dark towards the axis. @param apart  distance between vertex and partner, over the diagonal
Color shaded(const Eigen::Vector3d& color, double apart) {
  const double light = std::min(1.0, 0.15 + 0.85 * apart / kAxis);
  Color out;
  for (int k = 0; k < 3; ++k)
    out[k] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(color[k] * light, 0.0, 1.0)));
  return out;
}

struct Places {
  Eigen::Map<const Eigen::Matrix3Xd> at;
  Eigen::Vector3d low, size;
  double diagonal;
  explicit Places(const TriangleMesh& mesh)
      : at(mesh.position.data(), 3, mesh.vertices()),
        low(at.rowwise().minCoeff()),
        size((at.rowwise().maxCoeff() - low).cwiseMax(1e-30)),
        diagonal(size.norm()) {}
};

}  // namespace

std::vector<Color> vertex_colors(const TriangleMesh& mesh, const Partners& p, ColorBy by) {
  const auto n = static_cast<std::size_t>(mesh.vertices());
  if (p.partner.size() != n || p.fitness.size() != n || p.side.size() != n)
    throw InvalidOption("colours need one partner a vertex: there are " + std::to_string(p.partner.size()) +
                        ", the mesh has " + std::to_string(n) + " vertices");
  std::vector<Color> out(n, kNone);
  if (n == 0) return out;
  const Places places(mesh);
  for (std::size_t v = 0; v < n; ++v) {
    if (by == ColorBy::fitness) out[v] = fitness_color(p.fitness[v]);
    if (by == ColorBy::fitness || p.partner[v] < 0) continue;
    if (by == ColorBy::sides) {
      out[v] = p.side[v] > 0 ? kLeft : p.side[v] < 0 ? kRight : kMiddle;
      continue;
    }
    const Eigen::Vector3d here = places.at.col(static_cast<Eigen::Index>(v)), there = places.at.col(p.partner[v]);
    const Eigen::Vector3d place = p.side[v] > 0 ? here : p.side[v] < 0 ? there : Eigen::Vector3d((here + there) / 2);
    // From a dark to a light tone along each axis of space.
    const Eigen::Vector3d color = 0.15 + 0.85 * ((place - places.low).array() / places.size.array()).max(0).min(1);
    out[v] = shaded(color, (there - here).norm() / places.diagonal);
  }
  return out;
}

Color fitness_color(double fitness) {
  vcg::Color4b color;
  // From the top to 0: the ramp's first colour is red.
  color.SetColorRamp(static_cast<float>(kRedFitness), 0.0f, static_cast<float>(fitness));
  return {color[0], color[1], color[2]};
}

}  // namespace ga_symmetry
