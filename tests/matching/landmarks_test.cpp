#include "matching/landmarks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geodesics/sampling.h"
#include "symmetric_shapes.h"

namespace ga_symmetry {
namespace {

// A creature, its samples as landmarks, and all their images pushed off the truth in the same sense around the body.
struct Scene {
  shapes::Symmetric shape = shapes::shuffled(shapes::creature(4), 5);
  Surface surface = make_surface(shape.mesh);
  GeodesicSolver solver{surface};
  Samples samples = evenly_spaced_samples(surface, solver, 60, 1);
  CurvatureFeatures curvature;
  RefinedLandmarks pushed;

  Scene() {
    HeatDiffusion diffusion(surface);
    curvature = curvature_features(surface, diffusion);
    for (int v : samples.vertex) {
      int image = shape.partner[v];
      for (int step = 0; step < 4; ++step) {  // four edges, each the one that climbs most
        int best = image;
        for (int i = surface.first_corner[image]; i < surface.first_corner[image + 1]; ++i) {
          const int w = surface.triangle[next_corner(surface.corner_at[i])];
          if (surface.point(w)[2] > surface.point(best)[2]) best = w;
        }
        image = best;
      }
      pushed.landmarks.from.push_back(v);
      pushed.landmarks.to.push_back(image);
    }
    pushed.to_field = solver.fields(pushed.landmarks.to, 1);
  }
  double error(const RefinedLandmarks& landmarks) const {
    double total = 0;
    for (std::size_t i = 0; i < samples.vertex.size(); ++i)
      total += landmarks.to_field(static_cast<int>(i), shape.partner[samples.vertex[i]]);
    return total / static_cast<double>(samples.vertex.size()) / surface.unit();
  }
};

const Scene& scene() {
  static const Scene s;
  return s;
}

RefinedLandmarks adjusted(const RefineOptions& options, int threads = 1) {
  const Scene& s = scene();
  return adjust_landmarks(s.surface, s.solver, s.pushed, s.samples.distance, s.curvature, options, threads);
}

TEST(AdjustLandmarks, BringsImagesHomeThatAreAllOffTheSameWay) {
  const Scene& s = scene();
  ASSERT_GT(s.error(s.pushed), 0.08);
  EXPECT_LT(s.error(adjusted({})), 0.25 * s.error(s.pushed));
}

TEST(AdjustLandmarks, LowersTheStressWithEveryFurtherStep) {
  const Scene& s = scene();
  double before = landmark_stress(s.surface, s.pushed, s.samples.distance, s.curvature, {});
  for (int steps : {1, 2, 4, 8}) {
    RefineOptions options;
    options.steps = steps;
    const double now = landmark_stress(s.surface, adjusted(options), s.samples.distance, s.curvature, options);
    EXPECT_LE(now, before);
    before = now;
  }
  EXPECT_LT(before, 0.1 * landmark_stress(s.surface, s.pushed, s.samples.distance, s.curvature, {}));
}

TEST(AdjustLandmarks, FieldsAreThoseOfTheImages) {
  const Scene& s = scene();
  const RefinedLandmarks out = adjusted({});
  EXPECT_TRUE(out.to_field == s.solver.fields(out.landmarks.to, 1));
}

TEST(AdjustLandmarks, FixedLandmarksStay) {
  RefineOptions options;
  options.fixed = 20;
  const auto to = adjusted(options).landmarks.to, &start = scene().pushed.landmarks.to;
  EXPECT_TRUE(std::equal(to.end() - 20, to.end(), start.end() - 20));
  EXPECT_FALSE(std::equal(to.begin(), to.end() - 20, start.begin()));
}

TEST(AdjustLandmarks, ThreadsChangeNothing) { EXPECT_EQ(adjusted({}, 1).landmarks.to, adjusted({}, 4).landmarks.to); }

TEST(AdjustLandmarks, NoStepsLeaveEverything) {
  RefineOptions options;
  options.steps = 0;
  EXPECT_EQ(adjusted(options).landmarks.to, scene().pushed.landmarks.to);
}

TEST(RefineLandmarks, KeepsThePerfectImages) {
  const Scene& s = scene();
  RefinedLandmarks perfect = s.pushed;
  for (std::size_t i = 0; i < s.samples.vertex.size(); ++i)
    perfect.landmarks.to[i] = s.shape.partner[s.samples.vertex[i]];
  const std::vector<int> truth = perfect.landmarks.to;
  perfect.to_field = s.solver.fields(truth, 1);
  EXPECT_EQ(refine_landmarks(s.surface, s.solver, perfect, s.samples.distance, s.curvature, {}, 1).landmarks.to, truth);
}

}  // namespace
}  // namespace ga_symmetry
