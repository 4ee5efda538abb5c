// SPDX-License-Identifier: GPL-3.0-or-later
#include "search/map_cost.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace ga_symmetry {
namespace {

constexpr float kCap = 0.25f;      // of a relative squared error: half of the distance. Outliers count, but no more
constexpr float kReturn2 = 0.04f;  // squared distance, 0.2 units, at which a partner's partner is plainly not oneself
constexpr double kTrivial = 0.1;   // a map that moves a smaller share is the identity

float squared(float x) { return x * x; }

// Of a sample's neighbour whose partner is `distance` away from the sample's own partner.
float stretch_error(const Vicinity::Image& n, float distance) {
  return std::min(1.f, squared((distance - n.distance) * n.inverse));
}

// With directions as complex numbers, a reflection makes image * original, a rotation image / original, the same for
// all neighbours; the length of their mean says how well that holds.
void add_turn(const Vicinity::Image& n, const MapCost::Direction& image, float& re, float& im) {
  re += image.cosine * n.cosine - image.sine * n.sine;
  im += image.cosine * n.sine + image.sine * n.cosine;
}

// @param between  the partner's partner and the sample @param off  the partner and the sample nearest to it, whose
// partner stands for the partner's: it may be as far off
float return_error(float between, float off) { return std::min(1.f, squared(std::max(0.f, between - off)) / kReturn2); }

}  // namespace

float distance_error(const float* a, const float* b, const float* slack_a, const float* slack_b, const float* weight,
                     int n) {
  using Row = Eigen::Map<const Eigen::ArrayXf>;
  const auto difference = Row(a, n) - Row(b, n);
  if (!slack_a) return (difference.square() * Row(weight, n)).min(kCap).sum();
  const auto gap = (difference.abs() - Row(slack_a, n) - Row(slack_b, n)).max(0.f);
  return (gap.square() * Row(weight, n)).min(kCap).sum();
}

CostWeights make_cost_weights(const JointOptions& o, SymmetryKind kind, bool orientable) {
  return {o.distance_weight, orientable ? o.orientation_weight : 0, o.continuity_weight,
          kind == SymmetryKind::reflection ? o.bijectivity_weight : 0};
}

Table make_unary_costs(const Sites& sites, double unit, const Anchors& anchors, const JointOptions& options) {
  // References say which end is which; then descriptors, which like the identity best, need say less.
  constexpr float kDescriptorsBesideReferences = 0.3f;
  const int samples = sites.samples, count = sites.count();
  const int anchor_count = anchors.count();
  const float descriptor_weight =
      static_cast<float>(options.descriptor_weight) * (anchor_count == 0 ? 1 : kDescriptorsBesideReferences);
  Table unary(samples, count);
  for (int i = 0; i < samples; ++i)
    for (int k = 0; k < count; ++k)
      unary(i, k) =
          descriptor_weight * (sites.descriptor.row(i) - sites.descriptor.row(k)).array().square().min(1.f).mean();
  const float length = static_cast<float>(unit);
  for (int t = 0; t < anchor_count; ++t) {
    const float share = static_cast<float>(options.reference_weight) / static_cast<float>(anchor_count);
    for (int i = 0; i < samples; ++i) {
      const float d = anchors.from.field(t, sites.vertex[i]) / length;
      for (int k = 0; k < count; ++k) {
        const float e = anchors.image.field(t, sites.vertex[k]) / length - d;
        unary(i, k) += share * std::min(1.f, e * e / (d * d + kNear2));
      }
    }
  }
  return unary;
}

MapCost::MapCost(const Sites& sites, SymmetryKind kind, Table unary, const CostWeights& weights)
    : sites_(sites), kind_(kind), weights_(weights), unary_(std::move(unary)) {
  distance_weight_ = (sites.distance.topLeftCorner(sites.samples, sites.samples).array().square() + kNear2).inverse();
  distance_weight_.diagonal().setZero();  // no distance: a gene's old partner must not hold its new one back
  index_directions();
}

MapCost::MapCost(const MapCost& fine, const Sites& coarse)
    : sites_(coarse),
      kind_(fine.kind_),
      weights_(fine.weights_),
      distance_weight_(fine.distance_weight_.topLeftCorner(coarse.samples, coarse.samples)),
      unary_(fine.unary_.topLeftCorner(coarse.samples, coarse.count())) {
  index_directions();
}

void MapCost::index_directions() {
  const int count = sites_.count();
  direction_.resize(static_cast<std::size_t>(count) * count);
  for (int k = 0; k < count; ++k)
    for (int j = 0; j < count; ++j)
      direction_[static_cast<std::size_t>(j) * count + k] = {sites_.cosine(k, j), sites_.sine(k, j)};
}

void MapCost::look_around(const SampleMap& map, int i, Vicinity& out) const {
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

float MapCost::orientation_error(const Vicinity& around, int k) const {
  float re = 0, im = 0;
  for (const Vicinity::Image& n : around.near) add_turn(n, direction(k, n.site), re, im);
  return around.near.empty() ? 0 : 1 - std::sqrt(re * re + im * im) * around.inverse_weight;
}

float MapCost::continuity_error(const Vicinity& around, int k) const {
  const float* row = sites_.distance.row(k).data();
  float sum = 0;
  for (const Vicinity::Image& n : around.near) sum += stretch_error(n, row[n.site]);
  return sum * around.inverse_count;
}

float MapCost::bijectivity_error(const SampleMap& map, int i, int k) const {
  const int back = sites_.nearest_sample[k];
  return return_error(sites_.distance(back == i ? k : map[back], i), sites_.distance(back, k));
}

CostTerms MapCost::terms(const SampleMap& map) const {
  const int n = sites_.samples;
  double distance = 0, orientation = 0, continuity = 0, unary = 0, bijectivity = 0;
  Vicinity around;
  for (int i = 0; i < n; ++i) {
    const float* row = sites_.distance.row(i).data();
    const float* image = sites_.distance.row(map[i]).data();
    const float* weight = distance_weight_.row(i).data();
    float sum = 0;
    for (int j = 0; j < n; ++j) {
      const float slack = sites_.slack.size() > 0 ? sites_.slack(i, j) + sites_.slack(map[i], map[j]) : 0;
      sum += std::min(kCap, squared(std::max(0.f, std::abs(row[j] - image[map[j]]) - slack)) * weight[j]);
    }
    distance += sum;
    look_around(map, i, around);
    orientation += orientation_error(around, map[i]);
    continuity += continuity_error(around, map[i]);
    unary += unary_(i, map[i]);
    bijectivity += bijectivity_error(map, i, map[i]);
  }
  return {distance / n / n, orientation / n, continuity / n, unary / n, bijectivity / n};
}

double MapCost::total(const CostTerms& t) const {
  return weights_.distance * t.distance + weights_.orientation * t.orientation + weights_.continuity * t.continuity +
         t.unary + weights_.bijectivity * t.bijectivity;
}

double MapCost::score(const SampleMap& map) const {
  const double share = moved_share(sites_, map);
  return share < kTrivial ? std::numeric_limits<double>::infinity() : cost(map) / (share * share);
}

namespace {

// Per thread: no allocation per individual.
std::array<std::vector<float>, 2>& scratch_tables() {
  thread_local std::array<std::vector<float>, 2> tables;
  return tables;
}

}  // namespace

GeneCost::GeneCost(const MapCost& cost, SampleMap& map)
    : cost_(cost), sites_(cost.sites()), map_(map), image_(scratch_tables()[0]), slack_(scratch_tables()[1]) {
  const int n = sites_.samples, count = sites_.count();
  // Contiguous in the samples for the inner loop.
  const auto gather = [&](const Table& table, std::vector<float>& to) {
    to.resize(table.size() > 0 ? static_cast<std::size_t>(n) * count : 0);
    float* out = to.data();
    for (Eigen::Index k = 0; k < table.rows(); ++k)
      for (int j = 0; j < n; ++j) *out++ = table(k, map[j]);
  };
  gather(sites_.distance, image_);
  gather(sites_.slack, slack_);
  const CostWeights& w = cost.weights();
  distance_weight_ = static_cast<float>(2 * w.distance) / static_cast<float>(n);  // a pair of samples counts for both
  orientation_weight_ = static_cast<float>(w.orientation);
  continuity_weight_ = static_cast<float>(w.continuity);
  bijectivity_weight_ = static_cast<float>(w.bijectivity);
}

void GeneCost::look_at(int gene) {
  gene_ = gene;
  observed_ = false;
  cost_.look_around(map_, gene, around_);
}

void GeneCost::look_at_observers() {
  if (observed_) return;
  observed_ = true;
  observers_.clear();
  for (int j : sites_.observers[gene_]) {
    cost_.look_around(map_, j, around_observer_);
    Observer out{map_[j], {}, 0, 0, around_observer_.inverse_weight, around_observer_.inverse_count};
    // The map is whole, so that neighbours and what is seen of them are in the same order.
    for (std::size_t k = 0; k < around_observer_.near.size(); ++k) {
      const Vicinity::Image& n = around_observer_.near[k];
      if (sites_.neighbors[j][k] == gene_)
        out.gene = n;
      else
        add_turn(n, cost_.direction(out.site, n.site), out.re, out.im);
    }
    observers_.push_back(out);
  }
  returns_.clear();
  if (bijectivity_weight_ <= 0) return;
  for (int j = 0; j < sites_.samples; ++j)
    if (j != gene_ && sites_.nearest_sample[map_[j]] == gene_) returns_.push_back({j, sites_.distance(gene_, map_[j])});
}

float GeneCost::distance_error_to(int site, int first, int count) const {
  const std::size_t at = static_cast<std::size_t>(site) * sites_.samples + first;
  const float *from = &sites_.distance(gene_, first), *weight = &cost_.distance_weight()(gene_, first);
  return slack_.empty() ? distance_error(from, &image_[at], nullptr, nullptr, weight, count)
                        : distance_error(from, &image_[at], &sites_.slack(gene_, first), &slack_[at], weight, count);
}

float GeneCost::orientation_error(int site) const {
  float sum = cost_.orientation_error(around_, site);
  for (const Observer& o : observers_) {
    float re = o.re, im = o.im;
    add_turn(o.gene, cost_.direction(o.site, site), re, im);
    sum += 1 - std::sqrt(re * re + im * im) * o.inverse_weight;
  }
  return sum;
}

float GeneCost::continuity_error(int site) const {
  const float* row = sites_.distance.row(site).data();
  float sum = cost_.continuity_error(around_, site);
  for (const Observer& o : observers_) sum += stretch_error(o.gene, row[o.site]) * o.inverse_count;
  return sum;
}

float GeneCost::bijectivity_error(int site) const {
  const float* row = sites_.distance.row(site).data();
  float sum = cost_.bijectivity_error(map_, gene_, site);
  for (const Return& r : returns_) sum += return_error(row[r.sample], r.off);
  return sum;
}

float GeneCost::cost(int site) {
  look_at_observers();
  float total = cost_.unary()(gene_, site) + distance_weight_ * distance_error_to(site, 0, sites_.samples);
  if (orientation_weight_ > 0) total += orientation_weight_ * orientation_error(site);
  if (continuity_weight_ > 0) total += continuity_weight_ * continuity_error(site);
  if (bijectivity_weight_ > 0) total += bijectivity_weight_ * bijectivity_error(site);
  return total;
}

float GeneCost::guess(int site, float limit) const {
  // Directions rule out most sites, at a tenth of what all distances cost.
  float total = cost_.unary()(gene_, site);
  if (total >= limit) return total;
  if (orientation_weight_ > 0) total += 2 * orientation_weight_ * cost_.orientation_error(around_, site);
  if (total >= limit) return total;
  if (continuity_weight_ > 0) total += 2 * continuity_weight_ * cost_.continuity_error(around_, site);
  if (bijectivity_weight_ > 0) total += 2 * bijectivity_weight_ * cost_.bijectivity_error(map_, gene_, site);
  // Samples come from coarse to fine, so that the first ones tell most of the wrong sites.
  constexpr int kAtOnce = 24;
  for (int first = 0; first < sites_.samples && total < limit; first += kAtOnce)
    total += distance_weight_ * distance_error_to(site, first, std::min(kAtOnce, sites_.samples - first));
  return total;
}

void GeneCost::set(int site) {
  map_[gene_] = site;
  observed_ = false;
  const std::size_t n = sites_.samples;
  for (std::size_t k = 0, at = gene_; at < image_.size(); ++k, at += n) image_[at] = sites_.distance(k, site);
  for (std::size_t k = 0, at = gene_; at < slack_.size(); ++k, at += n) slack_[at] = sites_.slack(k, site);
}

}  // namespace ga_symmetry
