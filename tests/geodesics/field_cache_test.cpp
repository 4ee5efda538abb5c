// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesics/field_cache.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "ga_symmetry/errors.h"
#include "symmetric_shapes.h"
#include "util/parallel.h"

namespace ga_symmetry {
namespace {

struct Scene {
  Surface surface = make_surface(shapes::torus(24, 12));
  GeodesicSolver solver{surface};
  FieldCache fields{solver};
};

TEST(FieldCache, GivesTheFieldsOfTheSolverInAnyOrder) {
  const Scene s;
  for (const std::vector<int>& sources :
       {std::vector{5, 9, 5}, std::vector{9, 100, 5}, std::vector<int>{}, std::vector{100}})
    for (const int threads : {1, 4}) EXPECT_EQ(s.fields.fields(sources, threads), s.solver.fields(sources, 1));
}

TEST(FieldCache, ComputesNoFieldTwice) {
  const Scene s;
  s.fields.fields({5, 9}, 1);
  const std::atomic<bool> cancel = true;
  const Context cancelled{nullptr, &cancel, nullptr};
  EXPECT_EQ(s.fields.fields({9, 5}, 1, cancelled), s.solver.fields({9, 5}, 1)) << "nothing to compute";
  EXPECT_THROW(s.fields.fields({9, 7}, 1, cancelled), Cancelled);
  EXPECT_EQ(s.fields.fields({7}, 1), s.solver.fields({7}, 1));
}

TEST(FieldCache, SourcesOutOfRangeAreRefusedAndNothingIsLost) {
  const Scene s;
  EXPECT_THROW(s.fields.fields({5, s.surface.vertices()}, 1), InvalidOption);
  EXPECT_THROW(s.fields.fields({-1}, 1), InvalidOption);
  EXPECT_EQ(s.fields.fields({5}, 1), s.solver.fields({5}, 1));
}

TEST(FieldCache, ManyThreadsMayAskAtOnce) {
  const Scene s;
  const DistanceFields truth = s.solver.fields({3, 4, 5, 6, 7}, 1);
  std::vector<DistanceFields> found(16);
  parallel_for(16, 4, [&](int i, int) { found[i] = s.fields.fields({3 + i % 5}, 1); });
  for (int i = 0; i < 16; ++i) EXPECT_EQ(found[i], truth.row(i % 5));
}

}  // namespace
}  // namespace ga_symmetry
