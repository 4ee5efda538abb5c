// SPDX-License-Identifier: GPL-3.0-or-later
// damage_bench FOLDER [SEED [THREADS [DAMAGE]]]: what each damage of the kit costs, or that one; "partial": what is
// lost with parts of the shape. Every mesh of the folder with a known symmetry (see dataset.h) is searched whole and
// with each damage, with references and without; the means are printed as a Markdown table, then every run that loses
// more than is allowed.
//
// damage_bench --make MESH LEVELS OUT.ply: cuts every face in four LEVELS times, adds noise, debris, seams and fins,
// and writes OUT.ply; OUT.clean.ply is the same before, also in random order, as
// that alone costs time.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "damage_kit.h"
#include "dataset.h"
#include "ga_symmetry/errors.h"
#include "ga_symmetry/io.h"
#include "subdivided.h"
#include "util/parallel.h"

namespace {

using namespace ga_symmetry;

constexpr double kCorr = 0.01, kMean = 0.003;  // that a damage may cost

struct Figures {
  double mean = 0, corr = 0, coverage = 0, seconds = 0;
};

double thread_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// Row 0 is the whole mesh, row k + 1 that with damage k.
std::vector<Figures> measure_all(const std::string& path, std::uint64_t seed, bool automatic,
                                 const std::vector<damage::Kind>& kinds) {
  const TriangleMesh mesh = read_mesh(path);
  const auto known =
      comparison::read_known_symmetry(path, std::filesystem::path(path).parent_path().string(), mesh.vertices());
  std::vector<int> truth(mesh.vertices(), -1);
  for (const auto& [v, w] : known.truth) truth[v] = w;
  std::vector<Figures> out;
  std::vector<std::vector<int>> maps;  // of the whole mesh
  Truth lines = known.truth;           // what is left of it by every damage
  for (std::size_t k = 0; k <= kinds.size(); ++k) {
    const damage::Kind nothing{"", [](damage::Damaged&, Random&) {}};
    const damage::Damaged d = damage::damaged(mesh, truth, k == 0 ? nothing : kinds[k - 1], seed);
    Options options;
    options.threads = 1;
    options.seed = seed;
    // What a strip took away is no reference.
    if (!automatic) {
      for (const int a : known.references.axis)
        if (const int v = d.copy_of(a); v >= 0) options.references.axis.push_back(v);
      for (const auto& [l, r] : known.references.pairs)
        if (d.copy_of(l) >= 0 && d.copy_of(r) >= 0) options.references.pairs.push_back({d.copy_of(l), d.copy_of(r)});
    }
    const double begin = thread_seconds();
    std::vector<int> partner(d.mesh.vertices(), -1);
    try {
      partner = find_symmetry(d.mesh, options).partners.partner;
    } catch (const Error& e) {
      std::fprintf(stderr, "%s, damage %zu: %s\n", path.c_str(), k, e.what());
    }
    out.push_back({0, 0, damage::coverage(d, partner), thread_seconds() - begin});
    maps.push_back(damage::map_of_whole(d, partner));
    const Truth left = damage::truth_of_whole(d);
    Truth both;
    std::sort(lines.begin(), lines.end());
    std::set_intersection(lines.begin(), lines.end(), left.begin(), left.end(), std::back_inserter(both));
    lines = std::move(both);
  }
  const std::vector<Evaluation> evaluations = evaluate_partners(mesh, lines, maps, 1);
  for (std::size_t k = 0; k < out.size(); ++k) out[k].mean = evaluations[k].mean, out[k].corr = evaluations[k].corr;
  return out;
}

void run(const std::string& folder, std::uint64_t seed, int threads, const std::string& damage) {
  std::vector<std::string> meshes;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".off" || entry.path().extension() == ".ply")
      meshes.push_back(entry.path().string());
  std::sort(meshes.begin(), meshes.end());
  if (meshes.empty()) throw FileError("no meshes in " + folder);
  std::vector<damage::Kind> kinds;
  for (const damage::Kind& kind : damage::kinds())
    if (damage.empty() || kind.name == damage) kinds.push_back(kind);
  for (const damage::Kind& kind : damage::partial_kinds())
    if (damage == "partial" || kind.name == damage) kinds.push_back(kind);
  if (kinds.empty()) throw InvalidOption("no damage is called " + damage);
  const auto name = [&](std::size_t k) { return k == 0 ? std::string("whole") : kinds[k - 1].name; };
  for (const bool automatic : {false, true}) {
    std::vector<std::vector<Figures>> all(meshes.size());
    parallel_for(static_cast<int>(meshes.size()), threads, [&](int i, int) {
      all[i] = measure_all(meshes[i], seed, automatic, kinds);
      std::fprintf(stderr, "%s\n", meshes[i].c_str());
    });
    std::printf("%s, %zu meshes, seed %llu\n\n", automatic ? "Automatic" : "With references", meshes.size(),
                static_cast<unsigned long long>(seed));
    std::printf("| | mean error | corr | coverage | CPU s | mean rises by | corr falls by |\n");
    std::printf("| --- | ---: | ---: | ---: | ---: | ---: | ---: |\n");
    const double count = static_cast<double>(meshes.size());
    Figures whole;
    for (std::size_t k = 0; k <= kinds.size(); ++k) {
      Figures f;
      for (const auto& mesh : all)
        f.mean += mesh[k].mean / count, f.corr += mesh[k].corr / count, f.coverage += mesh[k].coverage / count,
            f.seconds += mesh[k].seconds / count;
      if (k == 0) whole = f;
      std::printf("| %s | %.4f | %.4f | %.4f | %.2f | %+.4f | %+.4f |\n", name(k).c_str(), f.mean, f.corr, f.coverage,
                  f.seconds, f.mean - whole.mean, whole.corr - f.corr);
    }
    std::printf("\n");
    for (std::size_t i = 0; i < meshes.size(); ++i)
      for (std::size_t k = 1; k <= kinds.size(); ++k)
        if (all[i][k].mean > all[i][0].mean + kMean || all[i][k].corr < all[i][0].corr - kCorr)
          std::printf("- %s, %s: mean %.4f -> %.4f, corr %.4f -> %.4f\n",
                      std::filesystem::path(meshes[i]).stem().c_str(), name(k).c_str(), all[i][0].mean, all[i][k].mean,
                      all[i][0].corr, all[i][k].corr);
    std::printf("\n");
    std::fflush(stdout);
  }
}

void write(const TriangleMesh& mesh, const std::string& path) {
  std::ofstream out(path, std::ios::binary);
  out << "ply\nformat binary_little_endian 1.0\nelement vertex " << mesh.vertices()
      << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << mesh.triangles()
      << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const double x : mesh.position) {
    const auto single = static_cast<float>(x);
    out.write(reinterpret_cast<const char*>(&single), sizeof single);
  }
  for (int f = 0; f < mesh.triangles(); ++f) {
    out.put(3);
    out.write(reinterpret_cast<const char*>(&mesh.triangle[3 * static_cast<std::size_t>(f)]), 3 * sizeof(int));
  }
  if (!out.flush()) throw FileError("cannot write " + path);
}

void make(const std::string& path, int levels, const std::string& out) {
  TriangleMesh mesh = read_mesh(path);
  for (int level = 0; level < levels; ++level) mesh = subdivided(mesh);
  Random random(1);
  damage::Damaged d = damage::whole(mesh, std::vector<int>(mesh.vertices(), -1)), clean = d;
  damage::finish(clean, random);
  write(clean.mesh, std::filesystem::path(out).replace_extension(".clean.ply").string());
  const double* p = &mesh.position[3 * static_cast<std::size_t>(mesh.triangle[0])];
  const double* q = &mesh.position[3 * static_cast<std::size_t>(mesh.triangle[1])];
  const double edge = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
  damage::add_noise(d, 0.2 * edge, random);
  damage::add_fins(d, mesh.triangles() / 100, random);
  damage::split_seams(d, 30, random);
  damage::add_debris(d, 200, random);
  damage::finish(d, random);
  write(d.mesh, out);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc == 5 && std::string(argv[1]) == "--make") {
      make(argv[2], std::atoi(argv[3]), argv[4]);
    } else if (argc >= 2 && argc <= 5 && argv[1][0] != '-') {
      run(argv[1], argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1, argc > 3 ? std::atoi(argv[3]) : 0,
          argc > 4 ? argv[4] : "");
    } else {
      std::fprintf(
          stderr,
          "usage: damage_bench FOLDER [SEED [THREADS [DAMAGE]]]\n       damage_bench --make MESH LEVELS OUT.ply\n");
      return 2;
    }
  } catch (const std::exception& e) {
    std::fprintf(stderr, "damage_bench: %s\n", e.what());
    return 1;
  }
}
