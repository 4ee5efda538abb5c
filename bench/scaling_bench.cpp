// SPDX-License-Identifier: GPL-3.0-or-later
// The whole search on ever larger meshes, each the one before with every face cut in four, beside a yardstick that is
// measured in the same run: 100 distance fields of vcg::tri::Geodesic on that mesh, one thread (from the median of 5).
//
//   scaling_bench MESH.off LEVELS [THREADS [PROXY]]        MESH.refs and MESH.truth beside the mesh
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "dataset.h"
#include "ga_symmetry/io.h"
#include "ga_symmetry/symmetry.h"
#include "geodesics/geodesics.h"
#include "subdivided.h"
#include "vcg_geodesic.h"

namespace {

using namespace ga_symmetry;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

double yardstick(const Surface& surface) {
  baseline::VcgGeodesic vcg(surface);
  std::vector<float> field(surface.vertices());
  std::vector<double> seconds;
  for (int i = 0; i < 5; ++i) {
    const double begin = now();
    vcg.field(static_cast<int>(static_cast<long>(surface.vertices()) * (2 * i + 1) / 10), field.data());
    seconds.push_back(now() - begin);
  }
  std::sort(seconds.begin(), seconds.end());
  return 100 * seconds[2];
}

// At up to 50 lines of the truth: vertices keep their numbers when faces are cut.
double mean_error(const Surface& surface, const comparison::KnownSymmetry& known, const std::vector<int>& partner) {
  const GeodesicSolver solver(surface);
  const auto workspace = solver.make_workspace();
  std::vector<float> field(surface.vertices());
  std::vector<int> index(surface.mesh_vertices);
  for (int v = 0; v < surface.vertices(); ++v) index[surface.mesh_vertex[v]] = v;
  const std::size_t stride = std::max<std::size_t>(1, known.truth.size() / 50);
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < known.truth.size(); i += stride, ++count) {
    const auto& [v, truth] = known.truth[i];
    solver.field(index[truth], field.data(), *workspace);
    sum += partner[v] < 0 ? 1 : field[index[partner[v]]] / surface.unit();
  }
  return sum / count;
}

void run(TriangleMesh mesh, const comparison::KnownSymmetry& known, int levels, const Options& options) {
  std::printf("%9s %9s %10s %7s %8s %7s  %s\n", "vertices", "seconds", "yardstick", "ratio", "peak MB", "error",
              "stages");
  for (int level = 0; level <= levels; ++level) {
    if (level > 0) mesh = subdivided(mesh);
    const double begin = now();
    const Result result = find_symmetry(mesh, options);
    const double seconds = now() - begin;
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const Surface surface = make_surface(mesh);
    const double measure = yardstick(surface);
    std::printf("%9d %9.2f %10.2f %7.3f %8ld %7.4f ", surface.vertices(), seconds, measure, seconds / measure,
                usage.ru_maxrss / 1024, mean_error(surface, known, result.partners.partner));
    for (const StageTime& stage : result.seconds) std::printf(" %s %.2f", stage.stage.c_str(), stage.seconds);
    std::printf("\n");
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: scaling_bench MESH LEVELS [THREADS [PROXY]]\n");
    return 2;
  }
  try {
    const std::string path = argv[1],
                      folder = path.find('/') == std::string::npos ? "." : path.substr(0, path.rfind('/'));
    TriangleMesh mesh = read_mesh(path);
    const comparison::KnownSymmetry known = comparison::read_known_symmetry(path, folder, mesh.vertices());
    Options options;
    options.references = known.references;
    options.threads = argc > 3 ? std::atoi(argv[3]) : 2;
    if (argc > 4) options.proxy = std::atoi(argv[4]);
    run(std::move(mesh), known, std::atoi(argv[2]), options);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "scaling_bench: %s\n", e.what());
    return 1;
  }
}
