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

/// What a vertex is coloured by.
enum class ColorBy {
  fitness,   ///< blue at 0 over green to red at ramp_top
  symmetry,  ///< its place on the left side, its partner alike: both hands have one colour; dark on the axis. Of a
             ///< rotation, which has no sides, the mean place of a vertex and its partner
  sides,     ///< left blue, right orange, dark on the axis
};

/// Grey without a partner, but for fitness.
/// @param mesh  that is coloured @param partners  of the mesh, one entry a vertex @param by  what the colours show
/// @return  per vertex
/// @throws InvalidOption  if they are of another number of vertices
std::vector<Color> vertex_colors(const TriangleMesh& mesh, const Partners& partners, ColorBy by);

/// Fitness at the red end of the colour ramp, whose blue end is 0: the 95th percentile over the vertices with a
/// partner, so that a few bad vertices do not turn all others blue. 0 if there are none.
double ramp_top(const std::vector<int>& partner, const std::vector<double>& fitness);

}  // namespace ga_symmetry
