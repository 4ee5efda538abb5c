#include "search/joint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "ga_symmetry/errors.h"
#include "util/parallel.h"

namespace ga_symmetry {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
// Lengths are in units of sqrt(area). Below kNear distances are compared absolutely, above it relatively.
constexpr float kNear2 = 0.02f;
constexpr float kCap = 0.25f;      // of one distance's relative squared error: outliers count, but no more
constexpr float kReturn2 = 0.04f;  // squared distance at which a partner's partner is plainly not oneself
constexpr int kAngles = 24;        // directions tried per seed
// Seeds are improved over few samples first, which costs a fraction.
constexpr int kCoarseSamples = 60;
constexpr std::size_t kSeedPairs = 120;  // at least; pairs of tips may be more
constexpr int kSeedsPerPair = 6;         // distinct maps kept per seed pair
constexpr int kTried = 160;              // that many of the best distinct maps of all pairs are improved
constexpr int kRegions = 5;              // of distance, as in the paper
constexpr int kSweeps = 6;               // of best responses, at most
constexpr float kLocal = 0.25f;          // radius in which a child's genes look for better sites
constexpr double kDistinctTurns = 0.1;   // maps closer than this are one, before they are improved
constexpr double kDistinctSeeds = 0.08;  // and once they are
constexpr double kSame = 0.02;           // maps closer than this are one
constexpr double kDistinct = 0.1;        // maps farther apart than this are different symmetries
constexpr double kMoved2 = 0.02;         // squared distance at which a partner is plainly not oneself
constexpr double kTrivial = 0.1;         // a map that moves a smaller share is the identity
constexpr int kSurvivors = 30;
constexpr float kDescriptorsBesideReferences = 0.3f;

constexpr float kEverywhere = kInfinity;  // best_response among all samples

float squared(float x) { return x * x; }

// Sum of the weighted squared differences, each capped.
float capped_error(const float* a, const float* b, const float* weight, int n) {
  using Row = Eigen::Map<const Eigen::ArrayXf>;
  return ((Row(a, n) - Row(b, n)).square() * Row(weight, n)).min(kCap).sum();
}

// The same of values that are not known better than within their slack: only what lies between them counts.
float capped_gap(const float* a, const float* b, const float* slack_a, const float* slack_b, const float* weight,
                 int n) {
  using Row = Eigen::Map<const Eigen::ArrayXf>;
  const auto gap = ((Row(a, n) - Row(b, n)).abs() - Row(slack_a, n) - Row(slack_b, n)).max(0.f);
  return (gap.square() * Row(weight, n)).min(kCap).sum();
}

}  // namespace

JointProblem::JointProblem(const Sites& sites, const Surface& surface, SymmetryKind kind, const Anchors& anchors,
                           const JointOptions& options)
    : sites_(sites), options_(options), kind_(kind), oriented_(surface.orientable) {
  const int samples = sites.samples, count = sites.count();
  weight_ = (sites.distance.topLeftCorner(samples, samples).array().square() + kNear2).inverse();
  unary_ = Table::Zero(samples, count);
  // References say which end is which; then descriptors, which like the identity best, need say less.
  const float descriptor_weight =
      static_cast<float>(options.descriptor_weight) * (anchors.count() == 0 ? 1 : kDescriptorsBesideReferences);
  for (int i = 0; i < samples; ++i)
    for (int k = 0; k < count; ++k)
      unary_(i, k) =
          descriptor_weight * (sites.descriptor.row(i) - sites.descriptor.row(k)).array().square().min(1.f).mean();
  const float unit = static_cast<float>(surface.unit());
  const float share = static_cast<float>(options.reference_weight) / static_cast<float>(std::max(1, anchors.count()));
  for (int t = 0; t < anchors.count(); ++t) {
    const auto from = [&](int i) { return anchors.from.field(t, sites.vertex[i]); };
    const auto image = [&](int k) { return anchors.image.field(t, sites.vertex[k]); };
    KnownGene known{0, 0};
    for (int i = 0; i < samples; ++i) {
      const float d = from(i) / unit;
      for (int k = 0; k < count; ++k) {
        const float e = image(k) / unit - d;
        unary_(i, k) += share * std::min(1.f, e * e / (d * d + kNear2));
      }
      if (from(i) < from(known.sample)) known.sample = i;
    }
    for (int k = 1; k < count; ++k)
      if (image(k) < image(known.site)) known.site = k;
    known_.push_back(known);
  }
  index_sites();
}

JointProblem::JointProblem(const JointProblem& fine, const Sites& sites)
    : sites_(sites), options_(fine.options_), kind_(fine.kind_), oriented_(fine.oriented_) {
  weight_ = fine.weight_.topLeftCorner(sites.samples, sites.samples);
  unary_ = fine.unary_.topLeftCorner(sites.samples, sites.count());
  index_sites();
}

void JointProblem::index_sites() {
  const Sites& sites = sites_;
  const int count = sites.count();
  direction_.resize(static_cast<std::size_t>(count) * count);
  for (int k = 0; k < count; ++k)
    for (int j = 0; j < count; ++j)
      direction_[static_cast<std::size_t>(k) * count + j] = {sites.cosine(k, j), sites.sine(k, j)};
  near_sites_.resize(count);
  for (int k = 0; k < count; ++k) {
    std::vector<int>& near = near_sites_[k];
    for (int j = 0; j < count; ++j)
      if (sites.distance(k, j) <= kLocal) near.push_back(j);
    std::sort(near.begin(), near.end(), [&](int a, int b) {
      return sites.distance(k, a) != sites.distance(k, b) ? sites.distance(k, a) < sites.distance(k, b) : a < b;
    });
  }
}

void JointProblem::look_around(const SampleMap& map, int i, Vicinity& out) const {
  const float sign = kind_ == SymmetryKind::reflection ? 1.f : -1.f;
  out.near.clear();
  float total = 0;
  for (int j : sites_.neighbors[i]) {
    if (map[j] < 0) continue;
    const float d = sites_.distance(i, j), weight = 1 / squared(d);
    total += weight;
    out.near.push_back({map[j], d, 1 / d, weight * sites_.cosine(i, j), sign * weight * sites_.sine(i, j)});
  }
  out.inverse_weight = total > 0 ? 1 / total : 0;
  out.inverse_count = out.near.empty() ? 0 : 1 / static_cast<float>(out.near.size());
}

float JointProblem::orientation_error(const Vicinity& around, int k) const {
  // With directions as complex numbers, a reflection makes image * original, a rotation image / original, the same for
  // all neighbours; the length of their mean says how well that holds.
  const Direction* row = &direction_[static_cast<std::size_t>(k) * sites_.count()];
  float re = 0, im = 0;
  for (const Vicinity::Image& n : around.near) {
    const Direction image = row[n.site];
    re += image.cosine * n.cosine - image.sine * n.sine;
    im += image.cosine * n.sine + image.sine * n.cosine;
  }
  return around.near.empty() ? 0 : 1 - std::sqrt(re * re + im * im) * around.inverse_weight;
}

float JointProblem::continuity_error(const Vicinity& around, int k) const {
  const float* row = sites_.distance.row(k).data();
  float sum = 0;
  for (const Vicinity::Image& n : around.near) sum += std::min(1.f, squared((row[n.site] - n.distance) * n.inverse));
  return sum * around.inverse_count;
}

float JointProblem::bijectivity_error(const SampleMap& map, int i, int k) const {
  if (kind_ != SymmetryKind::reflection) return 0;
  const int back = sites_.nearest_sample[k];
  // The sample stands a little off the site; so may its partner.
  const float off = std::max(0.f, sites_.distance(map[back], i) - sites_.distance(back, k));
  return std::min(1.f, off * off / kReturn2);
}

CostTerms JointProblem::terms(const SampleMap& map) const {
  const int n = sites_.samples;
  double distance = 0, orientation = 0, continuity = 0, unary = 0, bijectivity = 0;
  Vicinity around;
  for (int i = 0; i < n; ++i) {
    const float* row = sites_.distance.row(i).data();
    const float* image = sites_.distance.row(map[i]).data();
    const float* weight = weight_.row(i).data();
    float sum = 0;
    for (int j = 0; j < n; ++j) {
      const float slack = sites_.slack.size() > 0 ? sites_.slack(i, j) + sites_.slack(map[i], map[j]) : 0;
      sum += std::min(kCap, squared(std::max(0.f, std::abs(row[j] - image[map[j]]) - slack)) * weight[j]);
    }
    distance += sum;
    look_around(map, i, around);
    if (oriented_) orientation += orientation_error(around, map[i]);
    continuity += continuity_error(around, map[i]);
    unary += unary_(i, map[i]);
    bijectivity += bijectivity_error(map, i, map[i]);
  }
  return {distance / n / n, orientation / n, continuity / n, unary / n, bijectivity / n};
}

double JointProblem::total(const CostTerms& t) const {
  return options_.distance_weight * t.distance + options_.orientation_weight * t.orientation +
         options_.continuity_weight * t.continuity + t.unary + options_.bijectivity_weight * t.bijectivity;
}

// What one gene costs, given all others; kept up to date as genes change.
class JointProblem::Response {
 public:
  Response(const JointProblem& problem, SampleMap& map)
      : p_(problem),
        sites_(problem.sites_),
        map_(map),
        image_(tables()[0]),
        slack_(tables()[1]),
        open_(map.size(), true) {
    const int n = sites_.samples, count = sites_.count();
    // Distance from site k to the partner of sample j, contiguous in j for the inner loop.
    const auto gather = [&](const Table& table, std::vector<float>& to) {
      to.resize(table.size() > 0 ? static_cast<std::size_t>(n) * count : 0);
      float* out = to.data();
      for (Eigen::Index k = 0; k < table.rows(); ++k)
        for (int j = 0; j < n; ++j) *out++ = table(k, map[j]);
    };
    gather(sites_.distance, image_);
    gather(sites_.slack, slack_);
    const JointOptions& o = problem.options_;  // a pair of samples counts twice in the cost: once for each
    distance_weight_ = static_cast<float>(2 * o.distance_weight) / static_cast<float>(n);
    orientation_weight_ = static_cast<float>(problem.oriented_ ? 2 * o.orientation_weight : 0);
    continuity_weight_ = static_cast<float>(2 * o.continuity_weight);
    bijectivity_weight_ = static_cast<float>(2 * o.bijectivity_weight);
  }

  const SampleMap& map() const { return map_; }
  /// Whether a gene or one near it has changed since it was closed ("don't look bits", Bentley 1992).
  bool is_open(int i) const { return open_[i]; }
  void close() { open_[i_] = false; }

  void look_at(int i) {
    i_ = i;
    p_.look_around(map_, i, around_);
  }
  /// Cost of the gene that is looked at, at site k; anything >= `limit` once it is known to be that.
  float cost(int k, float limit) const {
    const int n = sites_.samples, half = n / 2;
    // Samples come from coarse to fine, so that the first half tells most of the wrong sites.
    float total = p_.unary_(i_, k) + distance_weight_ * distance_error(k, 0, half);
    if (total >= limit) return total;
    total += distance_weight_ * distance_error(k, half, n - half);
    if (total >= limit) return total;
    if (orientation_weight_ > 0) total += orientation_weight_ * p_.orientation_error(around_, k);
    if (total >= limit) return total;
    return total + continuity_weight_ * p_.continuity_error(around_, k) +
           bijectivity_weight_ * p_.bijectivity_error(map_, i_, k);
  }

  /// Gives it the site k.
  void set(int k) {
    map_[i_] = k;
    open_[i_] = true;
    for (int j : sites_.neighbors[i_]) open_[j] = true;
    for (std::size_t j = 0, at = i_; at < image_.size(); ++j, at += sites_.samples) image_[at] = sites_.distance(j, k);
    for (std::size_t j = 0, at = i_; at < slack_.size(); ++j, at += sites_.samples) slack_[at] = sites_.slack(j, k);
  }

 private:
  static std::array<std::vector<float>, 2>& tables() {
    thread_local std::array<std::vector<float>, 2> tables;  // per thread: no allocation per individual
    return tables;
  }
  // Of the gene that is looked at, to `count` samples.
  float distance_error(int k, int first, int count) const {
    const std::size_t at = static_cast<std::size_t>(k) * sites_.samples + first;
    const float *from = &sites_.distance(i_, first), *weight = &p_.weight_(i_, first);
    if (slack_.empty()) return capped_error(from, &image_[at], weight, count);
    return capped_gap(from, &image_[at], &sites_.slack(i_, first), &slack_[at], weight, count);
  }

  const JointProblem& p_;
  const Sites& sites_;
  SampleMap& map_;
  std::vector<float>&image_, &slack_;
  int i_ = 0;
  Vicinity around_;
  std::vector<char> open_;
  float distance_weight_, orientation_weight_, continuity_weight_, bijectivity_weight_;
};

int JointProblem::best_response(SampleMap& map, float radius, int sweeps) const {
  Response response(*this, map);
  int changed = 0;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const int now = best_response(response, radius);
    changed += now;
    if (!now) break;
  }
  return changed;
}

int JointProblem::best_response(Response& response, float radius) const {
  int changed = 0;
  for (int i = 0; i < sites_.samples; ++i) {
    if (!response.is_open(i)) continue;
    response.look_at(i);
    const int present = response.map()[i];
    int best = present;
    float least = response.cost(best, kInfinity);
    const auto consider = [&](int k) {
      const float cost = response.cost(k, least);
      if (cost < least) least = cost, best = k;
    };
    if (radius == kEverywhere) {
      for (int k = 0; k < sites_.samples; ++k) consider(k);
    } else {
      for (int k : near_sites_[present]) {
        if (sites_.distance(present, k) > radius) break;
        consider(k);
      }
    }
    response.close();
    if (best != present) response.set(best), ++changed;
  }
  return changed;
}

int JointProblem::relocate_outliers(SampleMap& map) const {
  Response response(*this, map);
  return relocate_outliers(response);
}

int JointProblem::relocate_outliers(Response& response) const {
  std::vector<double> costs(sites_.samples);
  for (int i = 0; i < sites_.samples; ++i) {
    response.look_at(i);
    costs[i] = response.cost(response.map()[i], kInfinity);
  }
  const std::vector<double> z = z_scores(costs);
  int changed = 0;
  for (int i = 0; i < sites_.samples; ++i) {
    if (z[i] <= options_.outlier_z) continue;
    response.look_at(i);
    const int present = response.map()[i];
    int best = present;
    float least = response.cost(best, kInfinity);
    for (int k = 0; k < sites_.count(); ++k) {
      const float cost = response.cost(k, least);
      if (cost < least) least = cost, best = k;
    }
    if (best != present) response.set(best), ++changed;
  }
  return changed;
}

void JointProblem::recreate(SampleMap& map) const {
  const int n = sites_.samples, count = sites_.count();
  std::vector<int> kept, lost;
  for (int i = 0; i < n; ++i) (map[i] < 0 ? lost : kept).push_back(i);
  if (lost.empty() || kept.empty()) return;
  // From the rim inwards, so that each finds neighbours.
  std::vector<float> inside(n, kInfinity);
  for (int i : lost)
    for (int j : kept) inside[i] = std::min(inside[i], sites_.distance(i, j));
  std::stable_sort(lost.begin(), lost.end(), [&](int a, int b) { return inside[a] < inside[b]; });
  const bool slack = sites_.slack.size() > 0;
  std::vector<float> row, row_slack, to, to_slack, weight;
  Vicinity around;
  for (int i : lost) {
    const int m = static_cast<int>(kept.size());
    row.resize(m), to.resize(m), weight.resize(m);
    for (int j = 0; j < m; ++j) row[j] = sites_.distance(i, kept[j]), weight[j] = weight_(i, kept[j]);
    if (slack) {
      row_slack.resize(m), to_slack.resize(m);
      for (int j = 0; j < m; ++j) row_slack[j] = sites_.slack(i, kept[j]);
    }
    look_around(map, i, around);
    float least = kInfinity;
    int best = i;
    for (int k = 0; k < count; ++k) {
      const float* image = sites_.distance.row(k).data();
      for (int j = 0; j < m; ++j) to[j] = image[map[kept[j]]];
      for (int j = 0; slack && j < m; ++j) to_slack[j] = sites_.slack(k, map[kept[j]]);
      const float error = slack ? capped_gap(row.data(), to.data(), row_slack.data(), to_slack.data(), weight.data(), m)
                                : capped_error(row.data(), to.data(), weight.data(), m);
      float total = static_cast<float>(2 * options_.distance_weight) * error / static_cast<float>(m) + unary_(i, k);
      if (total >= least) continue;
      if (oriented_) total += static_cast<float>(2 * options_.orientation_weight) * orientation_error(around, k);
      if (total >= least) continue;
      total += static_cast<float>(2 * options_.continuity_weight) * continuity_error(around, k);
      if (total < least) least = total, best = k;
    }
    map[i] = best;
    kept.push_back(i);
  }
}

SampleMap JointProblem::polar_map(int p, int q, double angle) const {
  const int n = sites_.samples;
  const float sign = kind_ == SymmetryKind::reflection ? -1.f : 1.f;
  const float turn_re = static_cast<float>(std::cos(angle)), turn_im = static_cast<float>(std::sin(angle));
  SampleMap map(n);
  for (int j = 0; j < n; ++j) {
    if (j == p) {
      map[j] = q;
      continue;
    }
    const float d = sites_.distance(p, j), x = sites_.cosine(p, j), y = sign * sites_.sine(p, j);
    const float re = turn_re * x - turn_im * y, im = turn_re * y + turn_im * x, scale = 1 / (d * d + kNear2);
    const auto agreement = re * sites_.cosine.row(q).head(n).array() + im * sites_.sine.row(q).head(n).array();
    ((d - sites_.distance.row(q).head(n).array()).square() * scale + 0.25f * (1 - agreement) +
     unary_.row(j).head(n).array())
        .minCoeff(&map[j]);  // coarse: among the samples
  }
  return map;
}

double JointProblem::difference(const SampleMap& a, const SampleMap& b) const {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::min(1.f, sites_.distance(a[i], b[i]));
  return sum / static_cast<double>(a.size());
}

double JointProblem::moved(const SampleMap& map) const {
  double sum = 0;
  for (std::size_t i = 0; i < map.size(); ++i) {
    const double d2 = squared(sites_.distance(static_cast<int>(i), map[i]));
    sum += d2 / (d2 + kMoved2);
  }
  return sum / static_cast<double>(map.size());
}

double JointProblem::evaluate(SampleMap& map, int) const {
  recreate(map);
  Response response(*this, map);
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    if (!best_response(response, kLocal) && !relocate_outliers(response)) break;
  return score(map);
}

double JointProblem::score(const SampleMap& map) const {
  const double share = moved(map);
  return share < kTrivial ? kInfinity : cost(map) / (share * share);
}

double JointProblem::best(const Population<SampleMap>& population) const {
  double least = kInfinity;
  for (const auto& individual : population) least = std::min(least, individual.cost);
  return least;
}

int JointProblem::region_step(const SampleMap& map, int i, int reference, Random& random) const {
  const int count = sites_.count(), image = map[reference];
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  const auto nearer = [&](int a, int b) { return sites_.distance(image, a) < sites_.distance(image, b); };
  std::stable_sort(order.begin(), order.end(), nearer);
  const auto region = [&](std::ptrdiff_t rank) {
    return static_cast<int>(std::min<std::ptrdiff_t>(rank, count - 1) * kRegions / count);
  };
  const int present = region(std::find(order.begin(), order.end(), map[i]) - order.begin());
  const auto wanted_rank =
      std::partition_point(order.begin(), order.end(),
                           [&](int k) { return sites_.distance(image, k) < sites_.distance(reference, i); }) -
      order.begin();
  const int wanted = region(wanted_rank), next = present + (wanted > present) - (wanted < present);
  const int first = (next * count + kRegions - 1) / kRegions, last = ((next + 1) * count + kRegions - 1) / kRegions;
  return order[first + static_cast<int>(draw_below(random, last - first))];
}

Population<SampleMap> JointProblem::vary(const Population<SampleMap>& population, const std::vector<double>& z_errors,
                                         Random& random) const {
  const int n = sites_.samples, count = static_cast<int>(population.size());
  Population<SampleMap> children;
  for (int k = 0; k < count; ++k) {
    SampleMap child = population[k].genome;
    const SampleMap& mate = population[tournament(z_errors, 2, random)].genome;
    // A geodesic disc of samples is made anew, or comes from the mate: limbs are exchanged whole.
    const int center = static_cast<int>(draw_below(random, n));
    const float radius = static_cast<float>(0.15 + 0.85 * draw_unit(random));
    const bool ruin = draw_unit(random) < options_.ruin_probability;
    for (int i = 0; i < n; ++i)
      if (sites_.distance(center, i) <= radius) child[i] = ruin ? -1 : mate[i];
    if (std::count(child.begin(), child.end(), -1) > n / 2) continue;
    for (int i = 0; i < n; ++i) {
      if (draw_unit(random) >= options_.mutation_probability) continue;
      const int reference =
          known_.empty() ? static_cast<int>(draw_below(random, n)) : known_[draw_below(random, known_.size())].sample;
      const bool step = draw_unit(random) < 0.5 && child[i] >= 0 && child[reference] >= 0;
      child[i] = step ? region_step(child, i, reference, random) : static_cast<int>(draw_below(random, sites_.count()));
    }
    if (child != population[k].genome) children.push_back({std::move(child)});
  }
  return children;
}

Population<SampleMap> JointProblem::replace(Population<SampleMap> parents, Population<SampleMap> children) const {
  // Restricted tournament (Harik 1995): a child competes with the one most like it, so that niches survive.
  for (auto& child : children) {
    if (!std::isfinite(child.cost)) continue;
    std::size_t rival = 0;
    double nearest = kInfinity;
    for (std::size_t i = 0; i < parents.size(); ++i) {
      const double d = difference(parents[i].genome, child.genome);
      if (d < nearest) nearest = d, rival = i;
    }
    if (child.cost < parents[rival].cost) parents[rival] = std::move(child);
  }
  return parents;
}

std::vector<std::array<int, 2>> JointProblem::seeds() const {
  std::vector<std::array<int, 2>> out;
  for (const KnownGene& known : known_) out.push_back({known.sample, sites_.nearest_sample[known.site]});
  // A symmetry takes tips to tips of about the same centricity.
  constexpr float kAlike = 0.15f;
  const std::vector<int>& tips = sites_.extremal;
  for (std::size_t a = 0; a < tips.size(); ++a)
    for (std::size_t b = a; b < tips.size(); ++b) {
      if (std::abs(sites_.centricity[tips[a]] - sites_.centricity[tips[b]]) > kAlike) continue;
      out.push_back({tips[a], tips[b]});
      if (kind_ == SymmetryKind::rotation && a != b) out.push_back({tips[b], tips[a]});
    }
  // Where tips are few, pairs that look most alike.
  struct Alike {
    float unlike;
    int a, b;
  };
  std::vector<Alike> alike;
  for (int a = 0; a < std::min(kCoarseSamples, sites_.samples); ++a)
    for (int b = 0; b < a; ++b) alike.push_back({unary_(a, b), a, b});
  std::stable_sort(alike.begin(), alike.end(), [](const Alike& x, const Alike& y) { return x.unlike < y.unlike; });
  for (const Alike& pair : alike) {
    if (out.size() >= kSeedPairs) break;
    out.push_back({pair.a, pair.b});
    if (kind_ == SymmetryKind::rotation) out.push_back({pair.b, pair.a});
  }
  return out;
}

namespace {

// Distinct maps in the given order. @param same  maps closer than this are one
Population<SampleMap> distinct(const JointProblem& problem, const Population<SampleMap>& sorted, double same,
                               int limit) {
  Population<SampleMap> out;
  for (const auto& individual : sorted) {
    if (static_cast<int>(out.size()) >= limit) break;
    const bool known = std::any_of(out.begin(), out.end(), [&](const auto& kept) {
      return problem.difference(kept.genome, individual.genome) < same;
    });
    if (!known) out.push_back(individual);
  }
  return out;
}

void sort_by_cost(Population<SampleMap>& population) {
  std::stable_sort(population.begin(), population.end(), [](const auto& a, const auto& b) { return a.cost < b.cost; });
}

// Coherent maps that are distinct after some improvement over the first samples alone, which costs little, the best of
// them carried to all samples and improved there.
Population<SampleMap> seed_population(const JointProblem& problem, int limit, int threads, const Context& context) {
  const Sites few = coarsened(problem.sites(), kCoarseSamples, problem.sites().samples);
  const JointProblem coarse(problem, few);
  const std::vector<std::array<int, 2>> seeds = problem.seeds();
  std::vector<Population<SampleMap>> of_pair(seeds.size());
  // Tells how far one of the three steps is; `worker` 0 is the calling thread.
  const auto tell = [&](int step, int done, std::size_t of, int worker) {
    if (worker == 0) context.report((step + static_cast<double>(done) / static_cast<double>(of)) / 3, "search");
    if (context.cancelled()) throw Cancelled();
  };
  parallel_for(static_cast<int>(seeds.size()), threads, [&](int s, int worker) {
    tell(0, s, seeds.size(), worker);
    Population<SampleMap> turned;
    for (int a = 0; a < kAngles; ++a) {
      SampleMap map = coarse.polar_map(seeds[s][0], seeds[s][1], 2 * 3.14159265358979323846 * a / kAngles);
      const double cost = coarse.cost(map);
      turned.push_back({std::move(map), cost, true});
    }
    sort_by_cost(turned);
    of_pair[s] = distinct(coarse, turned, kDistinctTurns, kSeedsPerPair);
  });
  Population<SampleMap> tried;
  for (auto& population : of_pair)
    for (auto& individual : population) tried.push_back(std::move(individual));
  sort_by_cost(tried);
  tried = distinct(coarse, tried, kDistinctTurns, kTried);
  parallel_for(static_cast<int>(tried.size()), threads, [&](int t, int worker) {
    tell(1, t, tried.size(), worker);
    coarse.best_response(tried[t].genome, kEverywhere, kSweeps);
    tried[t].cost = coarse.score(tried[t].genome);
  });
  sort_by_cost(tried);
  Population<SampleMap> out = distinct(coarse, tried, kDistinctSeeds, limit);
  parallel_for(static_cast<int>(out.size()), threads, [&](int i, int worker) {
    tell(2, i, out.size(), worker);
    out[i].genome.resize(problem.sites().samples, -1);
    out[i].cost = problem.evaluate(out[i].genome, worker);
    out[i].evaluated = true;
  });
  sort_by_cost(out);
  return distinct(problem, out, kSame, limit);
}

}  // namespace

JointResult search_joint(const JointProblem& problem, const JointOptions& options, Random& random, int threads,
                         const Context& context) {
  constexpr double kSeeded = 0.5;  // progress
  Population<SampleMap> population = seed_population(problem, options.population, threads, context.part(0, kSeeded));
  GeneticOptions genetic;
  genetic.max_generations = options.max_generations;
  genetic.stall_generations = 20;
  genetic.success_threshold = 0;
  genetic.threads = threads;
  const auto tell = [&](const GenerationLog& log) {
    context.report(kSeeded + (1 - kSeeded) * log.generation / std::max(1, options.max_generations), "search");
  };
  GeneticRun<SampleMap> run = evolve(problem, std::move(population), genetic, random, context, tell);
  JointResult result;
  result.log = std::move(run.log);
  result.stop = run.stop;
  sort_by_cost(run.population);
  for (auto& survivor : distinct(problem, run.population, kDistinct, kSurvivors)) {
    if (!std::isfinite(survivor.cost)) continue;
    result.maps.push_back(std::move(survivor.genome));
    result.costs.push_back(survivor.cost);
  }
  return result;
}

}  // namespace ga_symmetry
