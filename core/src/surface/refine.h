// SPDX-License-Identifier: GPL-3.0-or-later
// Smaller faces on the same surface.
#pragma once
#include <vector>

namespace ga_symmetry {

/// Splits edges in the middle until none is longer than `length`; the vertices that there are stay, with their numbers.
/// @param position  x,y,z per vertex; new vertices are added
/// @param triangle  replaced
void split_long_edges(std::vector<double>& position, std::vector<int>& triangle, double length);

}  // namespace ga_symmetry
