// SPDX-License-Identifier: GPL-3.0-or-later
// ablation_bench FOLDER [SEED]: what every term, operator and stage of the joint search is worth. Each is switched off
// in turn; over all meshes of the folder with a known symmetry (see dataset.h) the means are printed as a Markdown
// table.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include "dataset.h"
#include "ga_symmetry/errors.h"
#include "ga_symmetry/io.h"
#include "util/parallel.h"

namespace {

using namespace ga_symmetry;

struct Variant {
  const char* name;
  std::function<void(Options&)> change;
};

const std::vector<Variant> variants{
    {"all", [](Options&) {}},
    {"no distance term", [](Options& o) { o.joint.distance_weight = 0; }},
    {"no orientation term", [](Options& o) { o.joint.orientation_weight = 0; }},
    {"no continuity term", [](Options& o) { o.joint.continuity_weight = 0; }},
    {"no descriptor term", [](Options& o) { o.joint.descriptor_weight = 0; }},
    {"no bijectivity term", [](Options& o) { o.joint.bijectivity_weight = 0; }},
    {"no reference term", [](Options& o) { o.joint.reference_weight = 0; }},
    {"no generations: the best seed", [](Options& o) { o.joint.max_generations = 0; }},
    {"no turned regions", [](Options& o) { o.joint.turn_probability = 0; }},
    {"no ruin and recreate", [](Options& o) { o.joint.ruin_probability = 0; }},
    {"no crossover", [](Options& o) { o.joint.ruin_probability = 1; }},
    {"no mutation", [](Options& o) { o.joint.mutation_probability = 0; }},
    {"no relocation of outliers", [](Options& o) { o.joint.outlier_z = 1e6; }},
    {"no local refinement", [](Options& o) { o.local_refinement = false; }},
    {"no noise filter", [](Options& o) { o.noise_filter = false; }},
    {"no spectral refinement", [](Options& o) { o.spectral_refinement = false; }},
};

struct Figures {
  double mean = 0, corr = 0, involution = 0, rank_correlation = 0, best_80 = 0, seconds = 0;
  int meshes = 0;  // with corr > 0.75
};

double thread_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// Ranks from 0; equal values share their mean rank.
std::vector<double> ranks(const std::vector<double>& x) {
  std::vector<int> order(x.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return x[a] < x[b]; });
  std::vector<double> out(x.size());
  for (std::size_t first = 0, last; first < order.size(); first = last) {
    for (last = first; last < order.size() && x[order[last]] == x[order[first]];) ++last;
    for (std::size_t i = first; i < last; ++i) out[order[i]] = 0.5 * static_cast<double>(first + last - 1);
  }
  return out;
}

// Spearman's; 0 where one side is constant.
double rank_correlation(const std::vector<double>& x, const std::vector<double>& y) {
  const std::vector<double> a = ranks(x), b = ranks(y);
  const double middle = 0.5 * static_cast<double>(x.size() - 1);
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    ab += (a[i] - middle) * (b[i] - middle), aa += (a[i] - middle) * (a[i] - middle),
        bb += (b[i] - middle) * (b[i] - middle);
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

// The mean error of the 80 % whose fitness is best.
double best_80(const std::vector<double>& fitness, const std::vector<double>& error) {
  std::vector<int> order(error.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return fitness[a] < fitness[b]; });
  order.resize(order.size() * 4 / 5);
  double sum = 0;
  for (int i : order) sum += error[i];
  return sum / static_cast<double>(order.size());
}

// All variants of one mesh, one after the other.
std::vector<Figures> measure(const std::string& path, std::uint64_t seed, bool automatic) {
  const TriangleMesh mesh = read_mesh(path);
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const comparison::KnownSymmetry known = comparison::read_known_symmetry(path, folder, mesh.vertices());
  std::vector<Figures> out;
  std::vector<Result> results;
  for (const Variant& variant : variants) {
    Options options;
    options.threads = 1;
    options.seed = seed;
    if (!automatic) options.references = known.references;
    variant.change(options);
    const double begin = thread_seconds();
    results.push_back(find_symmetry(mesh, options));
    out.emplace_back().seconds = thread_seconds() - begin;
  }
  std::vector<std::vector<int>> partners;
  for (const Result& r : results) partners.push_back(r.partners.partner);
  const std::vector<Evaluation> evaluations = evaluate_partners(mesh, known.truth, partners, 1);
  for (std::size_t k = 0; k < out.size(); ++k) {
    const Evaluation& e = evaluations[k];
    std::vector<double> fitness;
    for (int v : e.vertex) fitness.push_back(results[k].partners.fitness[v]);
    out[k] = {e.mean,         e.corr,       e.involution, rank_correlation(fitness, e.error), best_80(fitness, e.error),
              out[k].seconds, e.corr > 0.75};
  }
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::fprintf(stderr, "usage: ablation_bench FOLDER [SEED]\n");
    return 2;
  }
  try {
    const std::uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
    std::vector<std::string> meshes;
    for (const auto& entry : std::filesystem::directory_iterator(argv[1]))
      if (entry.path().extension() == ".off" || entry.path().extension() == ".ply")
        meshes.push_back(entry.path().string());
    std::sort(meshes.begin(), meshes.end());
    if (meshes.empty()) throw FileError(std::string("no meshes in ") + argv[1]);
    for (bool automatic : {false, true}) {
      std::vector<std::vector<Figures>> all(meshes.size());
      parallel_for(static_cast<int>(meshes.size()), 0,
                   [&](int i, int) { all[i] = measure(meshes[i], seed, automatic); });
      std::printf("%s, %zu meshes, seed %llu\n\n", automatic ? "Automatic" : "With references", meshes.size(),
                  static_cast<unsigned long long>(seed));
      std::printf("| | mean error | corr | meshes right | involution | fitness and error | best 80 %% | CPU s |\n");
      std::printf("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
      const double count = static_cast<double>(meshes.size());
      for (std::size_t k = 0; k < variants.size(); ++k) {
        Figures sum;
        for (const auto& mesh : all) {
          const Figures& f = mesh[k];
          sum.mean += f.mean, sum.corr += f.corr, sum.involution += f.involution, sum.best_80 += f.best_80;
          sum.rank_correlation += f.rank_correlation, sum.seconds += f.seconds, sum.meshes += f.meshes;
        }
        std::printf("| %s | %.4f | %.3f | %d | %.3f | %.2f | %.4f | %.1f |\n", variants[k].name, sum.mean / count,
                    sum.corr / count, sum.meshes, sum.involution / count, sum.rank_correlation / count,
                    sum.best_80 / count, sum.seconds / count);
      }
      std::printf("\n");
      std::fflush(stdout);
    }
  } catch (const std::exception& e) {
    std::fprintf(stderr, "ablation_bench: %s\n", e.what());
    return 1;
  }
}
