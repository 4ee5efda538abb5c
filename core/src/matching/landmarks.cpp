#include "matching/landmarks.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "ga_symmetry/errors.h"
#include "matching/matcher.h"
#include "surface/tangent_plane.h"

namespace ga_symmetry {
namespace {

// Computes the fields of the images that have moved.
void update_fields(const GeodesicSolver& solver, RefinedLandmarks& landmarks, const std::vector<int>& moved,
                   int threads, const Context& context) {
  std::vector<int> sources;
  for (int i : moved) sources.push_back(landmarks.landmarks.to[i]);
  const DistanceFields field = solver.fields(sources, threads, {nullptr, context.cancel});
  for (std::size_t k = 0; k < moved.size(); ++k) landmarks.to_field.row(moved[k]) = field.row(static_cast<int>(k));
}

// The stress of landmarks and the step that lowers it. With x the landmarks and y their images, the differences are
//   d(y_i, y_j) - d(x_i, x_j)   and, as a reflection also takes y to x,   d(y_i, x_j) - d(y_j, x_i).
class Adjustment {
 public:
  Adjustment(const Surface& surface, const DistanceFields& fields, const CurvatureFeatures& curvature,
             const RefineOptions& options)
      : surface_(surface), fields_(fields), curvature_(curvature), options_(options), unit_(surface.unit()) {}

  double stress(const RefinedLandmarks& at) const { return accumulate(at, nullptr); }

  /// Linearises at the landmarks.
  void linearize(const RefinedLandmarks& at, int threads) {
    System& s = system_;
    const int size = 2 * static_cast<int>(at.landmarks.to.size());
    s.to = directions(surface_, at.landmarks.to, at.to_field, threads);
    s.from = directions(surface_, at.landmarks.to, fields_, threads);
    s.normal = Eigen::MatrixXd::Zero(size, size);
    s.right = Eigen::VectorXd::Zero(size);
    accumulate(at, &s);
    s.scale = s.normal.trace() / size;
    for (int k = size - 2 * options_.fixed; k < size; ++k) s.normal(k, k) += 1e6 * s.scale;  // stay
  }

  /// The images after a step, without their fields. @return which have moved
  std::vector<int> step(const RefinedLandmarks& at, const Features& features, double damping,
                        std::vector<int>& to) const {
    constexpr double kLongest = 0.06;  // units; directions hold near by
    const System& s = system_;
    Eigen::MatrixXd normal = s.normal;
    normal.diagonal().array() += damping * s.scale;
    const Eigen::VectorXd move = -normal.ldlt().solve(s.right);
    Matcher matcher(surface_, features, {kCoarse.near2, kCoarse.power, 0});
    const int count = static_cast<int>(at.landmarks.to.size());
    std::vector<float> wanted(features.dimension);
    std::vector<int> moved;
    for (int i = 0; i < count - options_.fixed; ++i) {
      Eigen::Vector2d t = move.segment<2>(2 * i);
      if (t.norm() > kLongest) t *= kLongest / t.norm();
      // The vertex whose distances have changed as they do along the step.
      const float* here = features.of(features.target, at.landmarks.to[i]);
      std::copy(here, here + features.dimension, wanted.begin());
      const auto shift = [&](int first, const std::pair<Table, Table>& towards) {
        for (int j = 0; j < count; ++j)
          wanted[first + j] -= static_cast<float>(towards.first(i, j) * t[0] + towards.second(i, j) * t[1]);
      };
      shift(0, s.to);
      if (options_.reflection) shift(count, s.from);
      matcher.look_for(wanted.data());
      float least;
      to[i] = matcher.descend(at.landmarks.to[i], least);
      if (to[i] != at.landmarks.to[i]) moved.push_back(i);
    }
    return moved;
  }

 private:
  struct System {
    std::pair<Table, Table> to, from;  // at image i: directions to image j, to landmark j
    Eigen::MatrixXd normal;
    Eigen::VectorXd right;
    double scale = 0;  // mean diagonal
  };

  double accumulate(const RefinedLandmarks& at, System* system) const {
    constexpr double kCap = 0.01;  // units^2: what is lost or added on one side says nothing of the rest
    const std::vector<int>&x = at.landmarks.from, &y = at.landmarks.to;
    const int count = static_cast<int>(x.size());
    Eigen::MatrixXd before(count, count), after(count, count), across(count, count);
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < count; ++j) {
        before(i, j) = (fields_(j, x[i]) + fields_(i, x[j])) / (2 * unit_);
        after(i, j) = (at.to_field(j, y[i]) + at.to_field(i, y[j])) / (2 * unit_);
        across(i, j) = fields_(j, y[i]) / unit_;
      }
    Eigen::MatrixXd slack;  // (i, j): of after - before above the diagonal, of across - its transpose below
    if (options_.shortcuts && !options_.shortcuts->none()) {
      const Eigen::MatrixXd slack_before = slacks(fields_, x), slack_across = slacks(fields_, y),
                            slack_after = slacks(at.to_field, y);
      before -= (slack_before + slack_before.transpose()) / 2;
      after -= (slack_after + slack_after.transpose()) / 2;
      across -= slack_across;
      slack.resize(count, count);
      for (int i = 0; i < count; ++i)
        for (int j = i + 1; j < count; ++j) {
          slack(i, j) = (slack_before(i, j) + slack_before(j, i) + slack_after(i, j) + slack_after(j, i)) / 2;
          slack(j, i) = slack_across(i, j) + slack_across(j, i);
        }
    }
    const auto weight = [](const Eigen::MatrixXd& d) -> Eigen::MatrixXd {
      return (d.array().square() + kFine.near2).pow(-kFine.power / 2).matrix();
    };
    Eigen::MatrixXd weight_after = weight(before), weight_across = weight((across + across.transpose()) / 2);
    if (!options_.reflection) weight_across.setZero();
    const Eigen::ArrayXd share = (weight_after + weight_across).rowwise().sum().array().inverse();
    double sum = 0;
    const auto beyond_slack = [&](double difference, int i, int j) {
      if (slack.size() == 0) return difference;
      return difference - std::clamp(difference, -slack(i, j), slack(i, j));
    };
    const auto add = [&](int i, int j, double difference, double w, double a, double b, double c, double d) {
      sum += w * std::min(kCap, difference * difference);
      if (!system || difference * difference > kCap || (difference == 0 && slack.size() > 0)) return;
      const Eigen::Vector2d gi(a, b), gj(c, d);
      Eigen::MatrixXd& normal = system->normal;
      normal.block<2, 2>(2 * i, 2 * i) += w * gi * gi.transpose();
      normal.block<2, 2>(2 * j, 2 * j) += w * gj * gj.transpose();
      normal.block<2, 2>(2 * i, 2 * j) += w * gi * gj.transpose();
      normal.block<2, 2>(2 * j, 2 * i) += w * gj * gi.transpose();
      system->right.segment<2>(2 * i) += w * difference * gi;
      system->right.segment<2>(2 * j) += w * difference * gj;
    };
    const auto towards = [](const std::pair<Table, Table>* table, int i, int j) {
      return table ? Eigen::Vector2d(table->first(i, j), table->second(i, j)) : Eigen::Vector2d::Zero().eval();
    };
    const std::pair<Table, Table>*to = system ? &system->to : nullptr, *from = system ? &system->from : nullptr;
    for (int i = 0; i < count; ++i)
      for (int j = i + 1; j < count; ++j) {
        const double both = share[i] + share[j];
        const Eigen::Vector2d ij = towards(to, i, j), ji = towards(to, j, i);
        add(i, j, beyond_slack(after(i, j) - before(i, j), i, j), both * weight_after(i, j), -ij[0], -ij[1], -ji[0],
            -ji[1]);
        if (!options_.reflection) continue;
        const Eigen::Vector2d p = towards(from, i, j), q = towards(from, j, i);
        add(i, j, beyond_slack(across(i, j) - across(j, i), j, i), both * weight_across(i, j), -p[0], -p[1], q[0],
            q[1]);
      }
    const double curvature_weight = options_.curvature / kCurvatureFeatures;
    for (int i = 0; curvature_weight > 0 && i < count - options_.fixed; ++i) {
      const Eigen::VectorXd difference = (curvature_.row(y[i]) - curvature_.row(x[i])).cast<double>().transpose();
      sum += curvature_weight * difference.squaredNorm();
      if (!system) continue;
      const TangentPlane plane(surface_, y[i]);
      for (int k = 0; k < kCurvatureFeatures; ++k) {
        const Eigen::Vector2d g = unit_ * plane.gradient([&](int v) { return double{curvature_(v, k)}; });
        system->normal.block<2, 2>(2 * i, 2 * i) += curvature_weight * g * g.transpose();
        system->right.segment<2>(2 * i) += curvature_weight * difference[k] * g;
      }
    }
    return sum / count;
  }

  // (i, j) is that of field j at vertex i.
  Eigen::MatrixXd slacks(const DistanceFields& fields, const std::vector<int>& vertices) const {
    Eigen::MatrixXd out(vertices.size(), fields.rows());
    for (Eigen::Index j = 0; j < fields.rows(); ++j) {
      const auto slack = options_.shortcuts->slack(fields.row(j).data());
      for (std::size_t i = 0; i < vertices.size(); ++i)
        out(static_cast<Eigen::Index>(i), j) = slack(vertices[i]) / unit_;
    }
    return out;
  }

  const Surface& surface_;
  const DistanceFields& fields_;
  const CurvatureFeatures& curvature_;
  const RefineOptions& options_;
  const double unit_;
  System system_;
};

}  // namespace

RefinedLandmarks refine_landmarks(const Surface& surface, const GeodesicSolver& solver, RefinedLandmarks start,
                                  const DistanceFields& fields, const CurvatureFeatures& curvature,
                                  const RefineOptions& options, int threads, const Context& context) {
  RefinedLandmarks out = std::move(start);
  const float unit = static_cast<float>(surface.unit());
  std::vector<int>& to = out.landmarks.to;
  const int movable = static_cast<int>(to.size()) - options.fixed;
  for (int round = 0; round < options.rounds; ++round) {
    const Features features =
        make_features(fields, out.to_field, curvature, unit, options.reflection, options.shortcuts, threads);
    Matcher matcher(surface, features, kCoarse);
    std::vector<int> moved;
    for (int i = 0; i < movable; ++i) {
      matcher.look_at(out.landmarks.from[i]);
      float e;
      const int better = matcher.descend(to[i], e);
      if (better == to[i]) continue;
      to[i] = better;
      moved.push_back(i);
    }
    if (moved.empty()) break;
    update_fields(solver, out, moved, threads, context);
  }
  return out;
}

RefinedLandmarks adjust_landmarks(const Surface& surface, const GeodesicSolver& solver, RefinedLandmarks start,
                                  const DistanceFields& fields, const CurvatureFeatures& curvature,
                                  const RefineOptions& options, int threads, const Context& context) {
  constexpr double kLeastDamping = 0.02, kMostDamping = 2;
  constexpr double kWorthwhile = 0.01;  // of the stress: a step that lowers it by less is the last
  RefinedLandmarks out = std::move(start);
  Adjustment adjustment(surface, fields, curvature, options);
  double stress = adjustment.stress(out), damping = kLeastDamping;
  bool fresh = true;
  Features features;
  for (int step = 0; step < options.steps && damping <= kMostDamping; ++step) {
    context.advance(static_cast<double>(step) / options.steps);
    if (fresh) {
      features = make_features(fields, out.to_field, curvature, static_cast<float>(surface.unit()), options.reflection,
                               options.shortcuts, threads);
      adjustment.linearize(out, threads);
    }
    RefinedLandmarks next = out;
    const std::vector<int> moved = adjustment.step(out, features, damping, next.landmarks.to);
    if (moved.empty()) break;
    update_fields(solver, next, moved, threads, context);
    const double now = adjustment.stress(next);
    fresh = now < stress;
    const bool last = fresh && stress - now < kWorthwhile * stress;
    if (fresh) stress = now, out = std::move(next);
    if (last) break;
    damping = fresh ? std::max(kLeastDamping, damping / 2) : 4 * damping;
  }
  return out;
}

double landmark_stress(const Surface& surface, const RefinedLandmarks& refined, const DistanceFields& fields,
                       const CurvatureFeatures& curvature, const RefineOptions& options) {
  return Adjustment(surface, fields, curvature, options).stress(refined);
}

Probes match_probes(const Surface& surface, const RefinedLandmarks& refined, const DistanceFields& fields,
                    const CurvatureFeatures& curvature, const std::vector<int>& vertices,
                    const RefineOptions& options) {
  const Features features = make_features(fields, refined.to_field, curvature, static_cast<float>(surface.unit()),
                                          options.reflection, options.shortcuts, 1);  // callers run side by side
  Matcher matcher(surface, features, kFine);
  Probes out;
  for (int v : vertices) {
    matcher.look_at(v);
    float least = INFINITY;
    int partner = v;
    for (int i : nearest_landmarks(fields, v)) {
      float error;
      const int c = matcher.descend(refined.landmarks.to[i], error);
      if (error < least) least = error, partner = c;
    }
    out.partner.push_back(partner);
    out.error.push_back(least);
  }
  return out;
}

}  // namespace ga_symmetry
