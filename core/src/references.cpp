// SPDX-License-Identifier: GPL-3.0-or-later
#include "ga_symmetry/references.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <nanoflann.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ga_symmetry/errors.h"
#include "ga_symmetry/options.h"
#include "ga_symmetry/symmetry.h"
#include "geodesics/geodesics.h"
#include "geodesics/sampling.h"
#include "surface/search_surface.h"
#include "surface/surface.h"
#include "util/text_scan.h"

namespace ga_symmetry {
namespace {

// Numbers, commas and colons; a word that is none of them as it stands.
std::vector<std::string_view> tokens(std::string_view text) {
  std::vector<std::string_view> out;
  for (std::string_view word : split(text))
    while (!word.empty()) {
      const std::size_t mark = word.find_first_of(",:");
      const std::size_t size = mark == 0 ? 1 : std::min(mark, word.size());
      out.push_back(word.substr(0, size));
      word.remove_prefix(size);
    }
  return out;
}

void check_repeats(const References& references) {
  const auto refuse = [](int v, const char* why) {
    throw InvalidOption("references name vertex " + std::to_string(v) + why);
  };
  const auto& axis = references.axis;
  const auto& pairs = references.pairs;
  for (std::size_t i = 0; i < axis.size(); ++i)
    if (std::find(axis.begin() + static_cast<std::ptrdiff_t>(i) + 1, axis.end(), axis[i]) != axis.end())
      refuse(axis[i], " twice on the axis: give each vertex once");
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (int v : pairs[i])
      if (std::find(axis.begin(), axis.end(), v) != axis.end())
        refuse(v, " on the axis and in a pair: a vertex on the axis is its own partner");
    if (pairs[i][0] == pairs[i][1]) refuse(pairs[i][0], " as its own partner: give it as an axis vertex");
    for (std::size_t j = 0; j < i; ++j)
      for (int side : {0, 1})
        if (pairs[i][side] == pairs[j][side])
          refuse(pairs[i][side], side == 0 ? " as the left one of two pairs" : " as the right one of two pairs");
  }
}

// One way to tell the roles of four vertices, by their number in the selection.
struct Reading {
  int a, b, c, d;  // axis a, b; pair c, d
};
constexpr Reading kReadings[] = {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}};

// Vertices that stand for the surface in the residual; more do not change it by more than a few percent.
constexpr int kProbes = 500;
// Residuals below this, over sqrt(area), are the noise of the mesh and of its distances.
constexpr double kNoise = 0.005;
// Ratio of the second best residual to the best from which the best is believed. Of 108 posed animals, people and
// things whose references are known it is below for every fourth. There the symmetries that both find are compared; by
// residuals alone four were wrong, at ratios of up to 2.8.
constexpr double kPlain = 3;
constexpr double kMoreConfident = 0.1;

// Distance between the distributions of two distance fields over the area (Wasserstein 1), unit of the surface.
double distribution_distance(const Surface& surface, const DistanceFields& fields, int i, int j) {
  std::vector<std::pair<float, double>> steps;
  steps.reserve(2 * static_cast<std::size_t>(surface.vertices()));
  for (int v = 0; v < surface.vertices(); ++v) {
    steps.push_back({fields(i, v), surface.vertex_area[v] / surface.area});
    steps.push_back({fields(j, v), -surface.vertex_area[v] / surface.area});
  }
  std::sort(steps.begin(), steps.end());
  double sum = 0, difference = 0;
  for (std::size_t k = 0; k + 1 < steps.size(); ++k) {
    difference += steps[k].second;
    sum += std::abs(difference) * (steps[k + 1].first - steps[k].first);
  }
  return sum;
}

// Per surface vertex its distances to the four references: a point in four dimensions, found by a k-d tree.
using FourDistances = Eigen::Matrix<float, 4, Eigen::Dynamic>;
using FourDistancesTree = nanoflann::KDTreeEigenMatrixAdaptor<FourDistances, 4, nanoflann::metric_L2, false>;

// A symmetry that exchanges c and d takes each vertex, with distances (a,b,c,d), to one with distances (a,b,d,c). This
// is the root mean square distance, over the probes, from the exchanged distances to the nearest that some vertex has.
// The four vertices' mutual distances alone do not tell: they are the same for several readings where the four lie like
// a square.
double exchange_residual(const FourDistances& distances, const FourDistancesTree& tree, const std::vector<int>& probes,
                         const Reading& reading) {
  double sum = 0;
  for (int probe : probes) {
    Eigen::Vector4f wanted = distances.col(probe);
    std::swap(wanted[reading.c], wanted[reading.d]);
    Eigen::Index vertex;
    float squared;
    tree.query(wanted.data(), 1, &vertex, &squared);
    sum += squared;
  }
  return std::sqrt(sum / static_cast<double>(probes.size()));
}

// 0 where none is found.
double confidence_with(const TriangleMesh& mesh, const References& references, const Options& options,
                       const Context& context) {
  Options with = options;
  with.references = references;
  with.rank = 1;
  with.method = Method::joint;  // the other has no confidence
  try {
    return find_symmetry(mesh, with, context).confidence;
  } catch (const InvalidMesh&) {
    return 0;
  }
}

}  // namespace

References parse_references(const std::string& text) {
  References references;
  const std::vector<std::string_view> token = tokens(text);
  const auto vertex = [&](std::size_t i) {
    const auto value = i < token.size() ? parse_number<int>(token[i]) : std::nullopt;
    if (!value || *value < 0)
      throw InvalidOption("references must be vertex indices such as 12,40,7,9 or 12,40,7:9, got " + quoted(text));
    return *value;
  };
  const auto is = [&](std::size_t i, const char* mark) { return i < token.size() && token[i] == mark; };
  bool colons = false;
  std::vector<int> plain;
  for (std::size_t i = 0; i < token.size();) {
    const int first = vertex(i++);
    if (is(i, ":")) {
      references.pairs.push_back({first, vertex(i + 1)});
      colons = true;
      i += 2;
    } else {
      plain.push_back(first);
    }
    if (is(i, ",")) vertex(++i);  // something must follow
  }
  if (!colons && plain.size() > 2) {
    if (plain.size() % 2)
      throw InvalidOption("references without a colon are two axis vertices and then pairs, an even number; got " +
                          std::to_string(plain.size()));
    for (std::size_t i = 2; i < plain.size(); i += 2) references.pairs.push_back({plain[i], plain[i + 1]});
    plain.resize(2);
  }
  references.axis = plain;
  check_repeats(references);
  return references;
}

References read_references(const std::string& path) {
  try {
    return parse_references(read_text(path));
  } catch (const std::runtime_error& error) {
    throw FileError("cannot read " + path + ": " + error.what());
  }
}

References references_from_selection(const TriangleMesh& mesh, const std::array<int, 4>& selected,
                                     const Options& options, const Context& context) {
  std::array<int, 4> vertex = selected;
  std::sort(vertex.begin(), vertex.end());
  for (int i = 0; i < 4; ++i) {
    if (vertex[i] < 0 || vertex[i] >= mesh.vertices())
      throw InvalidOption("selected vertex " + std::to_string(vertex[i]) + " is not one of the " +
                          std::to_string(mesh.vertices()) + " vertices");
    if (i > 0 && vertex[i] == vertex[i - 1])
      throw InvalidOption("vertex " + std::to_string(vertex[i]) + " is selected twice: select four different ones");
  }
  const SearchSurface search(make_surface(mesh, options.largest_component, context.part(0, 0.05)), options,
                             context.part(0.05, 0.3));
  const Surface& surface = search.searched();
  // Distances from where the four stand, between vertices: an edge more or less is as much as readings differ by.
  std::vector<int> sources = search.locate({{vertex[0], vertex[1], vertex[2], vertex[3]}, {}}).axis;
  std::vector<SurfacePoint> place;
  for (int i = 0; i < 4; ++i)
    place.push_back(search.direct() ? SurfacePoint{{sources[i], sources[i], sources[i]}, {1, 0, 0}}
                                    : search.place()[search.of_mesh().surface_vertex[vertex[i]]]);
  sources.clear();
  for (const SurfacePoint& p : place) sources.insert(sources.end(), p.vertex.begin(), p.vertex.end());
  const DistanceFields corner = GeodesicSolver(surface).fields(sources, options.threads, context.part(0.3, 0.4));
  DistanceFields fields = DistanceFields::Zero(4, surface.vertices());
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 3; ++k) fields.row(i) += static_cast<float>(place[i].weight[k]) * corner.row(3 * i + k);
  Random random(1);
  const std::vector<int> probes = uniform_sample_vertices(surface, std::min(kProbes, surface.vertices()), random);

  const FourDistances distances = fields;
  const FourDistancesTree tree(4, std::cref(distances));
  std::vector<std::pair<double, const Reading*>> ranking;
  for (const Reading& r : kReadings) {
    if (context.cancelled()) throw Cancelled();
    ranking.push_back(
        {(exchange_residual(distances, tree, probes, r) + distribution_distance(surface, fields, r.c, r.d)) /
             surface.unit(),
         &r});
  }
  std::sort(ranking.begin(), ranking.end());
  const auto read_as = [&](const Reading& r) {
    return References{{vertex[r.a], vertex[r.b]}, {{vertex[r.c], vertex[r.d]}}};
  };
  const Reading &best = *ranking[0].second, &second = *ranking[1].second;
  const double lead = (ranking[1].first + kNoise) / (ranking[0].first + kNoise);
  if (lead >= kPlain) return read_as(best);
  // Distances to four vertices alone do not say it: the symmetry that each of the two finds does.
  const double confidence[] = {confidence_with(mesh, read_as(best), options, context.part(0.4, 0.7)),
                               confidence_with(mesh, read_as(second), options, context.part(0.7, 1))};
  if (confidence[0] > confidence[1] + kMoreConfident) return read_as(best);
  if (confidence[1] > confidence[0] + kMoreConfident) return read_as(second);
  const auto axis = [&](const Reading& r) { return std::to_string(vertex[r.a]) + "," + std::to_string(vertex[r.b]); };
  const auto pair = [&](const Reading& r) { return std::to_string(vertex[r.c]) + "," + std::to_string(vertex[r.d]); };
  char residuals[64];
  std::snprintf(residuals, sizeof residuals, " (residuals %.3f and %.3f)", ranking[0].first, ranking[1].first);
  throw InvalidOption("the selection can be read with " + axis(best) + " or " + axis(second) + " on the axis" +
                      residuals + ": select other vertices, or give the references as " + axis(best) + "," +
                      pair(best) + " or " + axis(second) + "," + pair(second));
}

}  // namespace ga_symmetry
