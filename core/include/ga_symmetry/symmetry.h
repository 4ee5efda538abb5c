// The front door: options in, result out.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/errors.h"
#include "ga_symmetry/result.h"
#include "ga_symmetry/triangle_mesh.h"

namespace ga_symmetry {

enum class Method { joint, pairs };
enum class PairError { squared, linear };
enum class Sampling { evenly_spaced, uniform };

/// Reference vertices that the user knows; all indices are vertices of the mesh. Empty = automatic.
struct References {
  std::vector<int> axis;                  ///< on the symmetry axis: the symmetry does not move them
  std::vector<std::array<int, 2>> pairs;  ///< {l, r}: the symmetry takes l to r
  bool empty() const { return axis.empty() && pairs.empty(); }
};

/// Reads `a0,a1,l,r` (two axis points, then a pair; further numbers are further pairs). One colon makes a pair
/// explicit: `12:57` is a pair, `3,8` two axis points, `3,8,12:57,90:4` two axis points and two pairs. "" = none.
/// @throws InvalidOption  if the text is not of that form
References parse_references(const std::string& text);

/// Works out which two of four selected vertices lie on the axis and which two are the pair: the pair (c,d) has
/// d(a,c) = d(a,d) and d(b,c) = d(b,d), by geodesic distance. Order of the input does not matter.
/// @throws InvalidOption  if two readings are equally good, or a vertex is out of range or repeated
/// @throws InvalidMesh    as find_symmetry
References references_from_selection(const TriangleMesh& mesh, const std::array<int, 4>& selected);

/// The paper's pair-wise genetic algorithm; defaults as in the paper.
struct PairsOptions {
  PairError error = PairError::squared;
  int samples = 1000;  ///< on both sides together, [20, 20000]
  Sampling sampling = Sampling::evenly_spaced;
  int individuals = 4;                 ///< pairs per reference vertex, [1, 100]
  int regions = 5;                     ///< distance regions per axis point, [2, 100]
  double outlier_z = 1.96;             ///< mutate where the Z-error is above
  double mutation_barrier_z = -1.96;   ///< keep where the Z-error is below
  double mutation_probability = 0.01;  ///< per pair and generation, [0,1]
  int max_generations = 300;           ///< [1, 100000]
};

/// The joint search: one individual is a partner for every sample. Lengths are relative to sqrt(area).
struct JointOptions {
  int samples = 100;                   ///< evenly spaced, [20, 1000]
  int sites = 300;                     ///< candidates for partners, evenly spaced, [samples, 5000]
  int population = 80;                 ///< [4, 10000]
  int max_generations = 60;            ///< [0, 10000]
  double mutation_probability = 0.01;  ///< per gene and generation, [0,1]
  double ruin_probability = 0.4;       ///< of a child to lose a region and have it made anew, [0,1]
  double outlier_z = 1.96;             ///< a gene whose cost has a Z-score above looks at all sites, >= 0
  double distance_weight = 3;          ///< of the terms of the cost, each >= 0
  double orientation_weight = 1;
  double continuity_weight = 0.3;
  double descriptor_weight = 1;  ///< 0.3 times that where references are given
  double bijectivity_weight = 0.1;
  double reference_weight = 1;
};

struct Options {
  Method method = Method::joint;
  SymmetryKind symmetry = SymmetryKind::reflection;
  References references;
  std::uint64_t seed = 1;  ///< same seed + mesh + build => same bytes, whatever `threads`
  int threads = 0;         ///< 0 = all cores, [0, 256]; speed only, never results
  int proxy = 3000;  ///< a mesh of more than 1.3 times as many vertices is searched on a simplified one of so many, and
                     ///< the result carried back; [1000, 1000000], 0 = never; method joint only
  int rank = 1;      ///< 1 = the best of the symmetries found, 2 = the next best, ..., [1, 30]; method joint only
  bool local_refinement =
      true;                  ///< move all partners of the samples together to where distances agree best; joint only
  bool noise_filter = true;  ///< smooth what the distances to a vertex's partner are off; joint only
  double max_fitness = 0;    ///< a vertex whose fitness is above has no partner: outliers, and parts that the other
                             ///< side lacks; 0 = keep all, [0, 1e6]
  bool largest_component = false;  ///< work on the largest component instead of refusing a mesh of several
  PairsOptions pairs;
  JointOptions joint;
};

/// Finds for every vertex its partner under an intrinsic symmetry.
/// @throws InvalidMesh    if the mesh is empty, a point cloud, too small, non-manifold, has zero-area faces, several
///                        components or coordinates that are not finite
/// @throws InvalidOption  if an option is out of its range; `pairs` without two axis references and a pair; a rank
///                        beyond the symmetries found
/// @throws Cancelled      if the context asked to stop
Result find_symmetry(const TriangleMesh& mesh, const Options& options = {}, const Context& context = {});

/// The distinct symmetries of both kinds that the joint search finds, best first; those whose score is more than twice
/// the best one's are left out. `symmetry` and `rank` of the options do not matter; the n-th of its kind here is that
/// of rank n there.
/// @throws as find_symmetry
std::vector<FoundSymmetry> list_symmetries(const TriangleMesh& mesh, Options options = {}, const Context& context = {});

}  // namespace ga_symmetry
