// SPDX-License-Identifier: GPL-3.0-or-later
// The same bytes whatever the threads; the corresponding answer for the same shape in other clothes.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <ostream>
#include <string>
#include <vector>

#include "ga_symmetry/io.h"
#include "ga_symmetry/symmetry.h"
#include "geodesics/geodesics.h"
#include "surface/surface.h"
#include "symmetric_shapes.h"

namespace ga_symmetry {
namespace {

struct Way {
  std::string name;
  int level;  // of the creature
  Options options;
};
void PrintTo(const Way& way, std::ostream* out) { *out << way.name; }

Options small_search() {
  Options o;
  o.joint.samples = 40, o.joint.sites = 120, o.joint.population = 16, o.joint.max_generations = 5;
  o.pairs.samples = 200, o.pairs.max_generations = 30;
  return o;
}

Options with(const std::function<void(Options&)>& change) {
  Options o = small_search();
  change(o);
  return o;
}

class SameBytes : public testing::TestWithParam<Way> {
 protected:
  static std::string bytes(const TriangleMesh& mesh, const Options& options) {
    namespace fs = std::filesystem;
    const fs::path path = fs::path(testing::TempDir()) / ("determinism_" + GetParam().name + ".json");
    write_result(path.string(), mesh, find_symmetry(mesh, options));
    std::ifstream in(path, std::ios::binary);
    std::string out{std::istreambuf_iterator<char>(in), {}};
    in.close();
    fs::remove(path);
    return out;
  }
};

TEST_P(SameBytes, ForOneTwoAndEightThreadsAndAgain) {
  const shapes::Symmetric shape = shapes::shuffled(shapes::bent(shapes::creature(GetParam().level), 0.1), 7);
  Options o = GetParam().options;
  if (o.method == Method::pairs || !o.references.empty()) {
    o.references.axis = {shape.axis[0], shape.axis[1]};
    o.references.pairs = {shape.pair};
  }
  o.threads = 1;
  const std::string one = bytes(shape.mesh, o);
  EXPECT_GT(one.size(), 1000u);
  for (const int threads : {1, 2, 8}) {
    o.threads = threads;
    EXPECT_TRUE(bytes(shape.mesh, o) == one) << threads << " threads";
  }
}

INSTANTIATE_TEST_SUITE_P(Determinism, SameBytes,
                         testing::Values(Way{"automatic", 3, small_search()},
                                         Way{"references", 3, with([](Options& o) { o.references.axis = {0}; })},
                                         Way{"rotation", 3,
                                             with([](Options& o) { o.symmetry = SymmetryKind::rotation; })},
                                         Way{"pairs", 3, with([](Options& o) { o.method = Method::pairs; })},
                                         Way{"uniform_pairs", 3, with([](Options& o) {
                                               o.method = Method::pairs, o.pairs.sampling = Sampling::uniform;
                                             })},
                                         Way{"on_a_proxy", 4, with([](Options& o) { o.proxy = 1000; })}),
                         [](const auto& info) { return info.param.name; });

// The same surface with other numbers, in another place and size, or as its mirror image.
class OtherClothes : public testing::TestWithParam<Method> {
 protected:
  OtherClothes() : shape_(shapes::bent(shapes::creature(3), 0.1)), surface_(make_surface(shape_.mesh)) {
    options_.method = GetParam();
    own_ = find(shape_.mesh, {});
  }

  // Partners of the mesh whose vertex to[v] is v, numbered as the shape's own.
  std::vector<int> find(const TriangleMesh& mesh, std::vector<int> to) {
    const int n = shape_.mesh.vertices();
    for (int v = static_cast<int>(to.size()); v < n; ++v) to.push_back(v);
    options_.references.axis = {to[shape_.axis[0]], to[shape_.axis[1]]};
    options_.references.pairs = {{to[shape_.pair[0]], to[shape_.pair[1]]}};
    const std::vector<int> partner = find_symmetry(mesh, options_).partners.partner;
    std::vector<int> from(n), out(n);
    for (int v = 0; v < n; ++v) from[to[v]] = v;
    for (int v = 0; v < n; ++v) out[v] = partner[to[v]] < 0 ? -1 : from[partner[to[v]]];
    return out;
  }

  // Rounding differs, and what it decides is worth about an edge (0.07 units here) now and then.
  void expect_own(const std::vector<int>& partner) {
    constexpr double kMean = 0.01, kAlike = 0.9;
    const GeodesicSolver solver(surface_);
    double sum = 0;
    int alike = 0;
    for (int v = 0; v < surface_.vertices(); ++v) {
      ASSERT_GE(partner[v], 0);
      if (partner[v] == own_[v])
        ++alike;
      else
        sum += solver.fields({own_[v]}, 1)(0, partner[v]) / surface_.unit();
    }
    EXPECT_LT(sum / surface_.vertices(), kMean);
    EXPECT_GT(alike, kAlike * surface_.vertices());
  }

  shapes::Symmetric shape_;
  Surface surface_;
  Options options_;
  std::vector<int> own_;
};

TEST_P(OtherClothes, Renumbered) {
  const std::vector<int> to = shapes::random_permutation(shape_.mesh.vertices(), 11);
  expect_own(find(shapes::renumbered(shape_.mesh, to), to));
}

TEST_P(OtherClothes, RotatedMovedAndScaled) {
  expect_own(find(shapes::moved(shape_.mesh, 1), {}));
  expect_own(find(shapes::moved(shape_.mesh, 1e-6), {}));
}

TEST_P(OtherClothes, Mirrored) {
  TriangleMesh mesh = shape_.mesh;
  for (std::size_t i = 0; i < mesh.position.size(); i += 3) mesh.position[i] *= -1;
  expect_own(find(mesh, {}));
}

INSTANTIATE_TEST_SUITE_P(Determinism, OtherClothes, testing::Values(Method::joint, Method::pairs),
                         [](const auto& info) { return info.param == Method::joint ? "joint" : "pairs"; });

}  // namespace
}  // namespace ga_symmetry
