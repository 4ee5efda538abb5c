#include "search/joint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <set>
#include <string>

#include "ga_symmetry/evaluation.h"
#include "ga_symmetry/io.h"
#include "ga_symmetry/symmetry.h"
#include "symmetric_shapes.h"

namespace ga_symmetry {
namespace {

// One bent, renumbered creature with its tables, for all tests here: they only read it.
struct Scene {
  shapes::Symmetric shape = shapes::shuffled(shapes::bent(shapes::creature(3), 0.1), 7);
  Surface surface = make_surface(shape.mesh);
  GeodesicSolver solver{surface};
  Sites sites = make_sites(surface, solver, 40, 120, 6, 1);
};
const Scene& scene() {
  static const Scene s;
  return s;
}

JointProblem problem(const JointOptions& options, const References& references = {}) {
  const Scene& s = scene();
  return JointProblem(s.sites, s.surface, s.solver, SymmetryKind::reflection,
                      make_anchors(references, SymmetryKind::reflection), options);
}

SampleMap random_map(std::uint64_t seed) {
  Random random(seed);
  SampleMap map(scene().sites.samples);
  for (int& site : map) site = static_cast<int>(draw_below(random, scene().sites.count()));
  return map;
}

References references_of(const shapes::Symmetric& shape) {
  References r;
  r.axis = {shape.axis[0], shape.axis[1]};
  r.pairs = {{shape.pair[0], shape.pair[1]}};
  return r;
}

double mean_error(const TriangleMesh& mesh, const std::vector<int>& truth, const std::vector<int>& partner) {
  const Surface surface = make_surface(mesh);
  const GeodesicSolver solver(surface);
  double sum = 0;
  int count = 0;
  for (int v = 0; v < surface.vertices(); v += 7, ++count) {
    if (partner[v] < 0) return 1;
    const DistanceFields field = solver.fields({truth[v]}, 1);
    sum += field(0, partner[v]) / surface.unit();
  }
  return sum / count;
}

TEST(Anchors, AReflectionTakesAPairBothWays) {
  References r;
  r.axis = {5};
  r.pairs = {{1, 2}};
  const auto both = make_anchors(r, SymmetryKind::reflection);
  ASSERT_EQ(both.size(), 3u);
  EXPECT_EQ(both[0].image, 5);
  EXPECT_EQ(both[2].vertex, 2);
  EXPECT_EQ(both[2].image, 1);
  EXPECT_EQ(make_anchors(r, SymmetryKind::rotation).size(), 2u);
}

TEST(Directions, AnglesBetweenSourcesAreThoseOfThePlane) {
  const Surface s = make_surface(shapes::grid(41, 41));
  const GeodesicSolver solver(s);
  const std::vector<int> sources{41 * 5 + 5, 41 * 5 + 35, 41 * 33 + 22};
  const int center = 41 * 20 + 20;
  const auto [cosine, sine] = directions(s, {center}, solver.fields(sources, 1), 1);
  const auto angle = [&](int j) {
    const double x = s.point(sources[j])[0] - s.point(center)[0], y = s.point(sources[j])[1] - s.point(center)[1];
    return std::atan2(y, x);
  };
  for (int j = 1; j < 3; ++j) {
    const double found = std::atan2(sine(0, j), cosine(0, j)) - std::atan2(sine(0, 0), cosine(0, 0));
    EXPECT_GT(std::cos(found - (angle(j) - angle(0))), std::cos(0.06));
  }
}

TEST(Sites, TablesAreConsistent) {
  const Sites& s = scene().sites;
  EXPECT_EQ(s.count(), 120);
  EXPECT_TRUE(s.distance == s.distance.transpose());
  for (int i = 0; i < s.samples; ++i) {
    EXPECT_EQ(s.nearest_sample[i], i);
    for (std::size_t k = 1; k < s.neighbors[i].size(); ++k)
      EXPECT_LE(s.distance(i, s.neighbors[i][k - 1]), s.distance(i, s.neighbors[i][k]));
  }
  for (int k = 0; k < s.count(); ++k)
    for (int j = 0; j < s.count(); ++j) EXPECT_NEAR(std::hypot(s.cosine(k, j), s.sine(k, j)), k == j ? 0 : 1, 1e-4);
}

TEST(JointCost, TheIdentityKeepsDistancesButNotOrientation) {
  const JointProblem p = problem({});
  SampleMap identity(scene().sites.samples);
  for (std::size_t i = 0; i < identity.size(); ++i) identity[i] = static_cast<int>(i);
  const CostTerms t = p.terms(identity);
  EXPECT_EQ(t.distance, 0);
  EXPECT_EQ(t.continuity, 0);
  EXPECT_EQ(t.bijectivity, 0);
  EXPECT_GT(t.orientation, 0.3);
  EXPECT_EQ(p.moved(identity), 0);
  JointOptions o;
  o.orientation_weight = 0;
  EXPECT_TRUE(std::isinf(problem(o).evaluate(identity, 0))) << "the identity is no symmetry";
}

TEST(JointCost, IsTheWeightedSumOfItsTerms) {
  JointOptions o;
  o.distance_weight = 2, o.orientation_weight = 3, o.continuity_weight = 5, o.bijectivity_weight = 7;
  const CostTerms t{0.1, 0.2, 0.3, 0.4, 0.5};
  EXPECT_DOUBLE_EQ(problem(o).total(t), 0.2 + 0.6 + 1.5 + 0.4 + 3.5);
}

TEST(JointCost, ReferencesPullTheirSamplesToTheirImages) {
  JointOptions with, without;
  without.reference_weight = 0;
  const References r = references_of(scene().shape);
  const SampleMap map = random_map(3);
  EXPECT_GT(problem(with, r).terms(map).unary, problem(without, r).terms(map).unary);
}

TEST(BestResponse, NeverRaisesTheDistanceCost) {
  JointOptions o;
  o.orientation_weight = o.continuity_weight = o.descriptor_weight = o.bijectivity_weight = 0;
  const JointProblem p = problem(o);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SampleMap map = random_map(seed);
    for (int sweep = 0; sweep < 4; ++sweep) {
      const double before = p.cost(map);
      const int changed = p.best_response(map, 0.25f);
      EXPECT_LE(p.cost(map), before + 1e-7);
      if (!changed) break;
    }
  }
}

TEST(BestResponse, MovesNoFartherThanItsRadius) {
  const JointProblem p = problem({});
  const SampleMap before = random_map(9);
  SampleMap after = before;
  p.best_response(after, 0.1f);
  EXPECT_NE(after, before);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_LE(scene().sites.distance(before[i], after[i]), 0.1f);
}

TEST(RelocateOutliers, BringsBackAStrayGeneFromAnywhere) {
  const Sites& s = scene().sites;
  JointOptions o;
  o.orientation_weight = 0;  // so that the identity fits
  const JointProblem p = problem(o);
  SampleMap identity(s.samples);
  for (int i = 0; i < s.samples; ++i) identity[i] = i;
  Eigen::Index far;
  s.distance.row(7).maxCoeff(&far);
  SampleMap map = identity;
  map[7] = static_cast<int>(far);
  EXPECT_GE(p.relocate_outliers(map), 1);
  EXPECT_LT(s.distance(map[7], 7), 0.25f);
}

TEST(RuinAndRecreate, ARegionComesBackFromWhatIsLeft) {
  const Sites& s = scene().sites;
  JointOptions o;
  o.orientation_weight = 0;  // so that the identity fits
  const JointProblem p = problem(o);
  SampleMap map(s.samples);
  for (int i = 0; i < s.samples; ++i) map[i] = s.distance(i, 7) < 0.3f ? -1 : i;
  const auto lost = std::count(map.begin(), map.end(), -1);
  ASSERT_GT(lost, 3);
  p.recreate(map);
  double off = 0;
  for (int i = 0; i < s.samples; ++i) {
    ASSERT_GE(map[i], 0);
    off += s.distance(map[i], i) / static_cast<double>(lost);
  }
  EXPECT_LT(off, 0.2);
}

TEST(RuinAndRecreate, AWholeMapIsLeftAlone) {
  const JointProblem p = problem({});
  SampleMap map = random_map(4);
  const SampleMap before = map;
  p.recreate(map);
  EXPECT_EQ(map, before);
}

TEST(Variation, RuinLeavesHalfOfTheGenes) {
  JointOptions o;
  o.ruin_probability = 1;
  o.mutation_probability = 0;
  const JointProblem p = problem(o);
  Population<SampleMap> parents;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) parents.push_back({random_map(seed), 1.0, true});
  Random random(5);
  const auto children = p.vary(parents, z_scores(costs_of(parents)), random);
  ASSERT_FALSE(children.empty());
  for (const auto& child : children) {
    const auto lost = std::count(child.genome.begin(), child.genome.end(), -1);
    EXPECT_GT(lost, 0);
    EXPECT_LE(lost, scene().sites.samples / 2);
  }
}

TEST(Variation, ChildrenAreMadeOfTheirParents) {
  JointOptions o;
  o.mutation_probability = o.ruin_probability = 0;
  const JointProblem p = problem(o);
  Population<SampleMap> parents;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) parents.push_back({random_map(seed), 1.0 * seed, true});
  Random random(5);
  const auto children = p.vary(parents, z_scores(costs_of(parents)), random);
  ASSERT_FALSE(children.empty());
  for (const auto& child : children)
    for (std::size_t i = 0; i < child.genome.size(); ++i)
      EXPECT_TRUE(std::any_of(parents.begin(), parents.end(),
                              [&](const auto& parent) { return parent.genome[i] == child.genome[i]; }));
}

TEST(Variation, MutationReachesEverySite) {
  JointOptions o;
  o.mutation_probability = 1;
  const JointProblem p = problem(o);
  Population<SampleMap> parents;
  for (int i = 0; i < 100; ++i) parents.push_back({random_map(1), 1.0, true});
  Random random(5);
  std::set<int> seen;
  for (const auto& child : p.vary(parents, z_scores(costs_of(parents)), random))
    for (int site : child.genome) seen.insert(site);
  EXPECT_EQ(static_cast<int>(seen.size()), scene().sites.count());
}

TEST(RegionStep, GoesToTheRegionOfTheReferencesDistanceAndStays) {
  const Sites& s = scene().sites;
  const JointProblem p = problem({});
  constexpr int kSample = 7, kReference = 3, kRegions = 5;
  const auto rank = [&](float distance) {
    int nearer = 0;
    for (int k = 0; k < s.count(); ++k) nearer += s.distance(kReference, k) < distance;
    return nearer;
  };
  const auto region = [&](int site) { return rank(s.distance(kReference, site)) * kRegions / s.count(); };
  const int wanted = region(kSample);
  SampleMap map(s.samples);
  for (int i = 0; i < s.samples; ++i) map[i] = i;
  Random random(2);
  std::set<int> seen;
  for (int start = 0; start < s.count(); ++start) {
    map[kSample] = start;
    for (int step = 0; step < kRegions; ++step) {
      const int before = std::abs(region(map[kSample]) - wanted);
      map[kSample] = p.region_step(map, kSample, kReference, random);
      EXPECT_EQ(std::abs(region(map[kSample]) - wanted), std::max(0, before - 1));
    }
    seen.insert(map[kSample]);
  }
  EXPECT_GT(seen.size(), 10U) << "any site of the region may be drawn";
}

TEST(Coarsened, IsTheSameProblemOverTheFirstSites) {
  const Sites& fine = scene().sites;
  const Sites coarse = coarsened(fine, 15, 40);
  EXPECT_EQ(coarse.samples, 15);
  ASSERT_EQ(coarse.count(), 40);
  EXPECT_TRUE(coarse.distance == fine.distance.topLeftCorner(40, 40));
  const JointProblem p = problem({}), few(p, coarse);
  SampleMap map(15), more(fine.samples);
  for (int i = 0; i < 15; ++i) map[i] = 39 - i;
  EXPECT_NEAR(few.cost(map), few.total(few.terms(map)), 1e-12);
  for (int i = 0; i < 15; ++i) {
    EXPECT_LT(coarse.nearest_sample[map[i]], 15);
    for (int j : coarse.neighbors[i]) EXPECT_LT(j, 15);
  }
  const Sites all = coarsened(fine, fine.samples, fine.count());
  for (int i = 0; i < fine.samples; ++i) more[i] = (7 * i) % fine.count();
  EXPECT_EQ(JointProblem(p, all).cost(more), p.cost(more));
}

TEST(BestResponse, LaterSweepsGoOnFromTheFirst) {
  JointOptions o;
  o.orientation_weight = o.continuity_weight = o.descriptor_weight = o.bijectivity_weight = 0;
  const JointProblem p = problem(o);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SampleMap once = random_map(seed), often = once;
    p.best_response(once, 0.25f);
    p.best_response(often, 0.25f, 6);
    EXPECT_LT(p.cost(often), p.cost(once));
  }
}

TEST(Score, TheIdentityIsNoSymmetry) {
  const Sites& s = scene().sites;
  const JointProblem p = problem({});
  SampleMap identity(s.samples);
  for (int i = 0; i < s.samples; ++i) identity[i] = i;
  EXPECT_TRUE(std::isinf(p.score(identity)));
  EXPECT_GE(p.score(random_map(1)), p.cost(random_map(1)));
}

TEST(Replacement, AChildCompetesWithTheOneMostLikeIt) {
  const JointProblem p = problem({});
  const SampleMap a = random_map(1), b = random_map(2);
  SampleMap like_b = b;
  like_b[0] = like_b[0] == 0 ? 1 : 0;
  const auto worse = p.replace({{a, 3, true}, {b, 1, true}}, {{like_b, 2, true}});
  EXPECT_EQ(worse[0].genome, a) << "the worst stays: it is another niche";
  EXPECT_EQ(worse[1].genome, b);
  const auto better = p.replace({{a, 3, true}, {b, 1, true}}, {{like_b, 0.5, true}});
  EXPECT_EQ(better[0].genome, a);
  EXPECT_EQ(better[1].genome, like_b);
}

TEST(SearchJoint, BestCostNeverRisesAndTheSeedDecides) {
  JointOptions o;
  o.max_generations = 8;
  const JointProblem p = problem(o, references_of(scene().shape));
  Random first(3), second(3);
  const JointResult a = search_joint(p, o, first, 1), b = search_joint(p, o, second, 4);
  EXPECT_EQ(a.maps, b.maps);
  for (std::size_t g = 1; g < a.log.size(); ++g) EXPECT_LE(a.log[g].best, a.log[g - 1].best);
  for (std::size_t i = 1; i < a.costs.size(); ++i) EXPECT_LE(a.costs[i - 1], a.costs[i]);
}

class FindJointly : public testing::Test {
 protected:
  shapes::Symmetric shape_ = shapes::shuffled(shapes::bent(shapes::creature(4), 0.1), 3);
};

// Edges of this creature are about 0.04 units long.
TEST_F(FindJointly, TruthByConstructionWithReferences) {
  Options o;
  o.references = references_of(shape_);
  const Result r = find_symmetry(shape_.mesh, o);
  EXPECT_LT(mean_error(shape_.mesh, shape_.partner, r.partner), 0.04);
  EXPECT_EQ(r.matched, shape_.mesh.vertices());
  EXPECT_EQ(r.side[shape_.pair[0]], 1) << "l is on the left";
  EXPECT_EQ(r.side[shape_.pair[1]], -1);
  ASSERT_FALSE(r.axis.empty());
  EXPECT_EQ(r.axis[0].front().vertex, r.axis[0].back().vertex) << "the axis of a closed surface is closed";
}

TEST_F(FindJointly, TruthByConstructionWithoutReferences) {
  const Result r = find_symmetry(shape_.mesh);
  EXPECT_LT(mean_error(shape_.mesh, shape_.partner, r.partner), 0.04);
}

TEST_F(FindJointly, ThreadsChangeNothing) {
  Options one, four;
  one.threads = 1, four.threads = 4;
  one.joint.max_generations = four.joint.max_generations = 3;
  const Result a = find_symmetry(shape_.mesh, one), b = find_symmetry(shape_.mesh, four);
  EXPECT_EQ(a.partner, b.partner);
  EXPECT_EQ(a.fitness, b.fitness);
  EXPECT_EQ(a.side, b.side);
}

TEST_F(FindJointly, PoseAndScaleOfTheWholeChangeNothing) {
  const TriangleMesh moved = shapes::moved(shape_.mesh, 1e6);
  const Result r = find_symmetry(moved);
  EXPECT_LT(mean_error(shape_.mesh, shape_.partner, r.partner), 0.04);
}

TEST_F(FindJointly, StopsWhenAskedTo) {
  std::atomic<bool> cancel{false};
  Context context;
  context.cancel = &cancel;
  double last = -1;
  context.progress = [&](double fraction, const char*) {
    EXPECT_GE(fraction, last);
    last = fraction;
    if (fraction > 0.3) cancel = true;
  };
  EXPECT_THROW(find_symmetry(shape_.mesh, {}, context), Cancelled);
}

TEST_F(FindJointly, RefinementAndNoiseFilterBringPartnersNearer) {
  Options o;
  o.references = references_of(shape_);
  o.local_refinement = o.noise_filter = false;
  const double neither = mean_error(shape_.mesh, shape_.partner, find_symmetry(shape_.mesh, o).partner);
  o.local_refinement = true;
  const double refined = mean_error(shape_.mesh, shape_.partner, find_symmetry(shape_.mesh, o).partner);
  o.noise_filter = true;
  const double both = mean_error(shape_.mesh, shape_.partner, find_symmetry(shape_.mesh, o).partner);
  EXPECT_LT(both, neither);
  EXPECT_LT(refined, neither);
  EXPECT_LT(both, 1.02 * refined);
}

TEST_F(FindJointly, AboveTheLargestFitnessThereIsNoPartner) {
  Options o;
  o.references = references_of(shape_);
  const Result all = find_symmetry(shape_.mesh, o);
  o.max_fitness = all.mean_fitness;
  const Result some = find_symmetry(shape_.mesh, o);
  const double worst = *std::max_element(all.fitness.begin(), all.fitness.end());
  int matched = 0;
  for (int v = 0; v < shape_.mesh.vertices(); ++v) {
    const bool kept = all.fitness[v] <= o.max_fitness;
    matched += kept;
    EXPECT_EQ(some.partner[v], kept ? all.partner[v] : -1);
    EXPECT_EQ(some.fitness[v], kept ? all.fitness[v] : worst);
    EXPECT_EQ(some.partner_point[v].vertex[0] < 0, !kept);
  }
  EXPECT_EQ(some.matched, matched);
  EXPECT_GT(matched, 0);
  EXPECT_LT(matched, shape_.mesh.vertices());
  for (const SymmetricPair& pair : some.pairs) EXPECT_GE(some.partner[pair.vertex], 0);
  EXPECT_LT(some.pairs.size(), all.pairs.size());
}

TEST_F(FindJointly, ARankBeyondWhatIsFoundIsNamed) {
  Options o;
  o.rank = 30;
  o.joint.population = 4;  // hence at most as many survivors
  try {
    find_symmetry(shape_.mesh, o);
    FAIL();
  } catch (const InvalidOption& e) {
    EXPECT_NE(std::string(e.what()).find("rank must be at most "), std::string::npos) << e.what();
  }
}

TEST(FindRotation, ThePinwheelTurnsByAThird) {
  const std::string base = std::string(GA_SYMMETRY_SAMPLE_MESHES) + "/pinwheel_bend";
  const TriangleMesh mesh = read_mesh(base + ".off");
  std::ifstream in(base + ".refs");
  int a0, a1, l, r;
  ASSERT_TRUE(in >> a0 >> a1 >> l >> r);
  Options o;
  o.symmetry = SymmetryKind::rotation;
  o.references.axis = {a0, a1};
  o.references.pairs = {{l, r}};
  const Result result = find_symmetry(mesh, o);
  EXPECT_EQ(result.order, 3);
  const Evaluation e = evaluate_partners(mesh, read_truth(base + ".truth"), result.partner);
  EXPECT_LT(e.mean, 0.05);
}

// A missing hand, a hole and a hump: all other vertices keep their partners, and these stand out by their fitness.
TEST(BrokenSymmetry, DisturbsOnlyWhatIsAffected) {
  for (const char* broken : {"no_hand", "hole", "hump"}) {
    SCOPED_TRACE(broken);
    const std::string base = std::string(GA_SYMMETRY_SAMPLE_MESHES) + "/person_wave_" + broken;
    const TriangleMesh mesh = read_mesh(base + ".off");
    std::ifstream refs(base + ".refs"), list(base + ".affected");
    Options o;
    o.references.axis.resize(2), o.references.pairs.resize(1);
    ASSERT_TRUE(refs >> o.references.axis[0] >> o.references.axis[1] >> o.references.pairs[0][0] >>
                o.references.pairs[0][1]);
    const Result result = find_symmetry(mesh, o);
    const Evaluation e = evaluate_partners(mesh, read_truth(base + ".truth"), result.partner);
    EXPECT_GT(e.corr, 0.98);
    EXPECT_LT(e.mean, 0.04);
    std::vector<char> affected(mesh.vertices(), 0);
    for (int v; list >> v;) affected[v] = 1;
    std::vector<double> there, elsewhere;
    for (int v = 0; v < mesh.vertices(); ++v) (affected[v] ? there : elsewhere).push_back(result.fitness[v]);
    ASSERT_FALSE(there.empty());
    // The chance that an affected vertex has a higher fitness than another one.
    std::sort(elsewhere.begin(), elsewhere.end());
    double lower = 0;
    for (double f : there)
      lower += static_cast<double>(std::lower_bound(elsewhere.begin(), elsewhere.end(), f) - elsewhere.begin());
    EXPECT_GT(lower / static_cast<double>(there.size() * elsewhere.size()), 0.9);
  }
}

// A second map, which takes each arm to itself, fits nearly as well.
TEST(BrokenSymmetry, WithoutReferencesTheStumpIsTakenToTheHandsArm) {
  const std::string base = std::string(GA_SYMMETRY_SAMPLE_MESHES) + "/person_wave_no_hand";
  const TriangleMesh mesh = read_mesh(base + ".off");
  const Evaluation e = evaluate_partners(mesh, read_truth(base + ".truth"), find_symmetry(mesh).partner);
  EXPECT_GT(e.corr, 0.98);
}

TEST(ListSymmetries, TheTrefoilHasThreeReflectionsAndTwoTurns) {
  const std::string base = std::string(GA_SYMMETRY_SAMPLE_MESHES) + "/trefoil_bend";
  const TriangleMesh mesh = read_mesh(base + ".off");
  const std::vector<FoundSymmetry> found = list_symmetries(mesh);
  ASSERT_GE(found.size(), 5u);
  // Bent, it has them only nearly; the five come first, and what else is listed is not of their kind.
  int reflections = 0, turns = 0;
  for (int i = 0; i < 5; ++i) {
    reflections += found[i].kind == SymmetryKind::reflection;
    turns += found[i].kind == SymmetryKind::rotation && found[i].order == 3;
  }
  EXPECT_EQ(reflections, 3);
  EXPECT_EQ(turns, 2);
  for (std::size_t i = 1; i < found.size(); ++i) EXPECT_LE(found[i - 1].score, found[i].score);
  EXPECT_LE(found.back().score, 2 * found[0].score);
  // The n-th listed reflection is what rank n finds: three different ones of the truth.
  std::ifstream in(base + ".mirrors");
  std::vector<std::vector<int>> mirrors(3, std::vector<int>(mesh.vertices()));
  for (int v, line = 0; line < mesh.vertices(); ++line) {
    in >> v;
    for (auto& mirror : mirrors) in >> mirror[v];
  }
  ASSERT_TRUE(in);
  std::set<int> seen;
  for (int rank = 1; rank <= 3; ++rank) {
    Options o;
    o.rank = rank;
    const Result r = find_symmetry(mesh, o);
    for (int k = 0; k < 3; ++k)
      if (mean_error(mesh, mirrors[k], r.partner) < 0.1) seen.insert(k);  // the others are 0.6 off
  }
  EXPECT_EQ(seen.size(), 3u);
}

}  // namespace
}  // namespace ga_symmetry
