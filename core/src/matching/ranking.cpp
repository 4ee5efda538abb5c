// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/ranking.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "ga_symmetry/errors.h"
#include "util/parallel.h"

namespace ga_symmetry {
namespace {

constexpr int kMaxOrder = 12;           // of rotations: of more sides than a dodecagon, 100 samples tell little
constexpr double kReturned = 0.1;       // mean distance, in units, at which samples are back: that between neighbours;
                                        // each application adds to it, as partners are taken by the nearest sample
constexpr std::size_t kContenders = 8;  // survivors taken to vertex resolution to find the best
constexpr int kFirst = 2;               // of those, before the rest
constexpr double kWrong = 0.2;          // score of a map that is none: what no symmetry is found for has such maps, too
constexpr double kTurned = 10;  // times its share of the surface: how much what is wrongly turned adds to the score
// How far off distances around a reference are, on average, where it goes elsewhere: more than lies between samples,
// and between sites before refinement.
constexpr double kElsewhere = 0.15, kElsewhereAtSites = 0.2;  // units
// Squared distance, in units, by which a place is off that has no counterpart: it costs no more, and says nothing of
// the rest.
constexpr float kLost = 0.01f;
constexpr double kClose = 1.5;  // times the best score: refinement may still change the order

// How often a map over samples must be applied to come back; 0 if it does not within kMaxOrder.
int order_of(const Sites& sites, const SampleMap& map) {
  std::vector<int> at(map.begin(), map.end());
  for (int order = 1; order <= kMaxOrder; ++order) {
    double away = 0;
    for (int i = 0; i < sites.samples; ++i) away += sites.distance(at[i], i);
    if (away / sites.samples < kReturned * std::min(2.0, std::sqrt(order))) return order;
    for (int& site : at) site = map[sites.nearest_sample[site]];
  }
  return 0;
}

// How far the samples around the references go elsewhere than around their images: root mean square over the references
// of the mean difference of distances, in units; +inf if one is off by more than `elsewhere`: not the map that is
// meant.
double off_references(const Matching& m, const Images& images, double elsewhere) {
  constexpr int kAround = 6;
  const int samples = m.movable(), around = std::min(kAround, samples);
  std::vector<std::pair<float, int>> near(samples);
  double squares = 0;
  for (int t = samples; t < m.count(); ++t) {
    for (int i = 0; i < samples; ++i) near[i] = {m.landmarks.field(t, m.landmarks.vertex[i]), i};
    std::partial_sort(near.begin(), near.begin() + around, near.end());
    double off = 0;
    for (int k = 0; k < around; ++k)
      off += std::abs(near[k].first - images.field(t, images.vertex[near[k].second])) / m.surface.unit() / around;
    if (off > elsewhere) return INFINITY;
    squares += off * off;
  }
  return std::sqrt(squares / std::max(1, m.fixed));
}

// How many times worse a map is for that. On what has symmetries without end, like a glass, nothing else tells which of
// them is meant.
double reference_factor(double off) {
  constexpr double kOff = 0.05;  // units: twice as bad
  const double more = std::max(0.0, off - kReferenceSlack);
  return 1 + more * more / (kOff * kOff);
}

// Whether a reference goes to another place: then it is the user who says which way round.
bool directed(const Matching& m, const Images& images) {
  return !std::equal(images.vertex.begin() + m.movable(), images.vertex.end(),
                     m.landmarks.vertex.begin() + m.movable());
}

// Whether a rotation turns the samples as they stand clockwise, seen from the positive end of the coordinate axis that
// is nearest to what it turns about.
bool turns_clockwise(const Matching& m, const Images& images) {
  const auto at = [&](int v) { return Eigen::Vector3d(m.surface.point(v)); };
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(), turn = centre;
  for (int i = 0; i < m.movable(); ++i) centre += at(m.landmarks.vertex[i]) / m.movable();
  for (int i = 0; i < m.movable(); ++i)
    turn += (at(m.landmarks.vertex[i]) - centre).cross(at(images.vertex[i]) - centre);
  Eigen::Index axis;
  turn.cwiseAbs().maxCoeff(&axis);
  return turn[axis] < 0;
}

// The way back: a sample goes to the one whose image is nearest to it, then to where distances agree best.
Images inverted(const Matching& m, const Images& images, int threads, const Context& context) {
  Images out = images;
  for (int i = 0; i < m.movable(); ++i) {
    Eigen::Index nearest;
    images.field.col(m.landmarks.vertex[i]).head(m.movable()).minCoeff(&nearest);
    out.vertex[i] = m.landmarks.vertex[nearest];
    out.field.row(i) = m.landmarks.field.row(nearest);
  }
  return refine_images(m, std::move(out), threads, {nullptr, context.cancel});
}

}  // namespace

Images images_of(const SampleMap& map, const Sites& sites, const Landmarks& reference_images) {
  Images out;
  out.field.resize(sites.samples + reference_images.field.rows(), sites.field.cols());
  for (int i = 0; i < sites.samples; ++i) {
    out.vertex.push_back(sites.vertex[map[i]]);
    out.field.row(i) = sites.field.row(map[i]);
  }
  out.vertex.insert(out.vertex.end(), reference_images.vertex.begin(), reference_images.vertex.end());
  if (!reference_images.vertex.empty()) out.field.bottomRows(reference_images.field.rows()) = reference_images.field;
  return out;
}

Mirrored mirrored_by(const Matching& m, const std::vector<int>& vertices, const std::vector<SurfacePoint>& partners) {
  constexpr double kCap = 0.04;       // squared units: what one side lacks says nothing of the rest
  constexpr double kNoMirror = 0.16;  // units away: fitting a plane makes no mirror of it
  std::vector<Eigen::Vector3d> from, to;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    from.emplace_back(m.surface.point(vertices[i]));
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k) at += partners[i].weight[k] * Eigen::Vector3d(m.surface.point(partners[i].vertex[k]));
    to.push_back(at);
  }
  const auto away = [&](const MirrorPlane& plane) {
    double sum = 0;
    for (std::size_t i = 0; i < from.size(); ++i)
      sum += std::min(kCap, (plane.mirror(from[i]) - to[i]).squaredNorm() / m.surface.area);
    return std::sqrt(sum / static_cast<double>(from.size()));
  };
  Mirrored out{MirrorPlanes::between(from, to), 0};
  out.away = away(out.plane);
  if (out.away > kNoMirror) return out;
  out.plane = m.planes->fitted(out.plane);
  out.away = away(out.plane);
  return out;
}

namespace {

// @param probes  of the sites' vertices
double disagreement_by(const Matching& m, const Sites& sites, const Probes& probes) {
  constexpr double kDescriptors = 0.15, kPlainlyMoved = 0.8;
  double error = 0, moved = 0, unlike = 0;
  for (int k = 0; k < sites.count(); ++k) {
    error += std::min(kLost, probes.error[k]);
    const int partner = probes.partner[k];
    moved += moved_share(std::pow(sites.field(k, partner) / m.surface.unit(), 2));
    const auto difference = sites.descriptor.row(k) - sites.descriptor.row(sites.nearest[partner]);
    unlike += difference.array().square().min(1.f).mean();
  }
  if (moved == 0) return INFINITY;
  error /= sites.count(), moved /= sites.count(), unlike /= sites.count();
  // Where the map is the mirror image of the shape as it stands, that is evidence of its own: up to half the score. A
  // pose that is not symmetric says nothing.
  constexpr double kMisfit = 0.04, kAway = 0.12;  // units, at which there is none
  double doubt = 1;
  if (m.reflection && m.planes) {
    std::vector<SurfacePoint> partners;
    for (const int p : probes.partner) partners.push_back({{p, p, p}, {1, 0, 0}});
    const Mirrored mirrored = mirrored_by(m, sites.vertex, partners);
    doubt = 0.5 + 0.5 * std::min(1.0, std::max(mirrored.plane.misfit / kMisfit, mirrored.away / kAway));
  }
  return doubt * (std::sqrt(error) + kDescriptors * unlike * unlike) / std::pow(std::min(kPlainlyMoved, moved), 2);
}

Probes of_sites(const Sites& sites, const Probes& all) {
  Probes out;
  for (const int v : sites.vertex) {
    out.partner.push_back(all.partner[v]);
    out.error.push_back(all.error[v]);
  }
  return out;
}

}  // namespace

double disagreement(const Matching& m, const Sites& sites, const Images& images) {
  return disagreement_by(m, sites, match_probes(m, images, sites.vertex));
}

bool same_symmetry(const Matching& m, const Sites& sites, const Images& a, const Images& b) {
  constexpr double kSame = 0.1;  // mean distance of their images, in units
  double apart = 0;
  for (int i = 0; i < sites.samples; ++i) apart += sites.field(sites.nearest[a.vertex[i]], b.vertex[i]);
  return apart < kSame * m.surface.unit() * sites.samples;
}

double wrongly_turned(const Matching& m, const Probes& probes) {
  const std::vector<int>& partner = probes.partner;
  const Surface& s = m.surface;
  const auto at = [&](int v) { return Eigen::Vector3d(s.point(v)); };
  std::vector<Eigen::Vector3d> normal(s.vertices(), Eigen::Vector3d::Zero());
  const auto turn = [&](int a, int b, int c) -> Eigen::Vector3d { return (at(b) - at(a)).cross(at(c) - at(a)); };
  for (int f = 0; f < s.triangles(); ++f) {
    const int* v = &s.triangle[3 * static_cast<std::size_t>(f)];
    const Eigen::Vector3d n = turn(v[0], v[1], v[2]);
    for (int k = 0; k < 3; ++k) normal[v[k]] += n;
  }
  double wrong = 0, all = 0;
  for (int f = 0; f < s.triangles(); ++f) {
    const int* v = &s.triangle[3 * static_cast<std::size_t>(f)];
    if (std::max({probes.error[v[0]], probes.error[v[1]], probes.error[v[2]]}) >= kLost) continue;
    const int a = partner[v[0]], b = partner[v[1]], c = partner[v[2]];
    const double along = turn(a, b, c).dot(normal[a] + normal[b] + normal[c]);
    if (along == 0) continue;
    const double area = turn(v[0], v[1], v[2]).norm();
    all += area;
    if ((along > 0) == m.reflection) wrong += area;
  }
  return all > 0 ? wrong / all : 0;
}

bool inverse_symmetries(const Matching& m, const Sites& sites, const Images& a, const Images& b) {
  constexpr double kBack = 0.14;  // mean distance, in units: each of two applications is off by up to half a sample
  double away = 0;
  for (int i = 0; i < sites.samples; ++i)
    away += b.field(sites.nearest_sample[sites.nearest[a.vertex[i]]], m.landmarks.vertex[i]);
  return away < kBack * m.surface.unit() * sites.samples;
}

std::vector<Candidate> candidates_of(const Matching& m, const Sites& sites, const std::vector<SampleMap>& maps,
                                     const Landmarks& reference_images, int threads) {
  std::vector<Candidate> out(maps.size());
  parallel_for(static_cast<int>(maps.size()), threads, [&](int i, int) {
    Candidate& c = out[i];
    c.images = images_of(maps[i], sites, reference_images);
    c.order = m.reflection ? 2 : order_of(sites, maps[i]);
    c.off_references = off_references(m, c.images, kElsewhereAtSites);
    c.score = std::isfinite(c.off_references) ? reference_factor(c.off_references) * disagreement(m, sites, c.images)
                                              : INFINITY;
  });
  return out;
}

std::vector<Candidate> rank_maps(const Matching& m, const Sites& sites, const std::vector<SampleMap>& maps,
                                 const Landmarks& reference_images, Refine refine, int threads,
                                 const Context& context) {
  const auto by_score = [](const auto& a, const auto& b) { return a.score < b.score; };
  std::vector<Candidate> survivors = candidates_of(m, sites, maps, reference_images, threads);
  std::stable_sort(survivors.begin(), survivors.end(), by_score);
  if (refine == Refine::contenders) survivors.resize(std::min(kContenders, survivors.size()));
  std::vector<int> all(m.surface.vertices());
  std::iota(all.begin(), all.end(), 0);
  const double close = survivors.empty() ? 0 : kClose * survivors[0].score;
  const auto look_closer = [&](Candidate& c) {
    if (!std::isfinite(c.score)) return;
    const bool refined = refine == Refine::all || c.score < close;
    if (refined) c.images = refine_images(m, std::move(c.images), 1, {nullptr, context.cancel});
    if (refined) c.off_references = off_references(m, c.images, kElsewhere);
    if (!std::isfinite(c.off_references)) {
      c.score = INFINITY;
      return;
    }
    const double references = reference_factor(c.off_references);
    if (m.surface.orientable) {
      const Probes probes = match_probes(m, c.images, all);
      if (refined) c.score = references * disagreement_by(m, sites, of_sites(sites, probes));
      c.score *= 1 + kTurned * wrongly_turned(m, probes);
    } else if (refined) {
      c.score = references * disagreement(m, sites, c.images);
    }
  };
  const int count = static_cast<int>(survivors.size());
  const auto look_closer_at = [&](int begin, int end, double most) {
    parallel_for(end - begin, threads, [&](int i, int worker) {
      if (worker == 0) context.advance((begin + i) / static_cast<double>(count));  // the calling thread
      if (context.cancelled()) throw Cancelled();
      if (survivors[begin + i].score < most) look_closer(survivors[begin + i]);
    });
  };
  // The first ones tell which of the rest can still be the best, or so near that confidence depends on it.
  const int first = std::min(kFirst, count);
  look_closer_at(0, first, INFINITY);
  double best = INFINITY;
  for (int i = 0; i < first; ++i) best = std::min(best, survivors[i].score);
  look_closer_at(first, count, refine == Refine::all ? INFINITY : std::max(kWrong, kClose * best));
  std::stable_sort(survivors.begin(), survivors.end(), by_score);
  // What is none counts only where there is nothing else.
  if (!survivors.empty() && std::isfinite(survivors[0].score))
    survivors.erase(
        std::find_if(survivors.begin(), survivors.end(), [](const Candidate& c) { return !std::isfinite(c.score); }),
        survivors.end());
  std::vector<Candidate> out;
  for (Candidate& c : survivors) {
    if (c.order == 1) continue;  // the identity is no answer
    const bool known = std::any_of(out.begin(), out.end(), [&](const Candidate& better) {
      return same_symmetry(m, sites, better.images, c.images) ||
             (!m.reflection && inverse_symmetries(m, sites, better.images, c.images));
    });
    if (known) continue;
    if (!m.reflection && c.order != 2 && !directed(m, c.images) && turns_clockwise(m, c.images))
      c.images = inverted(m, c.images, threads, context);
    out.push_back(std::move(c));
  }
  return out;
}

double confidence_of(const std::vector<Candidate>& ranking) {
  // Logistic regression on whether answers were right; docs/search.md says on which, and how well it holds on others.
  constexpr double kNearTie = 0.2, kLead = 3.4;
  constexpr double kExact = 1e-6;  // below, scores are rounding
  if (ranking.empty()) return 0;
  const double best = std::max(kExact, ranking[0].score);
  const double next = std::max(kExact, std::min(kWrong, ranking.size() < 2 ? kWrong : ranking[1].score));
  return 1 / (1 + std::exp(-kNearTie) * std::pow(best / next, kLead));
}

}  // namespace ga_symmetry
