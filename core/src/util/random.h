// SPDX-License-Identifier: GPL-3.0-or-later
// The one random engine, and draws that are the same on every platform.
#pragma once
#include <cstdint>
#include <random>

namespace ga_symmetry {

/// std::mt19937_64 is specified bit by bit; std::uniform_*_distribution is not, hence the draws below.
using Random = std::mt19937_64;

/// Uniform integer in [0, bound), bound >= 1, by rejection: no modulo bias.
inline std::uint64_t draw_below(Random& random, std::uint64_t bound) {
  const std::uint64_t limit = Random::max() - Random::max() % bound;
  std::uint64_t x;
  do x = random();
  while (x >= limit);
  return x % bound;
}

/// Uniform real in [0, 1) with 53 random bits.
inline double draw_unit(Random& random) { return static_cast<double>(random() >> 11) * 0x1.0p-53; }

}  // namespace ga_symmetry
