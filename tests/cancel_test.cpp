// SPDX-License-Identifier: GPL-3.0-or-later
// Stopping from code: at every stage, and with nothing left behind.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "ga_symmetry/errors.h"
#include "ga_symmetry/io.h"
#include "ga_symmetry/symmetry.h"

using namespace ga_symmetry;
namespace fs = std::filesystem;

namespace {

const std::string kSample = std::string(GA_SYMMETRY_SAMPLE_MESHES) + "/person_wave.off";

Options quick() {
  Options options;
  options.proxy = 1000;
  options.joint.samples = 30;
  options.joint.sites = 60;
  options.joint.population = 10;
  options.joint.max_generations = 3;
  return options;
}

struct Folder {
  fs::path path = fs::temp_directory_path() / ("ga_symmetry_cancel_" + std::to_string(::getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};

}  // namespace

TEST(Cancel, AtEveryStage) {
  const TriangleMesh mesh = read_mesh(kSample);
  std::vector<std::string> stages;
  double last = 0;
  Context watch;
  watch.progress = [&](double fraction, const char* stage) {
    EXPECT_GE(fraction, last) << stage;
    EXPECT_LE(fraction, 1) << stage;
    EXPECT_LE(fraction - last, 0.2) << stage;  // it moves steadily
    last = fraction;
    if (stages.empty() || stages.back() != stage) stages.push_back(stage);
  };
  find_symmetry(mesh, quick(), watch);
  EXPECT_EQ(last, 1);
  for (const char* expected :
       {"checking the mesh", "simplifying", "distances", "search", "refinement", "dense map", "all vertices", "axis"})
    EXPECT_GT(std::count(stages.begin(), stages.end(), expected), 0) << expected;
  ASSERT_EQ(stages.back(), "done");
  stages.pop_back();  // too late
  for (const std::string& stage : stages)
    for (int threads : {1, 2}) {
      std::atomic<bool> cancel{false};
      Context context;
      context.cancel = &cancel;
      context.progress = [&](double, const char* now) { cancel = cancel || now == stage; };
      Options options = quick();
      options.threads = threads;
      EXPECT_THROW(find_symmetry(mesh, options, context), Cancelled) << stage;
    }
}

TEST(Cancel, Reading) {
  const Folder folder;
  const TriangleMesh mesh = read_mesh(kSample);
  const auto write = [&](const char* name, const auto& print) {
    std::ofstream out(folder.path / name);
    out.precision(9);
    print(out);
    return (folder.path / name).string();
  };
  const auto point = [&](std::ostream& out, int v) {
    for (int k = 0; k < 3; ++k) out << ' ' << mesh.position[3 * v + k];
    out << '\n';
  };
  const std::string obj = write("mesh.obj", [&](std::ostream& out) {
    for (int v = 0; v < mesh.vertices(); ++v) point(out << 'v', v);
    for (int c = 0; c < 3 * mesh.triangles(); c += 3)
      out << "f " << mesh.triangle[c] + 1 << ' ' << mesh.triangle[c + 1] + 1 << ' ' << mesh.triangle[c + 2] + 1 << '\n';
  });
  const std::string stl = write("mesh.stl", [&](std::ostream& out) {
    out << "solid\n";
    for (int c = 0; c < 3 * mesh.triangles(); c += 3) {
      out << "facet normal 0 0 1\nouter loop\n";
      for (int k = 0; k < 3; ++k) point(out << "vertex", mesh.triangle[c + k]);
      out << "endloop\nendfacet\n";
    }
    out << "endsolid\n";
  });
  const std::string ply = write("mesh.ply", [&](std::ostream& out) {
    out << "ply\nformat ascii 1.0\nelement vertex " << mesh.vertices()
        << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << mesh.triangles()
        << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (int v = 0; v < mesh.vertices(); ++v) point(out, v);
    for (int c = 0; c < 3 * mesh.triangles(); c += 3)
      out << "3 " << mesh.triangle[c] << ' ' << mesh.triangle[c + 1] << ' ' << mesh.triangle[c + 2] << '\n';
  });
  for (const std::string& path : {kSample, obj, stl, ply}) {
    EXPECT_EQ(read_mesh(path).vertices(), mesh.vertices()) << path;
    std::atomic<bool> cancel{true};
    Context context;
    context.cancel = &cancel;
    EXPECT_THROW(read_mesh(path, context), Cancelled) << path;
    context.progress = [&](double fraction, const char*) { cancel = fraction > 0.1; };  // not at once
    cancel = false;
    EXPECT_THROW(read_mesh(path, context), Cancelled) << path;
  }
}

TEST(Cancel, WritingLeavesNothing) {
  const Folder folder;
  const TriangleMesh mesh = read_mesh(kSample);
  const Result result = find_symmetry(mesh, quick());
  const std::vector<std::string> paths{(folder.path / "a.csv").string(), (folder.path / "a.json").string(),
                                       (folder.path / "a.ply").string()};
  for (std::size_t stop = 1; stop <= paths.size(); ++stop) {
    std::atomic<bool> cancel{false};
    std::size_t files = 0;
    Context context;
    context.cancel = &cancel;
    context.progress = [&](double, const char*) { cancel = ++files == stop; };
    EXPECT_THROW(write_results(paths, mesh, result, context), Cancelled) << stop;
    EXPECT_TRUE(fs::is_empty(folder.path)) << stop;
  }
  write_results(paths, mesh, result);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path), {}), 3);
}
