// SPDX-License-Identifier: GPL-3.0-or-later
// Colours that show what was found.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "ga_symmetry/mesh.h"
#include "ga_symmetry/partners.h"

namespace ga_symmetry {

/// Red, green, blue.
using Color = std::array<std::uint8_t, 3>;

/// Fitness from which a vertex is red, of every mesh the same: a good one is blue, a poor one red. What has lost
/// its partner, such as the other hand, mostly has 0.1 and more; on whole shapes nine of ten vertices have less.
inline constexpr double kRedFitness = 0.2;

/// What a vertex is coloured by.
enum class ColorBy {
  fitness,   ///< blue at 0, green at half of kRedFitness, red from kRedFitness
  symmetry,  ///< its place on the left side, its partner alike: both hands have one colour; dark on the axis. Of a
             ///< rotation, which has no sides, the mean place of a vertex and its partner
  sides,     ///< left blue, right orange, dark on the axis
};

/// Grey without a partner, but for fitness.
/// @param mesh  that is coloured @param partners  of the mesh, one entry a vertex @param by  what the colours show
/// @return  per vertex
/// @throws InvalidOption  if they are of another number of vertices
std::vector<Color> vertex_colors(const TriangleMesh& mesh, const Partners& partners, ColorBy by);

/// The colour of a fitness, blue at 0 to red from kRedFitness. @param fitness  [0, inf]
Color fitness_color(double fitness);

}  // namespace ga_symmetry
