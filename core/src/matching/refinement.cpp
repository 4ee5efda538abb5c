// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/refinement.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "ga_symmetry/errors.h"
#include "matching/matcher.h"
#include "surface/tangent_plane.h"

namespace ga_symmetry {
namespace {

// Computes the fields of the images that have moved.
void update_fields(const FieldCache& fields, Images& images, const std::vector<int>& moved, int threads,
                   const Context& context) {
  std::vector<int> sources;
  for (int i : moved) sources.push_back(images.vertex[i]);
  const DistanceFields field = fields.fields(sources, threads, {nullptr, context.cancel});
  for (std::size_t k = 0; k < moved.size(); ++k) images.field.row(moved[k]) = field.row(static_cast<int>(k));
}

// The stress of landmarks and the step that lowers it. With x the landmarks and y their images, the differences are
//   d(y_i, y_j) - d(x_i, x_j)   and, as a reflection also takes y to x,   d(y_i, x_j) - d(y_j, x_i).
class Adjustment {
 public:
  Adjustment(const Matching& matching, double curvature_weight)
      : m_(matching),
        fields_(matching.landmarks.field),
        curvature_weight_(curvature_weight),
        unit_(matching.surface.unit()) {}

  double stress(const Images& at) const { return accumulate(at, nullptr); }

  /// Linearises at the images.
  void linearize(const Images& at, int threads) {
    System& s = system_;
    const int size = 2 * static_cast<int>(at.vertex.size());
    s.to = directions(m_.surface, at.vertex, at.field, threads);
    s.from = directions(m_.surface, at.vertex, fields_, threads);
    s.normal = Eigen::MatrixXd::Zero(size, size);
    s.right = Eigen::VectorXd::Zero(size);
    accumulate(at, &s);
    s.scale = s.normal.trace() / size;
    for (int k = size - 2 * m_.fixed; k < size; ++k) s.normal(k, k) += 1e6 * s.scale;  // stay
  }

  /// The images after a step, without their fields. @return which have moved
  std::vector<int> step(const Images& at, const Features& features, double damping, std::vector<int>& to) const {
    constexpr double kLongest = 0.06;  // units; directions hold near by
    const System& s = system_;
    Eigen::MatrixXd normal = s.normal;
    normal.diagonal().array() += damping * s.scale;
    const Eigen::VectorXd move = -normal.ldlt().solve(s.right);
    Matcher matcher(m_.surface, features, {kCoarse.near2, kCoarse.power, 0});
    const int count = static_cast<int>(at.vertex.size());
    std::vector<float> wanted(features.dimension);
    std::vector<int> moved;
    for (int i = 0; i < m_.movable(); ++i) {
      Eigen::Vector2d t = move.segment<2>(2 * i);
      if (t.norm() > kLongest) t *= kLongest / t.norm();
      // The vertex whose distances have changed as they do along the step.
      const float* here = features.of(features.target, at.vertex[i]);
      std::copy(here, here + features.dimension, wanted.begin());
      const auto shift = [&](int first, const std::pair<Table, Table>& towards) {
        for (int j = 0; j < count; ++j)
          wanted[first + j] -= static_cast<float>(towards.first(i, j) * t[0] + towards.second(i, j) * t[1]);
      };
      shift(0, s.to);
      if (m_.reflection) shift(count, s.from);
      matcher.look_for(wanted.data());
      float least;
      to[i] = matcher.descend(at.vertex[i], least);
      if (to[i] != at.vertex[i]) moved.push_back(i);
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

  double accumulate(const Images& at, System* system) const {
    constexpr double kCap = 0.01;  // units^2: what is lost or added on one side says nothing of the rest
    const std::vector<int>&x = m_.landmarks.vertex, &y = at.vertex;
    const int count = static_cast<int>(x.size());
    Eigen::MatrixXd before(count, count), after(count, count), across(count, count);
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < count; ++j) {
        before(i, j) = (fields_(j, x[i]) + fields_(i, x[j])) / (2 * unit_);
        after(i, j) = (at.field(j, y[i]) + at.field(i, y[j])) / (2 * unit_);
        across(i, j) = fields_(j, y[i]) / unit_;
      }
    Eigen::MatrixXd slack;  // (i, j): of after - before above the diagonal, of across - its transpose below
    if (!m_.shortcuts.none()) {
      const Eigen::MatrixXd slack_before = slacks(fields_, x), slack_across = slacks(fields_, y),
                            slack_after = slacks(at.field, y);
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
    if (!m_.reflection) weight_across.setZero();
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
        if (!m_.reflection) continue;
        const Eigen::Vector2d p = towards(from, i, j), q = towards(from, j, i);
        add(i, j, beyond_slack(across(i, j) - across(j, i), j, i), both * weight_across(i, j), -p[0], -p[1], q[0],
            q[1]);
      }
    const double curvature_weight = curvature_weight_ / kCurvatureFeatures;
    for (int i = 0; curvature_weight > 0 && i < m_.movable(); ++i) {
      const Eigen::VectorXd difference = (m_.curvature.row(y[i]) - m_.curvature.row(x[i])).cast<double>().transpose();
      sum += curvature_weight * difference.squaredNorm();
      if (!system) continue;
      const TangentPlane plane(m_.surface, y[i]);
      for (int k = 0; k < kCurvatureFeatures; ++k) {
        const Eigen::Vector2d g = unit_ * plane.gradient([&](int v) { return double{m_.curvature(v, k)}; });
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
      const auto slack = m_.shortcuts.slack(fields.row(j).data());
      for (std::size_t i = 0; i < vertices.size(); ++i)
        out(static_cast<Eigen::Index>(i), j) = slack(vertices[i]) / unit_;
    }
    return out;
  }

  const Matching& m_;
  const DistanceFields& fields_;
  const double curvature_weight_, unit_;
  System system_;
};

}  // namespace

Images refine_images(const Matching& m, Images images, int threads, const Context& context) {
  const Features features = make_features(m, images, threads);
  Matcher matcher(m.surface, features, kCoarse);
  std::vector<int> moved;
  for (int i = 0; i < m.movable(); ++i) {
    matcher.look_at(m.landmarks.vertex[i]);
    float error;
    const int better = matcher.descend(images.vertex[i], error);
    if (better == images.vertex[i]) continue;
    images.vertex[i] = better;
    moved.push_back(i);
  }
  update_fields(m.fields, images, moved, threads, context);
  return images;
}

Images adjust_images(const Matching& m, Images images, const AdjustOptions& options, int threads,
                     const Context& context) {
  constexpr double kLeastDamping = 0.02, kMostDamping = 2;
  constexpr double kWorthwhile = 0.01;  // of the stress: a step that lowers it by less is the last
  Adjustment adjustment(m, options.curvature);
  double stress = adjustment.stress(images), damping = kLeastDamping;
  bool fresh = true;
  Features features;
  for (int step = 0; step < options.steps && damping <= kMostDamping; ++step) {
    context.advance(static_cast<double>(step) / options.steps);
    if (fresh) {
      features = make_features(m, images, threads);
      adjustment.linearize(images, threads);
    }
    Images next = images;
    const std::vector<int> moved = adjustment.step(images, features, damping, next.vertex);
    if (moved.empty()) break;
    update_fields(m.fields, next, moved, threads, context);
    const double now = adjustment.stress(next);
    fresh = now < stress;
    const bool last = fresh && stress - now < kWorthwhile * stress;
    if (fresh) stress = now, images = std::move(next);
    if (last) break;
    damping = fresh ? std::max(kLeastDamping, damping / 2) : 4 * damping;
  }
  return images;
}

double image_stress(const Matching& m, const Images& images, double curvature_weight) {
  return Adjustment(m, curvature_weight).stress(images);
}

Probes match_probes(const Matching& m, const Images& images, const std::vector<int>& vertices) {
  const Features features = make_features(m, images, 1);  // callers run side by side
  Matcher matcher(m.surface, features, kFine);
  Probes out;
  for (int v : vertices) {
    matcher.look_at(v);
    float least = INFINITY;
    int partner = v;
    for (int i : nearest_landmarks(m.landmarks.field, v)) {
      float error;
      const int c = matcher.descend(images.vertex[i], error);
      if (error < least) least = error, partner = c;
    }
    out.partner.push_back(partner);
    out.error.push_back(least);
  }
  return out;
}

}  // namespace ga_symmetry
