// SPDX-License-Identifier: GPL-3.0-or-later
#include "ga_symmetry/asymmetry.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "ga_symmetry/errors.h"
#include "geodesics/geodesics.h"
#include "partners/partnered_surface.h"
#include "surface/curvature.h"
#include "util/parallel.h"

namespace ga_symmetry {
namespace {

// What the vertices whose partner is v hold together: the other side's, laid onto this side.
std::vector<double> received(const std::vector<double>& values, const std::vector<int>& partner) {
  std::vector<double> out(values.size(), 0.0);
  for (std::size_t v = 0; v < values.size(); ++v)
    if (partner[v] >= 0) out[partner[v]] += values[v];
  return out;
}

double over_mean(double own, double other) { return own + other > 0 ? 2 * (own - other) / (own + other) : 0; }

// The vertices around one, nearest weigh most.
class Disc {
 public:
  Disc(const GeodesicSolver& solver, int vertices)
      : solver_(solver), workspace_(solver.make_workspace()), distance_(vertices, INFINITY) {}
  void fill(int centre, float radius) {
    radius_ = radius;
    solver_.field_within(centre, radius, distance_.data(), reached_, *workspace_);
  }
  const std::vector<int>& vertices() const { return reached_; }
  double distance(int v) const { return distance_[v]; }
  double weight(int v) const {
    const double d = distance_[v] / radius_;
    return d < 1 ? 1 - d * d : 0;
  }
  double integral(const std::vector<double>& values) const {
    double sum = 0;
    for (const int v : reached_) sum += weight(v) * values[v];
    return sum;
  }

 private:
  const GeodesicSolver& solver_;
  GeodesicSolver::WorkspacePointer workspace_;
  std::vector<float> distance_;
  std::vector<int> reached_;
  double radius_ = 1;
};

}  // namespace

std::vector<double> asymmetry(const TriangleMesh& mesh, const Partners& partners, const AsymmetryOptions& options,
                              const Context& context) {
  if (!(options.radius > 0 && options.radius <= 1))
    throw InvalidOption("the radius must be in (0,1], over sqrt(area), got " + std::to_string(options.radius));
  if (options.threads < 0 || options.threads > 256)
    throw InvalidOption("threads must be in [0,256], got " + std::to_string(options.threads));
  const PartneredSurface shape(mesh, partners);
  const Surface& surface = shape.surface;
  const std::vector<int>& partner = shape.partners.partner;
  const std::vector<double>& area = surface.vertex_area;
  const std::vector<double> other_area = received(area, partner);
  std::vector<double> bend, other_bend;
  if (options.measure == AsymmetryMeasure::curvature) {
    bend = integrated_mean_curvature(surface);
    other_bend = received(bend, partner);
  }
  const auto radius = static_cast<float>(options.radius * surface.unit());

  const GeodesicSolver solver(surface);
  struct Worker {
    Disc own, other;
  };
  std::vector<std::unique_ptr<Worker>> workers(static_cast<std::size_t>(thread_count(options.threads)));
  std::vector<double> values(static_cast<std::size_t>(surface.vertices()), 0.0);
  parallel_for(surface.vertices(), options.threads, [&](int v, int number) {
    if (context.cancelled()) throw Cancelled();
    if (number == 0) context.report(static_cast<double>(v) / surface.vertices(), "asymmetry");  // the calling thread
    if (partner[v] < 0) return;
    if (!workers[number])
      workers[number].reset(new Worker{Disc(solver, surface.vertices()), Disc(solver, surface.vertices())});
    auto& [own, other] = *workers[number];
    own.fill(v, radius);
    double& value = values[v];
    switch (options.measure) {
      case AsymmetryMeasure::area:
        value = over_mean(own.integral(area), own.integral(other_area));
        break;
      case AsymmetryMeasure::curvature: {
        const double a = own.integral(area), b = own.integral(other_area);
        if (a > 0 && b > 0) value = surface.unit() * (own.integral(bend) / a - own.integral(other_bend) / b);
        break;
      }
      case AsymmetryMeasure::length: {
        other.fill(partner[v], 2 * radius);
        double here = 0, there = 0;
        for (const int u : own.vertices()) {
          if (partner[u] < 0 || !std::isfinite(other.distance(partner[u]))) continue;
          const double weight = own.weight(u) * area[u];
          here += weight * own.distance(u);
          there += weight * other.distance(partner[u]);
        }
        value = over_mean(here, there);
        break;
      }
    }
  });
  std::vector<double> out(static_cast<std::size_t>(mesh.vertices()), 0.0);
  for (int m = 0; m < mesh.vertices(); ++m)
    if (surface.surface_vertex[m] >= 0) out[m] = values[surface.surface_vertex[m]];
  return out;
}

}  // namespace ga_symmetry
