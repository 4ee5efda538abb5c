// SPDX-License-Identifier: GPL-3.0-or-later
// What can be chosen of a search. By name, with help: option_table.h.
#pragma once
#include <cstdint>

#include "ga_symmetry/references.h"
#include "ga_symmetry/result.h"

namespace ga_symmetry {

/// How the partners are searched for.
enum class Method {
  joint,  ///< a genetic search over whole maps
  pairs,  ///< pair by pair, as in the paper
};
/// How far two distances from the same axis point are apart: dL on one side, dR on the other.
enum class PairError {
  squared,  ///< ((dL - dR) / dR)^2
  linear,   ///< |dL - dR| / dR
};
/// How the samples of the pair-wise search lie.
enum class Sampling {
  evenly_spaced,  ///< farthest points
  uniform,        ///< drawn at random
};

/// The paper's pair-wise genetic algorithm; defaults as in the paper.
struct PairsOptions {
  PairError error = PairError::squared;         ///< of the distances from both axis points, summed
  int samples = 1000;                           ///< on both sides together, [20, 20000]
  Sampling sampling = Sampling::evenly_spaced;  ///< of the samples
  int individuals = 4;                          ///< pairs per reference vertex, [1, 100]
  int regions = 5;                              ///< distance regions per axis point, [2, 100]
  double outlier_z = 1.96;                      ///< mutate where the Z-error is above, [0, inf]
  double mutation_barrier_z = -1.96;            ///< keep where the Z-error is below, [-inf, 0]
  double mutation_probability = 0.01;           ///< per pair and generation, [0, 1]
  int max_generations = 300;                    ///< [1, 100000]
};

/// The joint search: one individual is a partner for every sample. Lengths are relative to sqrt(area).
struct JointOptions {
  int samples = 100;                   ///< evenly spaced, [20, 1000]
  int sites = 300;                     ///< candidates for partners, evenly spaced, not fewer than samples, [20, 5000]
  int population = 80;                 ///< [4, 10000]
  int max_generations = 40;            ///< [0, 10000]
  double mutation_probability = 0.01;  ///< per gene and generation, [0, 1]
  double turn_probability = 0.3;       ///< of a child to have a region turned, [0, 1]
  double ruin_probability = 0.4;       ///< of any other child to lose a region and have it made anew, [0, 1]
  double outlier_z = 1.96;             ///< a gene whose cost has a Z-score above looks at all sites, [0, inf]
  double distance_weight = 3;          ///< of this term of the cost, as those below, [0, 1e6]
  double orientation_weight = 1;       ///< of directions to near samples that do not agree up to one angle, [0, 1e6]
  double continuity_weight = 0.3;      ///< of distances to near samples that change, [0, 1e6]
  double descriptor_weight = 1;        ///< 0.3 times that where references are given, [0, 1e6]
  double bijectivity_weight = 0.1;     ///< of how far the partner's partner is off, [0, 1e6]
  double reference_weight = 1;         ///< [0, 1e6]; without references it does nothing
};

/// What can be chosen of find_symmetry.
struct Options {
  Method method = Method::joint;              ///< how partners are searched for
  SymmetryKind symmetry = SymmetryKind::any;  ///< what is searched for; with references `any` is a reflection
  References references;                      ///< what is known; empty = automatic
  std::uint64_t seed = 1;                     ///< same seed + mesh + build => same bytes, whatever `threads`
  int threads = 0;                            ///< 0 = all cores, [0, 256]; speed only, never results
  int proxy = 3000;  ///< a mesh of more than 1.3 times as many vertices is searched on a simplified one of so many, and
                     ///< the result carried back; [1000, 1000000], 0 = never; method joint only
  int rank = 1;      ///< 1 = the best of the symmetries found, 2 = the next best, ..., [1, 30]; method joint only
  bool local_refinement = true;  ///< move all partners of the samples together to where distances agree best, then all
                                 ///< partners to where the shape around them fits; joint only
  bool noise_filter = true;      ///< smooth what the distances to a vertex's partner are off; joint only
  bool spectral_refinement = true;  ///< move partners to where smooth functions on the surface agree; joint only
  double max_fitness = 0;  ///< a vertex whose fitness is above has no partner: outliers, and parts that the other
                           ///< side lacks; 0 = keep all, [0, 1e6]
  bool largest_component = false;  ///< leave all other parts out; the largest by area and vertices
  PairsOptions pairs;              ///< of the method pairs
  JointOptions joint;              ///< of the method joint
};

/// What find_symmetry checks before it looks at the mesh.
/// @throws InvalidOption  for an option that is out of its range, or contradicts another: the method pairs with
///                        rotations, or without two axis references and a pair
void check_options(const Options& options);

}  // namespace ga_symmetry
