#include "ga_symmetry/evaluation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ga_symmetry/errors.h"
#include "ga_symmetry/geodesics.h"
#include "ga_symmetry/parallel.h"
#include "ga_symmetry/surface.h"
#include "text_scan.h"

namespace ga_symmetry {
namespace {

// Distances between chosen pairs of mesh vertices, over sqrt(area); infinite where there is no way.
std::vector<double> distances(const Surface& surface, const std::vector<std::array<int, 2>>& ends, int threads) {
  std::vector<int> at(static_cast<std::size_t>(surface.mesh_vertices), -1);
  for (int v = 0; v < surface.vertices(); ++v) at[surface.mesh_vertex[v]] = v;
  const GeodesicSolver solver(surface);
  std::vector<GeodesicSolver::WorkspacePointer> workspace(thread_count(threads));
  std::vector<std::vector<float>> field(workspace.size());
  std::vector<double> out(ends.size(), std::numeric_limits<double>::infinity());
  parallel_for(static_cast<int>(ends.size()), threads, [&](int i, int worker) {
    const int from = at[ends[i][0]], to = at[ends[i][1]];
    if (from < 0 || to < 0) return;
    if (!workspace[worker]) {
      workspace[worker] = solver.make_workspace();
      field[worker].resize(static_cast<std::size_t>(surface.vertices()));
    }
    solver.field(from, field[worker].data(), *workspace[worker]);
    out[i] = field[worker][to] / surface.unit();
  });
  return out;
}

}  // namespace

const double correspondence_radius = std::sqrt(1 / (20 * std::acos(-1.0)));

Evaluation evaluate_partners(const TriangleMesh& mesh, const Truth& truth, const std::vector<int>& partner,
                             int threads) {
  const int n = mesh.vertices();
  if (truth.empty()) throw InvalidOption("the truth has no lines");
  if (partner.size() != static_cast<std::size_t>(n))
    throw InvalidOption("there are partners of " + std::to_string(partner.size()) + " vertices, the mesh has " +
                        std::to_string(n));
  for (const auto& line : truth)
    for (int v : line)
      if (v < 0 || v >= n)
        throw InvalidOption("the truth names vertex " + std::to_string(v) + " of " + std::to_string(n));
  for (int w : partner)
    if (w < -1 || w >= n) throw InvalidOption("a partner is vertex " + std::to_string(w) + " of " + std::to_string(n));
  const Surface surface = make_surface(mesh, true);

  Truth sorted = truth;  // by true partner, so that every part of the surface is met
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a[1] < b[1]; });
  Evaluation out;
  std::vector<std::array<int, 2>> ends;
  for (std::size_t i = 0, stride = std::max<std::size_t>(1, truth.size() / 1000); i < sorted.size(); i += stride) {
    ++out.lines;
    if (const int found = partner[sorted[i][0]]; found >= 0) ends.push_back({sorted[i][1], found});
  }
  double sum = static_cast<double>(out.lines - ends.size());
  std::size_t hits = 0;
  for (double error : distances(surface, ends, threads)) {
    sum += std::isfinite(error) ? error : 1;
    hits += error < correspondence_radius;
  }
  out.mean = sum / static_cast<double>(out.lines);
  out.corr = static_cast<double>(hits) / static_cast<double>(out.lines);
  out.coverage = static_cast<double>(std::count_if(partner.begin(), partner.end(), [](int w) { return w >= 0; })) / n;

  ends.clear();
  int asked = 0;
  for (int v = 0; v < n; v += std::max(1, n / 200), ++asked)
    if (const int w = partner[v]; w >= 0 && partner[w] >= 0) ends.push_back({v, partner[w]});
  const std::vector<double> back = distances(surface, ends, threads);
  out.involution =
      static_cast<double>(std::count_if(back.begin(), back.end(), [](double d) { return d < correspondence_radius; })) /
      asked;
  return out;
}

Truth read_truth(const std::string& path) {
  try {
    const std::string text = read_text(path);
    Truth truth;
    LineReader lines(text);
    for (std::string_view line; lines.next(line);) {
      const std::vector<std::string_view> words = split(line);
      if (words.empty()) continue;
      const auto v = parse_number<int>(words[0]);
      const auto w = words.size() == 2 ? parse_number<int>(words[1]) : std::nullopt;
      if (!v || !w) throw FileError("line " + std::to_string(lines.number()) + ": expected two vertices `v w`");
      truth.push_back({*v, *w});
    }
    return truth;
  } catch (const FileError& error) {
    throw FileError("cannot read " + path + ": " + error.what());
  }
}

}  // namespace ga_symmetry
