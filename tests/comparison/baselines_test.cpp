// SPDX-License-Identifier: GPL-3.0-or-later
// What the searches are compared with, each alone; the readers of data sets; the durations.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numeric>

#include "baselines/features.h"
#include "baselines/pair_search.h"
#include "baselines/reversing.h"
#include "baselines/spectral.h"
#include "dataset.h"
#include "durations.h"
#include "ga_symmetry/errors.h"
#include "methods.h"
#include "shapes.h"
#include "symmetric_shapes.h"

namespace ga_symmetry {
namespace {

using namespace baselines;
using comparison::method;
namespace fs = std::filesystem;

std::vector<AxisDistances> random_distances(int count, double zeros, Random& random) {
  std::vector<AxisDistances> out(count);
  for (AxisDistances& d : out)
    for (float& x : d) x = draw_unit(random) < zeros ? 0.f : static_cast<float>(draw_below(random, 50)) / 8;
  return out;
}

TEST(TreeMatches, AreTheNaiveOnesToTheLastBit) {
  Random random(5);
  for (int trial = 0; trial < 40; ++trial) {  // on a coarse grid there are many ties
    const auto references = random_distances(200, 0.05, random);
    const auto candidates = random_distances(1 + static_cast<int>(draw_below(random, 300)), 0.05, random);
    for (PairError error : {PairError::squared, PairError::linear}) {
      const auto naive = naive_matches(references, candidates, error),
                 tree = tree_matches(references, candidates, error);
      for (std::size_t i = 0; i < references.size(); ++i) {
        const double best = pair_fitness(references[i], candidates[naive[i]], error);
        if (std::isfinite(best)) {
          ASSERT_EQ(naive[i], tree[i]) << "trial " << trial << ", reference " << i;
        }
        for (const AxisDistances& c : candidates) ASSERT_LE(best, pair_fitness(references[i], c, error));
      }
    }
  }
}

TEST(TreeMatches, CandidatesOnAnAxisPointOnly) {
  EXPECT_EQ(tree_matches({{1, 1}}, {{0, 1}, {1, 0}}, PairError::squared), (std::vector<int>{0}));
}

TEST(Spectrum, OfTheSphere) {
  // On the unit sphere l (l + 1), 2 l + 1 times; ours is times the area, 4 pi.
  const Surface surface = make_surface(shapes::icosphere(4));
  const Spectrum s = laplacian_spectrum(surface, 16);
  const double expected[] = {0, 2, 2, 2, 6, 6, 6, 6, 6, 12, 12, 12, 12, 12, 12, 12};
  for (int i = 0; i < 16; ++i) EXPECT_NEAR(s.value[i] / (4 * M_PI), expected[i], 0.01 * expected[i] + 1e-6) << i;
  const Eigen::Map<const Eigen::VectorXd> area(surface.vertex_area.data(), surface.vertices());
  const Eigen::MatrixXd gram = s.function.transpose() * (area / surface.area).asDiagonal() * s.function;
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(16, 16)).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(NearestRows, AreThoseOfAllDistances) {
  Random random(3);
  Eigen::MatrixXd a(150, 7), b(90, 7);
  for (auto* m : {&a, &b})
    for (Eigen::Index i = 0; i < m->size(); ++i) m->data()[i] = draw_unit(random);
  const std::vector<int> found = nearest_rows(a, b, 3);
  EXPECT_EQ(found, nearest_rows(a, b, 1));
  for (int i = 0; i < 150; ++i) {
    Eigen::Index best;
    (b.rowwise() - a.row(i)).rowwise().squaredNorm().minCoeff(&best);
    EXPECT_EQ(found[i], best);
  }
}

TEST(Features, AreAlikeForPartnersAndMatchAcross) {
  const shapes::Symmetric shape = shapes::creature(4);
  const Surface surface = make_surface(shape.mesh);
  const Eigen::MatrixXd f = symmetry_features(surface, GeodesicSolver(surface), laplacian_spectrum(surface, 40), 0);
  EXPECT_LT((f - f(shape.partner, Eigen::all)).rowwise().norm().mean(), 0.1 * f.rowwise().norm().mean());
  std::vector<int> side(surface.vertices());
  for (int v = 0; v < surface.vertices(); ++v)
    side[v] = shape.partner[v] == v ? 0 : shape.mesh.position[3 * v] > 0 ? 1 : -1;
  const std::vector<int> match = match_across(f, side, 0);
  for (int v = 0; v < surface.vertices(); ++v) EXPECT_EQ(side[match[v]], -side[v]);
}

TEST(ReversedShare, OfTheMirrorImageAndTheIdentity) {
  const shapes::Symmetric shape = shapes::creature(3);
  const Surface surface = make_surface(shape.mesh);
  EXPECT_EQ(reversed_share(surface, shape.partner), 1);
  std::vector<int> identity(surface.vertices());
  std::iota(identity.begin(), identity.end(), 0);
  EXPECT_EQ(reversed_share(surface, identity), 0);
}

TEST(Spectral, SignsOfAnExactSymmetryAndTheirRefinement) {
  const shapes::Symmetric shape = shapes::shuffled(shapes::creature(4), 3);
  const Surface surface = make_surface(shape.mesh);
  const Spectrum spectrum = laplacian_spectrum(surface, 60);
  const auto starts = sign_patterns(surface, spectrum, {}, {}, 0);
  ASSERT_FALSE(starts.empty());
  const auto misses = [&](const std::vector<int>& partner) {
    int count = 0;
    for (int v = 0; v < surface.vertices(); ++v) count += partner[v] != shape.partner[v];
    return static_cast<double>(count) / surface.vertices();
  };
  EXPECT_LT(misses(to_partners(spectrum, starts[0], 0)), 0.05);
  ZoomOutOptions options;
  options.functions = 60;
  options.samples = 0;
  EXPECT_LT(misses(zoomout(surface, spectrum, starts, {}, options, 0)), 0.01);

  // From a map that is right but for noise, on samples.
  Random random(1);
  const std::vector<int> vertices = space_samples(surface, 200);
  std::vector<int> partner;
  for (int v : vertices)
    partner.push_back(draw_below(random, 5) ? shape.partner[v]
                                            : static_cast<int>(draw_below(random, surface.vertices())));
  options.samples = 800;
  const auto refined = zoomout(surface, spectrum, {to_functional_map(spectrum, vertices, partner, 12)}, {}, options, 0);
  EXPECT_LT(misses(refined), 0.05);
}

TEST(Spectral, TheReversingMapOfAnExactSymmetry) {
  const shapes::Symmetric shape = shapes::shuffled(shapes::creature(4), 3);
  const Surface surface = make_surface(shape.mesh);
  const Spectrum spectrum = laplacian_spectrum(surface, 60);
  const FunctionalMap map = reversing_map(surface, spectrum, {});
  const Eigen::Index k = map.rows();
  EXPECT_LT((map.transpose() * map - FunctionalMap::Identity(k, k)).norm(), 1e-9);
  EXPECT_GT(reversed_share(surface, to_partners(spectrum, map, 0)), 0.9);
  ZoomOutOptions options;
  options.functions = 60;
  options.samples = 0;
  const std::vector<int> partner = zoomout(surface, spectrum, {map}, {}, options, 0);
  int misses = 0;
  for (int v = 0; v < surface.vertices(); ++v) misses += partner[v] != shape.partner[v];
  EXPECT_LT(misses, 0.01 * surface.vertices());
}

TEST(Methods, EachFindsMostPartnersOfAnExactSymmetry) {
  const shapes::Symmetric shape = shapes::shuffled(shapes::creature(3), 9);
  References references;
  references.axis = {shape.axis[0], shape.axis[1]};
  references.pairs = {shape.pair};
  Truth truth;
  for (int v = 0; v < shape.mesh.vertices(); v += 5) truth.push_back({v, shape.partner[v]});
  std::vector<std::vector<int>> maps;
  std::vector<std::string> names;
  for (const comparison::Method& m : comparison::methods()) {
    if (m.name.find("-full") != m.name.npos) continue;
    maps.push_back(m.run({shape.mesh, references, 1, 0}, {}).partner);
    names.push_back(m.name);
    if (!m.random) {
      EXPECT_EQ(maps.back(), m.run({shape.mesh, references, 2, 1}, {}).partner) << m.name;
    }
  }
  const std::vector<Evaluation> found = evaluate_partners(shape.mesh, truth, maps);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].coverage, 1) << names[i];
    EXPECT_GT(found[i].corr, 0.7) << names[i];
  }
}

TEST(Methods, RefuseWhatTheyDoNotKnow) {
  EXPECT_THROW(method("slow"), InvalidOption);
  const TriangleMesh mesh = shapes::body();
  for (const char* name : {"naive", "features", "spectral"})
    EXPECT_THROW(method(name).run({mesh, {{1, 2}, {{3, mesh.vertices()}}}, 1, 1}, {}), InvalidOption) << name;
}

TEST(Methods, NeedNoWholeMesh) {
  const TriangleMesh two = shapes::joined(shapes::body(), shapes::sphere());
  const std::vector<int> partner = method("spectral-auto").run({two, {}, 1, 1}, {}).partner;
  EXPECT_EQ(partner.size(), static_cast<std::size_t>(two.vertices()));
  EXPECT_EQ(partner.back(), -1) << "the small component has none";
  EXPECT_GE(partner.front(), 0);
}

TEST(Durations, TheGeneticAlgorithmNeverBeatsTheOptimum) {
  const shapes::Symmetric shape = shapes::bent(shapes::creature(4), 0.1);
  const comparison::PairsScene scene =
      comparison::make_pairs_scene(shape.mesh, {{shape.axis[0], shape.axis[1]}, {shape.pair}}, 400, 1, {});
  ASSERT_EQ(scene.samples.left.size(), 200u);
  for (PairError error : {PairError::squared, PairError::linear})
    for (std::uint64_t seed : {1, 2}) {
      PairsOptions options;
      options.error = error;
      const auto durations = comparison::measure_durations(scene.samples, options, seed, {});
      ASSERT_EQ(durations.size(), 8u);
      const double optimum = durations[0].fitness;
      EXPECT_EQ(durations[0].search, "naive");
      EXPECT_EQ(durations[1].search, "kdtree");
      EXPECT_EQ(durations[1].fitness, optimum);
      for (const comparison::Duration& d : durations) {
        EXPECT_GE(d.fitness, optimum) << d.search;
        EXPECT_GT(d.seconds, 0) << d.search;
        if (d.reached) {
          EXPECT_LE(d.fitness, optimum * (1 + d.quality)) << d.search;
        }
        if (d.search == "scan") {
          EXPECT_LE(d.evaluations, durations[0].evaluations);
        }
      }
      const comparison::Evolution run = comparison::watch_pairs(scene.samples, options, 0, seed, {});
      ASSERT_EQ(run.log.size(), run.seconds.size());
      EXPECT_GE(run.log.back().best, optimum);
      for (std::size_t g = 1; g < run.seconds.size(); ++g) EXPECT_GE(run.seconds[g], run.seconds[g - 1]);
    }
}

TEST(Durations, ConvergenceIsWithinATwentiethOfTheFall) {
  EXPECT_EQ(comparison::convergence_generation({{0, 10, 0, 1}, {1, 4, 0, 1}, {2, 0.5, 0, 1}, {3, 0, 0, 1}}), 2);
  EXPECT_EQ(comparison::convergence_generation({{0, 3, 0, 1}}), 0);
}

class DataSet : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = testing::TempDir() + "ga_symmetry_XXXXXX";
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { fs::remove_all(folder_); }
  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  comparison::KnownSymmetry read(const std::string& mesh, int vertices = 10) {
    return comparison::read_known_symmetry(mesh, folder_.string(), vertices);
  }
  // The message of the refusal: one line that names the file.
  void expect_refused(const std::string& mesh, const std::string& says) {
    try {
      read(mesh);
      ADD_FAILURE() << "not refused: " << says;
    } catch (const FileError& error) {
      const std::string what = error.what();
      EXPECT_NE(what.find(says), what.npos) << what;
      EXPECT_EQ(what.find('\n'), what.npos) << what;
    }
  }
  fs::path folder_;
};

TEST_F(DataSet, TruthAndReferences) {
  write("cat.truth", "0 9\r\n9 0\n\n4 4\n");
  EXPECT_EQ(read("any/where/cat.off").truth, (Truth{{0, 9}, {9, 0}, {4, 4}}));
  EXPECT_TRUE(read("cat.ply").references.empty());
  write("cat.refs", "1 2 3\n4\n");
  const References references = read("cat.off").references;
  EXPECT_EQ(references.axis, (std::vector<int>{1, 2}));
  EXPECT_EQ(references.pairs, (std::vector<std::array<int, 2>>{{3, 4}}));
}

TEST_F(DataSet, LandmarksOfKimEtAl) {
  write("cat.pid", "7 0.1 0.2 0.3\n3\n5\n");
  write("cat.sym.info", "0 1\n2\n");
  const Truth expected{{7, 3}, {3, 7}, {5, 5}};
  EXPECT_EQ(read("cat.off").truth, expected);
  EXPECT_EQ(read("cat10.off").truth, expected) << "one class, many poses";
  EXPECT_EQ(read("mesh001.off").truth, expected) << "one subject, many poses";
  write("dog.pid", "1\n");
  write("dog.sym.info", "0\n");
  EXPECT_EQ(read("dog3.off").truth, (Truth{{1, 1}}));
  expect_refused("mesh001.off", "nothing is known of mesh001");
}

TEST_F(DataSet, LinesOfTwoFilesFromOne) {
  write("a.vts", "1\n10\n5\n");
  write("a.sym.vts", "10\n1\n5\n");
  EXPECT_EQ(read("a.off").truth, (Truth{{0, 9}, {9, 0}, {4, 4}}));
}

TEST_F(DataSet, RefusesWhatIsWrong) {
  expect_refused("a.off", "nothing is known of a");
  write("a.truth", "");
  expect_refused("a.off", "a.truth: the file is empty");
  write("a.truth", "\n\n");
  expect_refused("a.off", "names no pair");
  write("a.truth", "0 1\n0\n");
  expect_refused("a.off", "a.truth: line 2: expected two vertices");
  write("a.truth", "0 10\n");
  expect_refused("a.off", "line 1: expected the number of a vertex, 0 to 9, got 10");
  write("a.truth", "0 1e3\n");
  expect_refused("a.off", "got 1e3");
  write("a.truth", "0 99999999999999999999\n");
  expect_refused("a.off", "expected the number");
  write("a.truth", std::string("0 1\n\0\xff 2\n", 9));
  expect_refused("a.off", "line 2");
  write("a.truth", "0 1\n");
  for (const auto& [bad, why] : {std::pair("1 2 3", "an even number"),
                                 {"1 2 3 3", "a.refs: "},
                                 {"1 2 3 x", "a.refs: "},
                                 {"1 2", "four different vertices"},
                                 {"1 2 3 10", "vertex 10 of 10"}}) {
    write("a.refs", bad);
    expect_refused("a.off", why);
  }
  write("b.vts", "1\n2\n");
  expect_refused("b.off", "b.sym.vts");
  write("b.sym.vts", "1\n");
  expect_refused("b.off", "it has 1 lines, b.vts has 2");
  write("b.sym.vts", "1\n0\n");
  expect_refused("b.off", "1 to 10, got 0");
  write("c.pid", "1\n2\n");
  expect_refused("c.off", "c.sym.info");
  write("c.sym.info", "0 1 2\n");
  expect_refused("c.off", "line 1: expected one or two");
  write("c.sym.info", "0 2\n");
  expect_refused("c.off", "number of a landmark, 0 to 1, got 2");
  fs::create_directory(folder_ / "d.truth");
  expect_refused("d.off", "d.truth");
  EXPECT_THROW(comparison::read_known_symmetry("a.off", (folder_ / "none").string(), 3), FileError);
}

}  // namespace
}  // namespace ga_symmetry
