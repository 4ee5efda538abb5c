// The joint search: one individual is a partner for every sample at once.
#pragma once
#include <array>
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/result.h"
#include "ga_symmetry/symmetry.h"
#include "geodesics/anchors.h"
#include "search/genetic.h"
#include "search/sites.h"
#include "util/random.h"

namespace ga_symmetry {

/// Gene i is the site that is the partner of sample i.
using SampleMap = std::vector<int>;

/// The terms of the joint cost, each a mean in [0,1].
struct CostTerms {
  double distance = 0;     ///< relative squared error of all mutual distances, capped
  double orientation = 0;  ///< 1 - how well the directions to near samples agree up to one angle
  double continuity = 0;   ///< relative squared error of the distances to near samples, capped at 1
  double unary = 0;        ///< references and descriptors, already weighted
  double bijectivity = 0;  ///< how far the partner's partner is off (reflections)
};

/// The joint cost over fixed sites, and the moves that lower it. Const after construction, so shared by threads.
class JointProblem {
 public:
  JointProblem(const Sites& sites, const Surface& surface, SymmetryKind kind, const Anchors& anchors,
               const JointOptions& options);

  /// The same problem over fewer sites. @param coarse  from `coarsened`
  JointProblem(const JointProblem& fine, const Sites& coarse);

  CostTerms terms(const SampleMap& map) const;
  double cost(const SampleMap& map) const { return total(terms(map)); }
  double total(const CostTerms& t) const;

  /// Cost for how far the map moves the samples: the identity costs nothing and is no symmetry.
  double score(const SampleMap& map) const;

  /// Every gene in turn takes the site that is best given all others.
  /// @param radius  look among the sites within this distance of the present partner, [0, 0.25] units; +inf = among all
  ///        samples' own sites
  /// @param sweeps  over all genes, at most, >= 1; from the second on only where a gene or one near it has changed
  /// @return genes changed
  int best_response(SampleMap& map, float radius, int sweeps = 1) const;

  /// The genes that fit far worse than the others (the paper's outliers) take the best of all sites.
  /// @return genes changed
  int relocate_outliers(SampleMap& map) const;

  /// The paper's crossover, as a mutation: sites sorted by distance from the reference's image make five regions; the
  /// gene's new site, at random, lies one region nearer to that of the sample's own distance from the reference.
  /// @param reference  sample; its gene and gene i are known
  int region_step(const SampleMap& map, int i, int reference, Random& random) const;

  /// Genes that are -1 take, from the rim of their region inwards, the site that is best given the genes known so far
  /// ("ruin and recreate", Schrimpf et al. 2000). Leaves a map without a known gene as it is.
  void recreate(SampleMap& map) const;

  /// The whole map that follows from taking sample p to site q, turned by `angle`: every other sample goes to the site
  /// that is as far from q, in the mirrored (or, for a rotation, same) direction.
  SampleMap polar_map(int p, int q, double angle) const;

  /// Mean distance between two maps' partners, in units.
  double difference(const SampleMap& a, const SampleMap& b) const;
  /// Share of the samples that a map moves, [0,1): those near their partners count in part.
  double moved(const SampleMap& map) const;

  // What evolve() asks for.
  double evaluate(SampleMap& map, int worker) const;
  double best(const Population<SampleMap>& population) const;
  Population<SampleMap> vary(const Population<SampleMap>& population, const std::vector<double>& z_errors,
                             Random& random) const;
  Population<SampleMap> replace(Population<SampleMap> parents, Population<SampleMap> children) const;

  const Sites& sites() const { return sites_; }
  /// Pairs (sample, site) that a symmetry may take to each other, for polar_map.
  std::vector<std::array<int, 2>> seeds() const;

 private:
  class Response;
  void index_sites();
  struct Direction {
    float cosine, sine;
  };
  // What orientation and continuity at a sample depend on: where its neighbours' partners are.
  struct Vicinity {
    struct Image {
      int site;
      float distance, inverse, cosine, sine;  // from the sample to the neighbour; direction weighted
    };
    std::vector<Image> near;
    float inverse_weight = 0, inverse_count = 0;
  };
  struct KnownGene {
    int sample, site;
  };
  void look_around(const SampleMap& map, int sample, Vicinity& out) const;
  int best_response(Response& response, float radius) const;
  int relocate_outliers(Response& response) const;
  float orientation_error(const Vicinity& around, int site) const;
  float continuity_error(const Vicinity& around, int site) const;
  float bijectivity_error(const SampleMap& map, int sample, int site) const;

  const Sites& sites_;
  JointOptions options_;  // a copy: callers may pass a temporary
  SymmetryKind kind_;
  bool oriented_;
  std::vector<KnownGene> known_;              // the samples and sites nearest to the anchors
  Table weight_;                              // samples x samples: 1 / (d^2 + eps)
  Table unary_;                               // samples x sites
  std::vector<Direction> direction_;          // sites x sites: both in one cache line
  std::vector<std::vector<int>> near_sites_;  // per site, nearest first
};

struct JointResult {
  std::vector<SampleMap> maps;  ///< distinct survivors, lowest cost first
  std::vector<double> costs;
  std::vector<GenerationLog> log;
  StopReason stop = StopReason::max_generations;
};

/// Seeds coherent maps, evolves them, and returns the distinct survivors.
/// @throws Cancelled
JointResult search_joint(const JointProblem& problem, const JointOptions& options, Random& random, int threads,
                         const Context& context = {});

}  // namespace ga_symmetry
