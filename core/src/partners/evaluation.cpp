// SPDX-License-Identifier: GPL-3.0-or-later
#include "ga_symmetry/evaluation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>

#include "ga_symmetry/errors.h"
#include "surface/surface.h"
#include "util/parallel.h"
#include "util/text_scan.h"

namespace ga_symmetry {
namespace {

// First-order fast marching on the mesh as it stands in its file: components, borders and all.
class Ruler {
 public:
  explicit Ruler(const TriangleMesh& mesh)
      : n_(mesh.vertices()), triangle_(mesh.triangle), first_(n_ + 1), corner_at_(triangle_.size()) {
    for (int v : triangle_) {
      if (v < 0 || v >= n_)
        throw InvalidMesh("a triangle names vertex " + std::to_string(v) + " of " + std::to_string(n_) +
                          ": repair the mesh");
      ++first_[v + 1];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<int> at(first_.begin(), first_.end() - 1);
    double area = 0;
    for (int c = 0; c < static_cast<int>(triangle_.size()); ++c) {
      corner_at_[at[triangle_[c]]++] = c;
      const double *p = &mesh.position[3 * static_cast<std::size_t>(triangle_[next_corner(c)])],
                   *q = &mesh.position[3 * static_cast<std::size_t>(triangle_[previous_corner(c)])];
      opposite_.push_back(
          std::sqrt((p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]) + (p[2] - q[2]) * (p[2] - q[2])));
    }
    for (int c = 0; c < static_cast<int>(triangle_.size()); ++c) {
      const double far = opposite_[c], a = opposite_[next_corner(c)], b = opposite_[previous_corner(c)];
      cosine_.push_back(std::clamp((a * a + b * b - far * far) / std::max(1e-300, 2 * a * b), -1.0, 1.0));
      const double half = (far + a + b) / 2;
      if (c % 3 == 0) area += std::sqrt(std::max(0.0, half * (half - far) * (half - a) * (half - b)));
    }
    unit_ = std::sqrt(area);
  }

  double unit() const { return unit_; }

  // Distances from a vertex to all; infinite where there is no way.
  void field(int source, std::vector<double>& d) const {
    d.assign(n_, std::numeric_limits<double>::infinity());
    std::vector<char> done(n_, 0);
    using Item = std::pair<double, int>;
    std::priority_queue<Item, std::vector<Item>, std::greater<Item>> queue;
    d[source] = 0;
    queue.push({0, source});
    while (!queue.empty()) {
      const int v = queue.top().second;
      queue.pop();
      if (done[v]) continue;
      done[v] = 1;
      for (int i = first_[v]; i < first_[v + 1]; ++i) {
        const int corner = corner_at_[i], next = next_corner(corner), previous = previous_corner(corner);
        for (const auto& [target, other] : {std::pair(next, previous), std::pair(previous, next)}) {
          const int w = triangle_[target], o = triangle_[other];
          if (done[w]) continue;
          double now = d[v] + opposite_[other];
          if (done[o]) {
            const double from_v = opposite_[other], from_o = opposite_[corner], cosine = cosine_[target];
            now = std::min(now, d[v] <= d[o] ? arrival(from_v, d[v], from_o, d[o], cosine)
                                             : arrival(from_o, d[o], from_v, d[v], cosine));
          }
          if (now < d[w]) queue.push({d[w] = now, w});
        }
      }
    }
  }

 private:
  // When a straight front that passed one end of a triangle's edge at `early` and the other at `late` arrives at the
  // third corner, which is `b` and `a` away from them under an angle of that cosine.
  static double arrival(double b, double early, double a, double late, double cosine) {
    const double u = late - early;
    const double x2 = a * a + b * b - 2 * a * b * cosine, x1 = 2 * b * u * (a * cosine - b);
    const double x0 = b * b * (u * u - a * a * (1 - cosine * cosine));
    const double along = std::min(early + b, late + a), square = x1 * x1 - 4 * x2 * x0;
    if (square < 0 || x2 <= 0) return along;
    const double t = (-x1 + std::sqrt(square)) / (2 * x2);
    const double q = t > 0 ? b * (t - u) / t : -1;
    const bool inside = u < t && a * cosine < q && (cosine <= 0 || q < a / cosine);
    return inside ? early + t : along;
  }

  int n_;
  const std::vector<int>& triangle_;
  std::vector<int> first_, corner_at_;     // corners around each vertex
  std::vector<double> opposite_, cosine_;  // per corner: length of the edge opposite, cosine of its angle
  double unit_ = 0;
};

}  // namespace

const double correspondence_radius = std::sqrt(1 / (20 * std::acos(-1.0)));

std::vector<Evaluation> evaluate_partners(const TriangleMesh& mesh, const Truth& truth,
                                          const std::vector<std::vector<int>>& partners, int threads,
                                          const Context& context) {
  const int n = mesh.vertices();
  if (truth.empty()) throw InvalidOption("the truth has no lines");
  for (const auto& line : truth)
    for (int v : line)
      if (v < 0 || v >= n)
        throw InvalidOption("the truth names vertex " + std::to_string(v) + " of " + std::to_string(n));
  for (const auto& partner : partners) {
    if (partner.size() != static_cast<std::size_t>(n))
      throw InvalidOption("there are partners of " + std::to_string(partner.size()) + " vertices, the mesh has " +
                          std::to_string(n));
    for (int w : partner)
      if (w < -1 || w >= n)
        throw InvalidOption("a partner is vertex " + std::to_string(w) + " of " + std::to_string(n));
  }
  const Ruler ruler(mesh);

  Truth lines;  // by true partner, so that every part of the surface is met
  {
    Truth sorted = truth;
    std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a[1] < b[1]; });
    for (std::size_t i = 0, stride = std::max<std::size_t>(1, truth.size() / 1000); i < sorted.size(); i += stride)
      lines.push_back(sorted[i]);
  }
  std::vector<int> sources;
  for (const auto& line : lines) sources.push_back(line[1]);
  for (int v = 0; v < n; v += std::max(1, n / 200)) sources.push_back(v);

  const std::size_t asked = sources.size() - lines.size();
  std::vector<Evaluation> out(partners.size());
  for (Evaluation& e : out) {
    e.lines = lines.size();
    for (const auto& line : lines) e.vertex.push_back(line[0]);
    e.error.assign(lines.size(), 1.0);
  }
  std::vector<std::vector<char>> returns(partners.size(), std::vector<char>(asked, 0));
  std::vector<std::vector<double>> field(thread_count(threads));
  parallel_for(static_cast<int>(sources.size()), threads, [&](int i, int worker) {
    if (context.cancelled()) throw Cancelled();
    std::vector<double>& d = field[worker];
    ruler.field(sources[i], d);
    const std::size_t line = static_cast<std::size_t>(i);
    for (std::size_t k = 0; k < partners.size(); ++k) {
      const std::vector<int>& partner = partners[k];
      if (line < lines.size()) {
        const int found = partner[lines[line][0]];
        if (found >= 0 && std::isfinite(d[found])) out[k].error[line] = d[found] / ruler.unit();
      } else {
        const int w = partner[sources[i]], back = w >= 0 ? partner[w] : -1;
        returns[k][line - lines.size()] = back >= 0 && d[back] / ruler.unit() < correspondence_radius;
      }
    }
  });
  for (std::size_t k = 0; k < partners.size(); ++k) {
    const auto share = [](auto count, auto of) { return static_cast<double>(count) / static_cast<double>(of); };
    Evaluation& e = out[k];
    e.mean = std::accumulate(e.error.begin(), e.error.end(), 0.0) / static_cast<double>(lines.size());
    e.corr = share(std::count_if(e.error.begin(), e.error.end(), [](double x) { return x < correspondence_radius; }),
                   lines.size());
    e.coverage =
        share(std::count_if(partners[k].begin(), partners[k].end(), [](int w) { return w >= 0; }), partners[k].size());
    e.involution = share(std::count(returns[k].begin(), returns[k].end(), 1), asked);
  }
  return out;
}

Evaluation evaluate_partners(const TriangleMesh& mesh, const Truth& truth, const std::vector<int>& partner,
                             int threads) {
  return evaluate_partners(mesh, truth, std::vector<std::vector<int>>{partner}, threads)[0];
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
