#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "axis/sides.h"
#include "ga_symmetry/option_table.h"
#include "ga_symmetry/symmetry.h"
#include "geodesics/shortcuts.h"
#include "matching/dense_map.h"
#include "matching/landmarks.h"
#include "search/joint.h"
#include "search/pairs.h"
#include "search/sites.h"
#include "surface/curvature.h"
#include "surface/proxy.h"
#include "surface/surface.h"
#include "util/parallel.h"

namespace ga_symmetry {

const char* to_string(SymmetryKind kind) { return kind == SymmetryKind::reflection ? "reflection" : "rotation"; }

const char* to_string(StopReason reason) {
  switch (reason) {
    case StopReason::success_threshold:
      return "success threshold reached";
    case StopReason::converged:
      return "converged";
    case StopReason::max_generations:
      return "generation limit reached";
  }
  return "";
}

namespace {

constexpr int kNeighbors = 8;              // samples that count as near for orientation and continuity
constexpr int kMaxOrder = 12;              // of rotations
constexpr int kCompared = 3, kAll = 1000;  // survivors taken to vertex resolution, to find the best or any
constexpr double kClose = 1.5;             // times the best score: refinement may still change the order
constexpr double kShortestAxis = 0.05;
constexpr const char* kNoSymmetry =
    "no symmetry found: give four (other) references, or search for the other kind of symmetry";
constexpr double kDoubtful = 0.2;           // confidence
constexpr double kWorthProxy = 1.3;         // a surface so many times larger than its proxy is searched on it
constexpr double kAdjustCurvature = 0.006;  // as in the matching: first without, as it misleads far off
constexpr double kMoved2 = 0.01;            // squared distance, in units, at which a partner is plainly not oneself

// The references as surface vertices. @throws InvalidOption
References on_surface(const References& references, const Surface& surface) {
  std::vector<int> index(surface.mesh_vertices, -1);
  for (int v = 0; v < surface.vertices(); ++v) index[surface.mesh_vertex[v]] = v;
  std::set<int> used;
  const auto map = [&](int v) {
    if (v < 0 || v >= surface.mesh_vertices)
      throw InvalidOption("reference vertex " + std::to_string(v) + " does not exist: the mesh has vertices 0 to " +
                          std::to_string(surface.mesh_vertices - 1));
    if (index[v] < 0)
      throw InvalidOption("reference vertex " + std::to_string(v) +
                          " is not on the surface that is worked on: choose a vertex of its faces");
    if (!used.insert(v).second)
      throw InvalidOption("reference vertex " + std::to_string(v) + " is given twice: choose different vertices");
    return index[v];
  };
  References out;
  for (int a : references.axis) out.axis.push_back(map(a));
  for (const auto& [l, r] : references.pairs) {
    const int left = map(l);
    out.pairs.push_back({left, map(r)});
  }
  return out;
}

// Times the stages one after the other.
class StageClock {
 public:
  explicit StageClock(std::vector<StageTime>& out) : out_(out), last_(Clock::now()) {}
  void stage_done(const char* name) {
    const auto now = Clock::now();
    out_.push_back({name, std::chrono::duration<double>(now - last_).count()});
    last_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::vector<StageTime>& out_;
  Clock::time_point last_;
};

// How often a map over samples must be applied to come back; 0 if it does not within kMaxOrder.
int order_of(const Sites& sites, const SampleMap& map) {
  std::vector<int> at(map.begin(), map.end());
  for (int order = 1; order <= kMaxOrder; ++order) {
    double away = 0;
    for (int i = 0; i < sites.samples; ++i) away += sites.distance(at[i], i);
    if (away / sites.samples < 0.1) return order;
    for (int& site : at) site = map[sites.nearest_sample[site]];
  }
  return 0;
}

// Everything below is in surface vertices; finish() turns it into the mesh's own.
struct Found {
  std::vector<int> partner, side;
  std::vector<double> fitness;
  std::vector<SurfacePoint> point;
  std::vector<float> left;  // how much nearer to the left than to the right; empty for a rotation
  std::vector<std::vector<SurfacePoint>> axis;
};

SurfacePoint to_mesh(const Surface& surface, SurfacePoint p) {
  for (int& v : p.vertex)
    if (v >= 0) v = surface.mesh_vertex[v];
  return p;
}

void finish(const Surface& surface, Found found, double max_fitness, Result& result) {
  const int n = surface.mesh_vertices;
  result.partner.assign(n, -1);
  result.side.assign(n, 0);
  result.partner_point.assign(n, {});
  double worst = 0, sum = 0;
  for (int v = 0; v < surface.vertices(); ++v) {
    if (found.partner[v] < 0) continue;
    worst = std::max(worst, found.fitness[v]);
    if (max_fitness > 0 && found.fitness[v] > max_fitness) {
      found.partner[v] = -1;
      continue;
    }
    sum += found.fitness[v];
    ++result.matched;
  }
  result.mean_fitness = result.matched ? sum / result.matched : 0;
  result.fitness.assign(n, worst);
  for (int v = 0; v < surface.vertices(); ++v) {
    const int m = surface.mesh_vertex[v];
    result.side[m] = found.side[v];
    if (found.partner[v] < 0) continue;
    result.partner[m] = surface.mesh_vertex[found.partner[v]];
    result.fitness[m] = found.fitness[v];
    result.partner_point[m] = to_mesh(surface, found.point[v]);
  }
  for (auto& line : found.axis)
    for (auto& p : line) p = to_mesh(surface, p);
  result.axis = std::move(found.axis);
  std::vector<SymmetricPair> pairs;
  for (const SymmetricPair& pair : result.pairs)
    if (found.partner[pair.vertex] >= 0)
      pairs.push_back({surface.mesh_vertex[pair.vertex], surface.mesh_vertex[pair.partner], pair.fitness});
  result.pairs = std::move(pairs);
}

Found find_by_pairs(const Surface& surface, const References& references, const Options& options, Random& random,
                    const Context& context, StageClock& clock, Result& result) {
  const GeodesicSolver solver(surface);
  const std::array<int, 2> axis{references.axis[0], references.axis[1]};
  PairsResult pairs =
      search_pairs(surface, solver, axis, references.pairs[0], options.pairs, random, options.threads, context);
  clock.stage_done("search");
  result.log = std::move(pairs.log);
  result.stop = pairs.stop;
  result.pairs = std::move(pairs.pairs);
  Found found;
  found.partner = std::move(pairs.partner);
  found.fitness = std::move(pairs.fitness);
  found.side = std::move(pairs.side);
  for (int v : found.partner) found.point.push_back({{v, v, v}, {1, 0, 0}});
  const DistanceFields field =
      solver.fields({references.pairs[0][0], references.pairs[0][1]}, options.threads, context);
  std::vector<float> nearer_left(surface.vertices());
  for (int v = 0; v < surface.vertices(); ++v) nearer_left[v] = field(1, v) - field(0, v);
  found.left = std::move(nearer_left);
  result.symmetries.push_back({SymmetryKind::reflection, 2, 1, result.log.empty() ? 0 : result.log.back().best});
  return found;
}

// The landmarks of a sample map, then the references, which are exact.
RefinedLandmarks make_landmarks(const Sites& sites, const SampleMap& map, const std::vector<Anchor>& anchors,
                                const DistanceFields& anchor_images) {
  RefinedLandmarks out;
  out.to_field.resize(sites.samples + anchor_images.rows(), sites.field.cols());
  for (int i = 0; i < sites.samples; ++i) {
    out.landmarks.from.push_back(sites.vertex[i]);
    out.landmarks.to.push_back(sites.vertex[map[i]]);
    out.to_field.row(i) = sites.field.row(map[i]);
  }
  for (const Anchor& a : anchors) {
    out.landmarks.from.push_back(a.vertex);
    out.landmarks.to.push_back(a.image);
  }
  out.to_field.bottomRows(anchor_images.rows()) = anchor_images;
  return out;
}

DistanceFields anchor_fields(const GeodesicSolver& solver, const std::vector<Anchor>& anchors, int Anchor::*end,
                             int threads) {
  std::vector<int> sources;
  for (const Anchor& a : anchors) sources.push_back(a.*end);
  return solver.fields(sources, threads);
}

// What tells how far off a partner may be, in units, averaged over the neighbourhood, because errors are smooth: how
// far the partner's partner is from the vertex, how much the map stretches the edges around it, and what the residual
// says. Distances between partners are those of the landmarks' fields, a lower bound that is tight where landmarks are
// dense.
std::vector<double> vertex_fitness(const Surface& surface, const DenseMap& map, const DistanceFields& from,
                                   bool involution, HeatDiffusion& diffusion) {
  constexpr double kStretch = 0.04, kUncertainty = 0.2, kSmooth = 0.025;
  const int n = surface.vertices();
  std::vector<float> off(n, 0.f), stretched(3 * static_cast<std::size_t>(surface.triangles()), 0.f);
  for (Eigen::Index i = 0; i < from.rows(); ++i) {
    const float* field = from.row(i).data();
    if (involution)
      for (int v = 0; v < n; ++v) off[v] = std::max(off[v], std::abs(field[v] - field[map.partner[map.partner[v]]]));
    for (int c = 0; c < 3 * surface.triangles(); ++c)
      stretched[c] = std::max(stretched[c], std::abs(field[map.partner[surface.triangle[c]]] -
                                                     field[map.partner[surface.triangle[next_corner(c)]]]));
  }
  std::vector<double> stretch(n, 0.0);
  std::vector<int> edges(n, 0);
  for (int c = 0; c < 3 * surface.triangles(); ++c) {
    const int a = surface.triangle[c], b = surface.triangle[next_corner(c)];
    // Partners are vertices: an edge may well shrink to nothing, and that says little.
    const double length = surface.edge_length(a, b), log = std::abs(std::log((stretched[c] / length + 0.3) / 1.3));
    for (int v : {a, b}) stretch[v] += log, ++edges[v];
  }
  Eigen::VectorXd out(n);
  for (int v = 0; v < n; ++v)
    out[v] = off[v] / surface.unit() + kStretch * stretch[v] / edges[v] + kUncertainty * map.uncertainty[v];
  out = diffusion.smooth(out, kSmooth).cwiseMax(0);
  return {out.begin(), out.end()};
}

struct Candidate {
  RefinedLandmarks refined;
  int order = 0;
  double score = 0;
};

// Everything that is known of a surface before its partners: the survivors of the search, and what ranks them.
struct Survey {
  std::unique_ptr<Shortcuts> shortcuts;  // `refine` points to them, also when a survey is moved
  Sites sites;
  std::vector<int> nearest_site;  // per vertex
  std::vector<Anchor> anchors;
  DistanceFields from;  // of the samples, then of the anchors
  CurvatureFeatures curvature;
  RefineOptions refine;
  std::vector<Candidate> ranking;  // distinct, best first
  std::vector<GenerationLog> log;
  StopReason stop = StopReason::max_generations;
};

std::vector<int> nearest_sites(const Sites& sites) {
  std::vector<int> nearest(sites.field.cols(), 0);
  for (int k = 1; k < sites.count(); ++k)
    for (std::size_t v = 0; v < nearest.size(); ++v)
      if (sites.field(k, v) < sites.field(nearest[v], v)) nearest[v] = k;
  return nearest;
}

// How badly distances, curvature and descriptors agree under a map: root mean square over the sites, which are as good
// as evenly spaced vertices, and relative to how far it moves them. Any shape is its own identity, and a thin one is
// nearly its own mirror image from front to back: agreement is evidence only where points are moved. To move all of
// them proves no more than to move most, as a reflection does; or an animal would be mirrored head to tail.
double disagreement(const Surface& surface, const Survey& survey, const RefinedLandmarks& landmarks) {
  constexpr float kCap = 0.01f;  // what is lost or added on one side says nothing of the rest
  constexpr double kDescriptors = 0.15, kPlainlyMoved = 0.75;
  const Sites& sites = survey.sites;
  const Probes probes = match_probes(surface, landmarks, survey.from, survey.curvature, sites.vertex, survey.refine);
  double error = 0, moved = 0, unlike = 0;
  for (int k = 0; k < sites.count(); ++k) {
    error += std::min(kCap, probes.error[k]);
    const int partner = probes.partner[k];
    const double d2 = std::pow(sites.field(k, partner) / surface.unit(), 2);
    moved += d2 / (d2 + kMoved2);
    const auto difference = sites.descriptor.row(k) - sites.descriptor.row(survey.nearest_site[partner]);
    unlike += difference.array().square().min(1.f).mean();
  }
  error /= sites.count(), moved /= sites.count(), unlike /= sites.count();
  return (std::sqrt(error) + kDescriptors * unlike * unlike) / std::pow(std::min(kPlainlyMoved, moved), 1.25);
}

bool same_symmetry(const Surface& surface, const Survey& survey, const Candidate& a, const Candidate& b) {
  constexpr double kSame = 0.1;  // mean distance of their images, in units
  double apart = 0;
  for (int i = 0; i < survey.sites.samples; ++i)
    apart += survey.sites.field(survey.nearest_site[a.refined.landmarks.to[i]], b.refined.landmarks.to[i]);
  return apart < kSame * surface.unit() * survey.sites.samples;
}

// The maps that survived the search, best first; the best `count` of them at vertex resolution, and only those.
std::vector<Candidate> rank_survivors(const Surface& surface, const GeodesicSolver& solver, const Survey& survey,
                                      const std::vector<SampleMap>& maps, int count, int threads,
                                      const Context& context) {
  const DistanceFields images = anchor_fields(solver, survey.anchors, &Anchor::image, threads);
  struct Survivor {
    const SampleMap* map;
    double score;
  };
  std::vector<Survivor> survivors(maps.size());
  parallel_for(static_cast<int>(maps.size()), threads, [&](int i, int) {
    const RefinedLandmarks landmarks = make_landmarks(survey.sites, maps[i], survey.anchors, images);
    survivors[i] = {&maps[i], disagreement(surface, survey, landmarks)};
  });
  const auto by_score = [](const auto& a, const auto& b) { return a.score < b.score; };
  std::stable_sort(survivors.begin(), survivors.end(), by_score);
  survivors.resize(std::min<std::size_t>(count, survivors.size()));
  std::vector<Candidate> refined, out;
  for (const Survivor& s : survivors) {
    context.advance(static_cast<double>(refined.size()) / static_cast<double>(survivors.size()));
    Candidate c;
    c.refined = make_landmarks(survey.sites, *s.map, survey.anchors, images);
    c.order = survey.refine.reflection ? 2 : order_of(survey.sites, *s.map);
    c.score = s.score;
    if (count == kAll || s.score < kClose * survivors[0].score) {
      c.refined = refine_landmarks(surface, solver, std::move(c.refined), survey.from, survey.curvature, survey.refine,
                                   threads, context);
      c.score = disagreement(surface, survey, c.refined);
    }
    refined.push_back(std::move(c));
  }
  std::stable_sort(refined.begin(), refined.end(), by_score);
  for (Candidate& c : refined)
    if (std::none_of(out.begin(), out.end(),
                     [&](const Candidate& better) { return same_symmetry(surface, survey, better, c); }))
      out.push_back(std::move(c));
  return out;
}

// Searches, and ranks what survives. The ranking is empty if nothing does.
Survey survey_symmetries(const Surface& surface, const GeodesicSolver& solver, HeatDiffusion& diffusion,
                         const References& references, const Options& options, int count, Random& random,
                         const Context& context, StageClock& clock) {
  Survey out;
  context.report(0.02, "distances");
  out.shortcuts = std::make_unique<Shortcuts>(surface, solver, options.threads, context.part(0.02, 0.1, "distances"));
  out.sites = make_sites(surface, solver, options.joint.samples, options.joint.sites, kNeighbors, options.threads,
                         *out.shortcuts, context.part(surface.closed ? 0.02 : 0.1, 0.4, "distances"));
  clock.stage_done("distances");
  context.report(0.4, "search");
  const Sites& sites = out.sites;
  out.anchors = make_anchors(references, options.symmetry);
  const JointProblem problem(sites, surface, solver, options.symmetry, out.anchors, options.joint);
  JointResult search = search_joint(problem, options.joint, random, options.threads, context.part(0.4, 0.6));
  clock.stage_done("search");
  out.log = std::move(search.log);
  out.stop = search.stop;

  context.report(0.6, "refinement");
  const int anchors = static_cast<int>(out.anchors.size());
  out.nearest_site = nearest_sites(sites);
  out.from.resize(sites.samples + anchors, surface.vertices());
  out.from.topRows(sites.samples) = sites.field.topRows(sites.samples);
  out.from.bottomRows(anchors) = anchor_fields(solver, out.anchors, &Anchor::vertex, options.threads);
  out.refine.fixed = anchors;
  out.refine.shortcuts = out.shortcuts.get();
  out.refine.reflection = options.symmetry == SymmetryKind::reflection;
  out.curvature = curvature_features(surface, diffusion);
  out.ranking =
      rank_survivors(surface, solver, out, search.maps, count, options.threads, context.part(0.65, 0.7, "refinement"));
  return out;
}

Found find_jointly(const Surface& surface, const References& references, const Options& options, Random& random,
                   const Context& context, StageClock& clock, Result& result) {
  const GeodesicSolver solver(surface);
  HeatDiffusion diffusion(surface);
  Survey survey = survey_symmetries(surface, solver, diffusion, references, options,
                                    options.rank == 1 ? kCompared : kAll, random, context, clock);
  result.log = std::move(survey.log);
  result.stop = survey.stop;
  const std::vector<Candidate>& ranking = survey.ranking;
  if (ranking.empty()) throw InvalidMesh(kNoSymmetry);
  if (options.rank > static_cast<int>(ranking.size()))
    throw InvalidOption("rank must be at most " + std::to_string(ranking.size()) +
                        ", the number of symmetries found, got " + std::to_string(options.rank));
  for (const Candidate& c : ranking)
    result.symmetries.push_back({options.symmetry, c.order, static_cast<int>(result.symmetries.size()) + 1, c.score});
  if (ranking.size() > 1) result.confidence = 1 - ranking[0].score / ranking[1].score;
  if (survey.anchors.empty() && options.rank == 1 && result.confidence < kDoubtful)
    result.warnings.push_back("two symmetries fit almost equally well (confidence " +
                              std::to_string(result.confidence).substr(0, 4) +
                              "): look at the result; for the other give references or take rank 2");
  result.order = ranking[options.rank - 1].order;
  RefinedLandmarks refined = std::move(survey.ranking[options.rank - 1].refined);
  const bool reflection = survey.refine.reflection;
  const DistanceFields& from = survey.from;
  if (options.local_refinement) {
    refined = adjust_landmarks(surface, solver, std::move(refined), from, survey.curvature, survey.refine,
                               options.threads, context.part(0.7, 0.75, "refinement"));
    survey.refine.curvature = kAdjustCurvature;
    refined = adjust_landmarks(surface, solver, std::move(refined), from, survey.curvature, survey.refine,
                               options.threads, context.part(0.75, 0.8, "refinement"));
  }
  clock.stage_done("refinement");

  context.report(0.8, "dense map");
  DenseMapOptions dense;
  dense.reflection = reflection;
  dense.noise_filter = options.noise_filter;
  DenseMap map = make_dense_map(surface, refined, from, survey.curvature, dense, options.threads,
                                context.part(0.8, 0.95, "dense map"));
  clock.stage_done("dense map");

  context.report(0.95, "axis");
  Found found;
  found.fitness = vertex_fitness(surface, map, from, reflection, diffusion);
  if (reflection) {
    int left = -1;  // the user's own pair says which side is left
    if (!references.pairs.empty()) left = survey.sites.samples + static_cast<int>(references.axis.size());
    found.left = left_right_function(surface, refined.landmarks, from, refined.to_field, left);
  }
  for (int i = 0; i < survey.sites.samples; ++i) {
    const int v = refined.landmarks.from[i];
    result.pairs.push_back({v, map.partner[v], found.fitness[v]});
  }
  found.partner = std::move(map.partner);
  found.point = std::move(map.point);
  return found;
}

// What was found on the proxy, at every vertex of the surface.
Found carry(const Surface& surface, const Proxy& proxy, const Found& small, int threads, const Context& context,
            Result& result) {
  Found out;
  CarriedMap map = carry_to(surface, proxy, small.point, threads, context);
  out.partner = std::move(map.partner);
  out.point = std::move(map.point);
  out.fitness = interpolate(proxy, small.fitness);
  if (!small.left.empty()) out.left = interpolate(proxy, small.left);
  for (SymmetricPair& pair : result.pairs) {
    pair.vertex = proxy.vertex[pair.vertex];
    pair.partner = out.partner[pair.vertex];
  }
  return out;
}

References on_proxy(const References& references, const Proxy& proxy) {
  References out;
  for (int a : references.axis) out.axis.push_back(proxy.nearest(a));
  for (const auto& [l, r] : references.pairs) out.pairs.push_back({proxy.nearest(l), proxy.nearest(r)});
  return out;
}

// Empty where the surface is small enough, or cannot be simplified.
std::optional<Proxy> proxy_of(const Surface& surface, const Options& options, const Context& context, StageClock& clock,
                              std::vector<std::string>& warnings) {
  std::optional<Proxy> proxy;
  if (options.proxy == 0 || surface.vertices() <= kWorthProxy * options.proxy) return proxy;
  try {
    proxy = make_proxy(surface, options.proxy, context);
  } catch (const InvalidMesh&) {
    warnings.push_back("the mesh could not be simplified, so all its vertices were searched: that takes long");
  }
  clock.stage_done("proxy");
  return proxy;
}

}  // namespace

std::vector<FoundSymmetry> list_symmetries(const TriangleMesh& mesh, Options options, const Context& context) {
  constexpr double kWorthListing = 2;  // times the best score: what is worse is no symmetry
  options.method = Method::joint;
  check_options(options);
  context.report(0, "checking the mesh");
  std::vector<StageTime> seconds;
  std::vector<std::string> warnings;
  StageClock clock(seconds);
  const Surface surface = make_surface(mesh, options.largest_component, context.part(0, 0.05));
  const References references = on_surface(options.references, surface);
  const std::optional<Proxy> proxy = proxy_of(surface, options, context.part(0.05, 0.2), clock, warnings);
  const Surface& searched = proxy ? proxy->surface : surface;
  const GeodesicSolver solver(searched);
  HeatDiffusion diffusion(searched);
  std::vector<FoundSymmetry> out;
  for (SymmetryKind kind : {SymmetryKind::reflection, SymmetryKind::rotation}) {
    options.symmetry = kind;
    Random random(options.seed);
    const double begin = kind == SymmetryKind::reflection ? 0.2 : 0.6;
    const Survey survey =
        survey_symmetries(searched, solver, diffusion, proxy ? on_proxy(references, *proxy) : references, options, kAll,
                          random, context.part(begin, begin + 0.4), clock);
    int rank = 0;
    for (const Candidate& c : survey.ranking) out.push_back({kind, c.order, ++rank, c.score});
  }
  if (out.empty()) throw InvalidMesh(kNoSymmetry);
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.score < b.score; });
  const double most = kWorthListing * out[0].score;
  out.erase(std::remove_if(out.begin(), out.end(), [&](const auto& f) { return f.score > most; }), out.end());
  return out;
}

Result find_symmetry(const TriangleMesh& mesh, const Options& options, const Context& context) {
  check_options(options);
  context.report(0, "checking the mesh");
  Result result;
  StageClock clock(result.seconds);
  const Surface surface = make_surface(mesh, options.largest_component, context);
  const References references = on_surface(options.references, surface);
  result.kind = options.symmetry;
  result.seed = options.seed;
  result.axis_references = options.references.axis;
  result.pair_references = options.references.pairs;
  result.warnings = surface.warnings;
  for (const IdleOption& idle : idle_options(options))
    if (idle.changed) result.warnings.push_back(idle.name + " does nothing " + idle.why);
  clock.stage_done("surface");
  Random random(options.seed);
  Found found;
  const std::optional<Proxy> proxy = options.method == Method::joint
                                         ? proxy_of(surface, options, context.part(0, 0.3), clock, result.warnings)
                                         : std::nullopt;
  if (options.method == Method::pairs) {
    found = find_by_pairs(surface, references, options, random, context, clock, result);
  } else if (!proxy) {
    found = find_jointly(surface, references, options, random, context, clock, result);
  } else {
    const Found small = find_jointly(proxy->surface, on_proxy(references, *proxy), options, random,
                                     context.part(0.3, 0.8), clock, result);
    context.report(0.8, "all vertices");
    found = carry(surface, *proxy, small, options.threads, context.part(0.8, 0.95), result);
    clock.stage_done("all vertices");
  }
  context.report(0.95, "axis");
  if (!found.left.empty()) connect_sides(surface, found.left);
  if (found.side.empty())
    found.side = found.left.empty() ? std::vector<int>(surface.vertices(), 0) : sides(surface, found.left);
  if (!found.left.empty()) found.axis = zero_set(surface, found.left, kShortestAxis);
  clock.stage_done("axis");
  finish(surface, std::move(found), options.max_fitness, result);
  context.report(1, "done");
  return result;
}

}  // namespace ga_symmetry
