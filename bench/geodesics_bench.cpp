// SPDX-License-Identifier: GPL-3.0-or-later
// One distance field: ours beside vcg::tri::Geodesic, on the same meshes, in turn, on one thread. Prints the median CPU
// time of each, their ratio, and the errors against great circles on the unit sphere.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "geodesics/geodesics.h"
#include "spheres.h"
#include "vcg_geodesic.h"

namespace {

using namespace ga_symmetry;

struct Measure {
  std::vector<double> milliseconds;  // one per source
  double sum = 0, largest = 0;       // of the absolute errors
  std::vector<std::vector<float>> fields;

  template <class Field>
  void run(int vertices, const Field& field) {
    std::vector<float> out(vertices);
    const std::clock_t begin = std::clock();
    field(out.data());
    milliseconds.push_back(1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    fields.push_back(std::move(out));
  }
  double median() const {
    std::vector<double> sorted = milliseconds;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }
};

void compare(const char* name, const TriangleMesh& mesh, int sources) {
  const Surface surface = make_surface(mesh);
  const int n = surface.vertices();
  const double scale = spheres::scale_of(mesh, surface);
  const GeodesicSolver solver(surface);
  const auto workspace = solver.make_workspace();
  baseline::VcgGeodesic vcg(surface);
  Measure ours, theirs;
  std::vector<int> source;
  for (int i = 0; i < sources; ++i) {
    source.push_back(static_cast<int>(static_cast<long>(n) * (2 * i + 1) / (2 * sources)));
    ours.run(n, [&](float* out) { solver.field(source[i], out, *workspace); });
    theirs.run(n, [&](float* out) { vcg.field(source[i], out); });
  }
  const auto report = [&](const char* who, Measure& m) {
    double asymmetry = 0;
    for (int i = 0; i < sources; ++i) {
      const double* p = &mesh.position[3 * surface.mesh_vertex[source[i]]];
      for (int v = 0; v < n; ++v) {
        const double truth = spheres::great_circle(p, &mesh.position[3 * surface.mesh_vertex[v]]);
        const double error = std::abs(m.fields[i][v] / scale - truth);
        m.sum += error;
        m.largest = std::max(m.largest, error);
      }
      for (int j = 0; j < i; ++j)
        asymmetry = std::max(asymmetry, std::abs(m.fields[i][source[j]] - m.fields[j][source[i]]) / scale);
    }
    std::printf("%-15s %7d  %-8s %9.2f %12.6f %11.5f %11.5f\n", name, n, who, m.median(), m.sum / n / sources,
                m.largest, asymmetry);
  };
  report("ours", ours);
  report("vcglib", theirs);
  std::printf("%-15s %7s  %-8s %9.1f %12.1f\n", "", "", "ratio", theirs.median() / ours.median(),
              theirs.sum / ours.sum);
}

}  // namespace

int main(int argc, char** argv) {
  const int sources = argc > 1 ? std::atoi(argv[1]) : 15;
  if (argc > 2 || sources < 1) {
    std::fprintf(stderr, "usage: geodesics_bench [sources, at least 1]\n");
    return 2;
  }
  std::printf("%-15s %7s  %-8s %9s %12s %11s %11s\n", "unit sphere", "vertices", "", "ms/field", "mean error",
              "max error", "asymmetry");
  compare("regular", spheres::icosphere(35), sources);
  compare("jittered", spheres::icosphere(35, 0.008), sources);
  compare("slivers", spheres::uv_sphere(50, 245), sources);
  compare("regular", spheres::icosphere(100), sources);
  compare("jittered", spheres::icosphere(100, 0.0028), sources);
}
