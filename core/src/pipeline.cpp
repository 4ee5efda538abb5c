// SPDX-License-Identifier: GPL-3.0-or-later
// The steps from a mesh to its result, in order, and nothing else: docs/algorithm.md walks the same way.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "axis/divide.h"
#include "axis/sides.h"
#include "ga_symmetry/option_table.h"
#include "ga_symmetry/symmetry.h"
#include "geodesics/anchors.h"
#include "geodesics/shortcuts.h"
#include "matching/dense_map.h"
#include "matching/fitness.h"
#include "matching/prolongation.h"
#include "matching/ranking.h"
#include "matching/refinement.h"
#include "search/joint.h"
#include "search/pairs.h"
#include "search/sites.h"
#include "surface/curvature.h"
#include "surface/mirror_plane.h"
#include "surface/search_surface.h"
#include "surface_result.h"

namespace ga_symmetry {

const char* to_string(SymmetryKind kind) {
  switch (kind) {
    case SymmetryKind::reflection:
      return "reflection";
    case SymmetryKind::rotation:
      return "rotation";
    case SymmetryKind::any:
      return "any";
  }
  return "";
}

const char* to_string(StopReason reason) {
  switch (reason) {
    case StopReason::success_threshold:
      return "good enough";
    case StopReason::converged:
      return "converged";
    case StopReason::max_generations:
      return "generation limit reached";
  }
  return "";
}

namespace {

// Samples that count as near for orientation and continuity: of evenly spaced ones the ring around, and a few beyond.
constexpr int kNeighbors = 8;
constexpr const char* kNoSymmetry =
    "no symmetry found: give four (other) references, or search for the other kind of symmetry";
constexpr double kDoubtful = 0.7;  // confidence below which the user is told to look: docs/search.md

// Scores: some 0.02 where the pose is symmetric, too, 0.05 to 0.15 in hard poses, seldom more; of wrong maps mostly
// above this. What is searched for in vain costs time alone.
constexpr double kFits = 0.1;
// Before the samples' partners are refined: maps below are as good after five generations as after forty.
constexpr double kFitsPlainly = 0.04;

// Survivors of the lowest cost that the choice looks at, if only the best is wanted and no references tell which it is.
constexpr std::size_t kLookedAt = 12;

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

// What is measured of the searched surface before any symmetry is looked for: distances, candidates, curvature.
struct Measured {
  Measured(const Surface& surface, const Options& options, const Context& context)
      : surface(surface),
        solver(surface),
        fields(solver),
        shortcuts(surface, solver, options.threads, context.part(0, 0.2, "distances")),
        sites(make_sites(surface, solver, {options.joint.samples, options.joint.sites, kNeighbors}, options.threads,
                         shortcuts, context.part(surface.closed ? 0 : 0.2, 1, "distances"))),
        diffusion(surface),
        curvature(curvature_features(surface, diffusion)),
        planes(surface, sites.vertex) {}

  const Surface& surface;
  GeodesicSolver solver;
  FieldCache fields;
  Shortcuts shortcuts;
  Sites sites;
  HeatDiffusion diffusion;
  CurvatureFeatures curvature;
  MirrorPlanes planes;  // that mirror it as it stands
};

// The symmetries of one kind, best first, and what their maps are refined with.
struct Survey {
  Matching matching;
  std::vector<Candidate> ranking;
  std::vector<GenerationLog> log;
  StopReason stop;
};

// The samples, then the references.
Landmarks make_landmarks(const Sites& sites, const Landmarks& references) {
  SampleMap itself;
  for (int i = 0; i < sites.samples; ++i) itself.push_back(i);
  return images_of(itself, sites, references);
}

// @param kind      not `any`
// @param hopeless  score: where all maps are above, the search ends without any
Survey survey_kind(const Measured& measured, const SurfaceReferences& references, SymmetryKind kind,
                   const Options& options, Refine refine, double hopeless, const Context& context, StageClock& clock) {
  const Sites& sites = measured.sites;
  context.report(0, "search");
  const Anchors anchors = make_anchors(references, kind, measured.solver, options.threads);
  std::vector<SampleMap> seeds;
  constexpr int kPlanes = 6;  // more than solids of CAD have that differ
  if (kind == SymmetryKind::reflection)
    for (const MirrorPlane& plane : measured.planes.search(kPlanes, options.threads))
      seeds.push_back(measured.planes.map(plane, sites.samples));
  Survey out{{measured.surface, measured.fields, measured.shortcuts, measured.curvature,
              make_landmarks(sites, anchors.from), anchors.count(), kind == SymmetryKind::reflection, &measured.planes},
             {},
             {},
             {}};
  std::vector<SampleMap> maps;
  const bool given = anchors.count() > 0;
  const auto survey = [&](const Anchors& known, const Context& part) {
    const JointProblem problem(sites, measured.surface, kind, known, options.joint);
    Random random(options.seed);
    bool in_vain = false;
    const auto enough = [&](const std::vector<SampleMap>& best) {
      double least = INFINITY;
      for (const Candidate& c : candidates_of(out.matching, sites, best, anchors.image, options.threads))
        least = std::min(least, c.score);
      in_vain = least > hopeless;
      return in_vain || least < kFitsPlainly;
    };
    JointResult search = search_joint(problem, random, options.threads, part.part(0, 0.8), seeds,
                                      refine == Refine::contenders ? Enough(enough) : Enough());
    clock.stage_done("search");
    part.report(0.8, "refinement");
    out.log = std::move(search.log);
    out.stop = search.stop;
    if (in_vain) return;
    if (refine == Refine::contenders && !given) search.maps.resize(std::min(kLookedAt, search.maps.size()));
    maps.insert(maps.end(), search.maps.begin(), search.maps.end());
    out.ranking =
        rank_maps(out.matching, sites, maps, anchors.image, refine, options.threads, part.part(0.8, 1, "refinement"));
    clock.stage_done("choice");
  };
  // A pose moves references, too: the best map that agrees with them is more often found by a search that minimises
  // the rest alone. Where it finds none that fits, they are a term of what is minimised.
  survey({}, context.part(0, given ? 0.6 : 1));
  const auto fits = [&] {
    return !out.ranking.empty() && out.ranking[0].score <= kFits && out.ranking[0].off_references <= kReferenceSlack;
  };
  if (given && !fits()) survey(anchors, context.part(0.6, 1));
  return out;
}

// The symmetries of the kind that is searched for. Of any kind: reflections, unless none fits and a rotation fits
// plainly better.
std::unique_ptr<Survey> survey_symmetries(const Measured& measured, const SurfaceReferences& references,
                                          const Options& options, Refine refine, const Context& context,
                                          StageClock& clock) {
  constexpr double kPlainlyBetter = 0.5,
                   kRefined = 1.2;  // what refinement of the samples' partners may make of a score
  const auto survey = [&](SymmetryKind kind, double begin, double end, double hopeless = INFINITY) {
    return std::make_unique<Survey>(
        survey_kind(measured, references, kind, options, refine, hopeless, context.part(begin, end), clock));
  };
  const auto score = [](const Survey& s) { return s.ranking.empty() ? INFINITY : s.ranking[0].score; };
  if (options.symmetry != SymmetryKind::any) return survey(options.symmetry, 0, 1);
  const bool given = !references.axis.empty() || !references.pairs.empty();
  auto reflections = survey(SymmetryKind::reflection, 0, given ? 1 : 0.5);
  if (given || score(*reflections) < kFits) return reflections;
  auto rotations = survey(SymmetryKind::rotation, 0.5, 1, kRefined * kPlainlyBetter * score(*reflections));
  return score(*rotations) < kPlainlyBetter * score(*reflections) ? std::move(rotations) : std::move(reflections);
}

// What to tell the user, with the remedy.
std::string why_doubtful(const std::vector<Candidate>& ranking, bool references, bool orientable) {
  constexpr double kAlmost = 1.3;
  if (ranking.size() > 1 && ranking[1].score < kAlmost * ranking[0].score)
    return std::string("two symmetries fit almost equally well; look at the result, for the other ") +
           (references ? "give more references" : "give references or take rank 2");
  if (!orientable) return "the surface has one side only, so that wrong maps are harder to tell; look at the result";
  return std::string("no symmetry fits well, this is the one that fits best; look at the result, and ") +
         (references ? "check the references" : "give references if the shape has one");
}

// All that is done on the searched surface, in its vertices.
SurfaceResult find_jointly(const Surface& surface, const SurfaceReferences& references, const Options& options,
                           const Context& context, StageClock& clock) {
  SurfaceResult out;
  context.report(0.02, "distances");
  Measured measured(surface, options, context.part(0.02, 0.4));
  clock.stage_done("distances");

  const std::unique_ptr<Survey> survey =
      survey_symmetries(measured, references, options, options.rank == 1 ? Refine::contenders : Refine::all,
                        context.part(0.4, 0.7), clock);
  const Matching& matching = survey->matching;
  std::vector<Candidate>& ranking = survey->ranking;
  out.kind = matching.reflection ? SymmetryKind::reflection : SymmetryKind::rotation;
  if (ranking.empty()) throw InvalidMesh(kNoSymmetry);
  if (options.rank > static_cast<int>(ranking.size()))
    throw InvalidOption("rank must be at most " + std::to_string(ranking.size()) +
                        ", the number of symmetries found, got " + std::to_string(options.rank));
  for (const Candidate& c : ranking)
    out.symmetries.push_back({out.kind, c.order, static_cast<int>(out.symmetries.size()) + 1, c.score});
  out.confidence = confidence_of(ranking) * (surface.orientable ? 1 : 0.5);  // orientation tells half of what is wrong
  if (options.rank == 1 && out.confidence < kDoubtful)
    out.warnings.push_back("doubtful, confidence " + std::to_string(out.confidence).substr(0, 4) + ": " +
                           why_doubtful(ranking, matching.fixed > 0, surface.orientable));
  out.order = ranking[options.rank - 1].order;
  out.log = std::move(survey->log);
  out.stop = survey->stop;

  Images images = std::move(ranking[options.rank - 1].images);
  if (options.local_refinement) {
    AdjustOptions adjust;
    images = adjust_images(matching, std::move(images), adjust, options.threads, context.part(0.7, 0.75, "refinement"));
    adjust.curvature = kAdjustCurvature;
    images = adjust_images(matching, std::move(images), adjust, options.threads, context.part(0.75, 0.8, "refinement"));
  }
  clock.stage_done("refinement");

  context.report(0.8, "dense map");
  DenseMap map =
      make_dense_map(matching, images, {options.local_refinement, options.noise_filter, options.spectral_refinement},
                     options.threads, context.part(0.8, 0.95, "dense map"));
  clock.stage_done("dense map");

  context.report(0.95, "axis");
  out.fitness = vertex_fitness(matching, map, measured.diffusion);
  const int samples = measured.sites.samples;
  if (matching.reflection) {
    int left = -1;  // the user's own pair says which side is left
    if (!references.pairs.empty()) {
      const auto first = matching.landmarks.vertex.begin() + samples;
      left = static_cast<int>(std::find(first, matching.landmarks.vertex.end(), references.pairs[0][0]) -
                              matching.landmarks.vertex.begin());
    }
    out.left_right = left_right_function(surface, matching.landmarks, images, left);
  }
  for (int i = 0; i < samples; ++i) {
    const int v = matching.landmarks.vertex[i];
    out.pairs.push_back({v, map.partner[v], out.fitness[v]});
  }
  if (matching.reflection) {
    // The pose is symmetric where the mirrored surface lies on itself, and the map says the same.
    constexpr double kMisfit = 0.02, kAway = 0.1;  // units
    std::vector<SurfacePoint> partners;
    for (const int v : measured.sites.vertex) partners.push_back(map.point[v]);
    const Mirrored mirrored = mirrored_by(matching, measured.sites.vertex, partners);
    if (mirrored.plane.misfit < kMisfit && mirrored.away < kAway) out.mirror = mirrored.plane;
  }
  out.partner = std::move(map.partner);
  out.point = std::move(map.point);
  return out;
}

SurfaceResult find_by_pairs(const Surface& surface, const SurfaceReferences& references, const Options& options,
                            const Context& context, StageClock& clock) {
  const std::array<int, 2> axis{references.axis[0], references.axis[1]};
  Random random(options.seed);
  PairsResult pairs = search_pairs(surface, GeodesicSolver(surface), {axis, references.pairs[0]}, options.pairs, random,
                                   options.threads, context);
  clock.stage_done("search");
  SurfaceResult out;
  for (int v : pairs.partner) out.point.push_back({{v, v, v}, {1, 0, 0}});
  for (int v = 0; v < surface.vertices(); ++v) out.left_right.push_back(pairs.fields(3, v) - pairs.fields(2, v));
  out.symmetries.push_back({SymmetryKind::reflection, 2, 1, pairs.log.empty() ? 0 : pairs.log.back().best});
  out.partner = std::move(pairs.partner);
  out.fitness = std::move(pairs.fitness);
  out.side = std::move(pairs.side);
  out.pairs = std::move(pairs.pairs);
  out.log = std::move(pairs.log);
  out.stop = pairs.stop;
  return out;
}

}  // namespace

Result find_symmetry(const TriangleMesh& mesh, const Options& options, const Context& context) {
  check_options(options);
  std::vector<StageTime> seconds;
  StageClock clock(seconds);
  context.report(0, "checking the mesh");
  Surface of_mesh = make_surface(mesh, options.largest_component, context);
  clock.stage_done("surface");
  const SearchSurface search(std::move(of_mesh), options, context.part(0, 0.2));
  if (!search.direct()) clock.stage_done("search surface");
  const SurfaceReferences references = search.locate(options.references);

  SurfaceResult found = options.method == Method::pairs
                            ? find_by_pairs(search.searched(), references, options, context, clock)
                            : find_jointly(search.searched(), references, options,
                                           search.direct() ? context : context.part(0.2, 0.8), clock);
  const SymmetryKind kind = found.kind;
  // Of a mesh in parts this is the only surface in one piece.
  if (search.parts() > 1 && !found.left_right.empty()) connect_sides(search.searched(), found.left_right);
  if (!search.direct()) {
    context.report(0.8, "all vertices");
    found = prolongate(std::move(found), search, kind == SymmetryKind::reflection, options.threads,
                       context.part(0.8, 0.95));
    clock.stage_done("all vertices");
  } else if (found.mirror) {
    mirror_exactly(found, search.searched(), options.threads, context);
  }

  context.report(0.95, "axis");
  Division division;
  if (!found.left_right.empty()) division = divide(search.of_mesh(), found.left_right, found.partner);
  if (found.side.empty()) found.side = std::move(division.side);
  found.side.resize(search.of_mesh().vertices(), 0);  // a rotation has no sides
  clock.stage_done("axis");

  Result result = to_mesh(std::move(found), std::move(division.axis), search.of_mesh(), options.max_fitness);
  result.surface = search.summary();
  result.kind = kind;
  result.seed = options.seed;
  result.axis_references = options.references.axis;
  result.pair_references = options.references.pairs;
  result.warnings.insert(result.warnings.begin(), search.warnings().begin(), search.warnings().end());
  if (options.largest_component && !search.of_mesh().notes.empty()) result.warnings.push_back(result.surface);
  for (const IdleOption& idle : idle_options(options))
    if (idle.changed) result.warnings.push_back(idle.name + " does nothing " + idle.why);
  result.seconds = std::move(seconds);
  context.report(1, "done");
  return result;
}

std::vector<FoundSymmetry> list_symmetries(const TriangleMesh& mesh, Options options, const Context& context) {
  // Times the best score, but never below what samples alone make of an exact symmetry: what is worse is none.
  constexpr double kWorthListing = 2, kNoise = 0.02;
  options.method = Method::joint;
  check_options(options);
  std::vector<StageTime> seconds;
  StageClock clock(seconds);
  context.report(0, "checking the mesh");
  const SearchSurface search(make_surface(mesh, options.largest_component, context.part(0, 0.05)), options,
                             context.part(0.05, 0.2));
  const SurfaceReferences references = search.locate(options.references);
  const Measured measured(search.searched(), options, context.part(0.2, 0.5));
  std::vector<FoundSymmetry> out;
  for (SymmetryKind kind : {SymmetryKind::reflection, SymmetryKind::rotation}) {
    const double begin = kind == SymmetryKind::reflection ? 0.5 : 0.75;
    const Survey survey = survey_kind(measured, references, kind, options, Refine::all, INFINITY,
                                      context.part(begin, begin + 0.25), clock);
    int rank = 0;
    for (const Candidate& c : survey.ranking) out.push_back({kind, c.order, ++rank, c.score});
  }
  if (out.empty()) throw InvalidMesh(kNoSymmetry);
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.score < b.score; });
  const double most = kWorthListing * std::max(kNoise, out[0].score);
  out.erase(std::remove_if(out.begin(), out.end(), [&](const auto& f) { return f.score > most; }), out.end());
  return out;
}

}  // namespace ga_symmetry
