// SPDX-License-Identifier: GPL-3.0-or-later
// How badly a map of the samples keeps what a symmetry keeps.
#pragma once
#include <limits>
#include <vector>

#include "ga_symmetry/options.h"
#include "ga_symmetry/result.h"
#include "geodesics/anchors.h"
#include "search/sample_map.h"
#include "search/sites.h"

namespace ga_symmetry {

/// Near here distances are compared absolutely, farther off relatively: an error e of a distance d costs
/// e^2 / (d^2 + kNear2). 0.14 units are about what lies between neighbouring samples, below which e is their spacing.
constexpr float kNear2 = 0.02f;

/// The terms of the cost of a map, each a mean over the samples.
struct CostTerms {
  double distance = 0;     ///< relative squared error of all mutual distances, each capped at 0.25
  double orientation = 0;  ///< 1 - how well the directions to near samples agree up to one angle, [0,1]
  double continuity = 0;   ///< relative squared error of the distances to near samples, each capped at 1
  double unary = 0;        ///< what a sample alone says of its partner, already weighted: references and descriptors
  double bijectivity = 0;  ///< squared distance at which the partner's partner is off, over 0.2 units squared, [0,1]
};

/// What a unit of each term costs, >= 0.
struct CostWeights {
  double distance = 0;
  double orientation = 0;
  double continuity = 0;
  double bijectivity = 0;
};
/// Without orientation where the surface has none, without bijectivity for rotations: the partner of the partner is
/// a third point there.
CostWeights make_cost_weights(const JointOptions& options, SymmetryKind kind, bool orientable);

/// samples x sites: the unary costs. References cost by how distances to them change, descriptors by how they differ.
/// @param unit  of the surface
Table make_unary_costs(const Sites& sites, double unit, const Anchors& anchors, const JointOptions& options);

/// Where the partners of a sample's known neighbours are: all that orientation and continuity at it depend on.
struct Vicinity {
  struct Image {
    int site;  // of the neighbour's partner
    float distance, inverse, cosine,
        sine;  // from the sample to the neighbour; direction times the weight 1 / distance^2
  };
  std::vector<Image> near;
  float inverse_weight = 0, inverse_count = 0;  // 1 / sums over `near`; 0 if that is empty
};

/// The cost of maps over fixed sites. Const after construction, so shared by threads.
class MapCost {
 public:
  /// @param sites  must outlive this
  /// @param unary  samples x sites
  MapCost(const Sites& sites, SymmetryKind kind, Table unary, const CostWeights& weights);
  /// The same cost over fewer sites. @param coarse  from `coarsened`; must outlive this
  MapCost(const MapCost& fine, const Sites& coarse);

  CostTerms terms(const SampleMap& map) const;
  double total(const CostTerms& t) const;
  double cost(const SampleMap& map) const { return total(terms(map)); }

  /// What the search minimises: the cost over the square of the share of samples that the map moves. Any shape is its
  /// own identity, at no cost, so a low cost is evidence of a symmetry only where points are moved.
  /// @return +inf for a map that moves less than a tenth
  double score(const SampleMap& map) const;

  const Sites& sites() const { return sites_; }
  SymmetryKind kind() const { return kind_; }
  const CostWeights& weights() const { return weights_; }
  const Table& unary() const { return unary_; }  ///< samples x sites
  const Table& distance_weight() const {
    return distance_weight_;
  }  ///< samples x samples: 1 / (d^2 + kNear2), but 0
     ///< from a sample to itself

  // The terms of one sample, if its partner is `site`.
  /// @param map  -1 where not known, but for bijectivity
  void look_around(const SampleMap& map, int sample, Vicinity& out) const;
  float orientation_error(const Vicinity& around, int site) const;
  float continuity_error(const Vicinity& around, int site) const;
  float bijectivity_error(const SampleMap& map, int sample, int site) const;

  struct Direction {
    float cosine, sine;
  };
  /// From one site towards another.
  const Direction& direction(int from, int to) const {
    return direction_[static_cast<std::size_t>(to) * sites_.count() + from];
  }

 private:
  void index_directions();

  const Sites& sites_;
  SymmetryKind kind_;
  CostWeights weights_;
  Table distance_weight_, unary_;
  std::vector<Direction> direction_;  // towards x from: all that is tried for a sample looks at the same few
};

/// Sum over n distances of their capped relative squared errors.
/// @param a, b  the distances @param weight  1 / (d^2 + kNear2)
/// @param slack_a, slack_b  how much they may be off: only what lies between them counts; null = exact
float distance_error(const float* a, const float* b, const float* slack_a, const float* slack_b, const float* weight,
                     int n);

/// What a map costs as far as one gene decides it, given all others; kept up to date as genes change: for any two sites
/// cost(k) - cost(l) is the difference of the whole map's cost with the one and with the other, times the number of
/// samples, up to rounding of single precision. One at a time per thread: the tables are that thread's.
class GeneCost {
 public:
  /// @param map  whole; changed by `set` alone as long as this lives
  GeneCost(const MapCost& cost, SampleMap& map);

  /// Chooses the gene that the following speak of.
  void look_at(int gene);
  int gene() const { return gene_; }
  int site() const { return map_[gene_]; }
  /// The cost at `site`.
  float cost(int site);
  /// The same, but guessing that the gene's neighbours say of it what it says of them: at a fraction of the work,
  /// enough to propose a site. Anything >= `limit` once it is known to be that.
  float guess(int site, float limit = std::numeric_limits<float>::infinity()) const;
  void set(int site);

 private:
  // A sample that has the gene's among its neighbours: what of its terms the gene decides.
  struct Observer {
    int site;              // of its partner
    Vicinity::Image gene;  // the gene's sample as it sees it; `site` is not used
    float re, im;          // directions of its other neighbours, summed
    float inverse_weight, inverse_count;
  };
  // A sample whose partner's nearest sample is the gene's: its way back leads over the gene.
  struct Return {
    int sample;
    float off;  // how far its partner is from the gene's sample
  };
  void look_at_observers();
  float distance_error_to(int site, int first, int count) const;
  float orientation_error(int site) const;
  float continuity_error(int site) const;
  float bijectivity_error(int site) const;

  const MapCost& cost_;
  const Sites& sites_;
  SampleMap& map_;
  std::vector<float>&image_, &slack_;  // sites x samples: distance from a site to the partner of a sample
  int gene_ = 0;
  Vicinity around_, around_observer_;
  bool observed_ = false;  // whether the following are the gene's
  std::vector<Observer> observers_;
  std::vector<Return> returns_;
  float distance_weight_, orientation_weight_, continuity_weight_, bijectivity_weight_;
};

}  // namespace ga_symmetry
