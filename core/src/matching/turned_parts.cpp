// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/turned_parts.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "ga_symmetry/errors.h"
#include "matching/patch.h"
#include "surface/facing_points.h"
#include "util/parallel.h"

namespace ga_symmetry {
namespace {

using Vector = Eigen::Vector3d;

// Radii in units: a head with its neck, and an ear, which is too small to bend.
constexpr double kPart = 0.2, kSmall = 0.06;

// A part that may have been turned, at another angle.
struct Turned {
  std::vector<int> vertex, partner;
  bool better = false;
};

class Parts {
 public:
  Parts(const Matching& m, const SurfaceMap& map)
      : m_(m), s_(m.surface), unit_(m.surface.unit()), normal_(unit_normals(m.surface)), partner_(map.partner) {
    for (const SurfacePoint& p : map.point) image_.push_back(position(s_, p));
  }

  /// Of FacingPoints: near by, as they are in single precision.
  Vector origin() const { return Vector(s_.point(m_.landmarks.vertex[0])); }

  /// How badly the small disc around a landmark fits where the map takes it, as Fitted::misfit; 0 = too small to tell.
  double misfit(int landmark) const { return misfit(landmark, kSmall, partner_, image_); }

  /// The landmarks around which parts may have been turned: the tips of what fits badly, worst first. The tip, because
  /// a disc around it holds a part and no more.
  std::vector<int> suspects(const std::vector<double>& misfits) const {
    constexpr double kBad = 6;  // times the median
    constexpr std::size_t kMost = 6;
    const int count = static_cast<int>(misfits.size());
    std::vector<int> order(count), out;
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return misfits[a] > misfits[b]; });
    std::vector<double> far(count, 0);  // sum of distances to all landmarks
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < count; ++j) far[i] += distance(i, j);
    for (const int worst : order) {
      if (misfits[worst] <= kBad * misfits[order[count / 2]] || out.size() == kMost) break;
      int tip = worst;
      for (int j = 0; j < count; ++j)
        if (distance(worst, j) < kPart && far[j] > far[tip]) tip = j;
      if (std::none_of(out.begin(), out.end(), [&](int known) { return distance(known, tip) < kPart / 2; }))
        out.push_back(tip);
    }
    return out;
  }

  /// The part around a landmark at the angle at which it fits best.
  Turned turned(int centre, const FacingPoints& points) const {
    constexpr int kAngles = 12, kFirstSteps = 2, kSteps = 6;
    constexpr double kRim = 0.8, kReach = 1.4;  // radii: the neck; what its image may cover
    constexpr double kBetter = 0.25;            // of mean squares: fits twice as well
    constexpr double kNoise = 1e-6;             // units^2, a thousandth squared: what a smooth part that bends has
    const double pi = std::acos(-1.0);
    Turned out;
    const float* field = m_.landmarks.field.row(centre).data();
    const Patch patch(s_, field, kPart, image_);
    if (!patch.fits()) return out;
    const LocalMotion motion = rigid_motion(patch.points, patch.images, patch.weights, m_.reflection);
    Vector rim = Vector::Zero();
    int count = 0;
    for (std::size_t k = 0; k < patch.vertex.size(); ++k)
      if (field[patch.vertex[k]] > kRim * kPart * unit_) rim += patch.points.col(static_cast<Eigen::Index>(k)), ++count;
    if (count == 0) return out;
    const Vector along = motion.turn * (motion.from - rim / count);
    if (along.norm() == 0) return out;
    const Vector axis = along.normalized();

    const int target = partner_[m_.landmarks.vertex[centre]];
    const DistanceFields around = m_.fields.fields({target}, 1, {});
    std::vector<Eigen::Index> at(patch.vertex.size(), target);
    const auto fit = [&](const LocalMotion& start, int steps) {
      return fit_patch(s_, patch, start, normal_, steps, false,
                       [&](Eigen::Index k, const Vector& x, const Vector& facing) {
                         FacingPoint p;
                         p << ((x - origin()) / unit_).cast<float>(), FacingPoints::kTurned * facing.cast<float>();
                         points.nearest(p, at[k]);
                         return around(0, at[k]) < kReach * kPart * unit_ ? static_cast<int>(at[k]) : -1;
                       });
    };
    Fitted best{motion, INFINITY};
    for (int a = 0; a < kAngles; ++a) {
      LocalMotion start = motion;
      start.turn = Eigen::AngleAxisd(2 * pi * a / kAngles, axis).toRotationMatrix() * motion.turn;
      const Fitted fitted = fit(start, kFirstSteps);
      if (fitted.misfit < best.misfit) best = fitted;
    }
    best = fit(best.motion, kSteps);
    if (!(best.misfit < kBetter * misfit(centre, kPart, partner_, image_))) return out;

    std::vector<int> partner = partner_;
    std::vector<Vector> image = image_;
    for (std::size_t k = 0; k < patch.vertex.size(); ++k) {
      const int v = patch.vertex[k], p = static_cast<int>(at[k]);
      if (around(0, p) >= kReach * kPart * unit_) continue;
      out.vertex.push_back(v), out.partner.push_back(p);
      partner[v] = p, image[v] = Vector(s_.point(p));
    }
    double before = 0, after = 0;  // mean squares; what is hardly off the surface tells nothing
    for (int i = 0; i < m_.count(); ++i)
      if (distance(centre, i) < kPart - kSmall)
        before += kNoise + misfit(i), after += kNoise + misfit(i, kSmall, partner, image);
    out.better = after < kBetter * before;
    return out;
  }

 private:
  double distance(int i, int j) const { return m_.landmarks.field(i, m_.landmarks.vertex[j]) / unit_; }
  double misfit(int landmark, double radius, const std::vector<int>& partner, const std::vector<Vector>& image) const {
    const Patch patch(s_, m_.landmarks.field.row(landmark).data(), radius, image);
    return patch.fits() ? fit_to_partners(s_, m_.reflection, patch, partner, normal_).misfit : 0;
  }

  const Matching& m_;
  const Surface& s_;
  const double unit_;
  const std::vector<Vector> normal_;
  const std::vector<int>& partner_;
  std::vector<Vector> image_;
};

}  // namespace

bool turn_parts_back(const Matching& m, SurfaceMap& map, int threads, const Context& context) {
  const Parts parts(m, map);
  std::vector<double> misfits(m.movable());
  constexpr int kBlock = 8;
  parallel_blocks(m.movable(), kBlock, threads, [&](int begin, int end, int) {
    if (context.cancelled()) throw Cancelled();
    for (int i = begin; i < end; ++i) misfits[i] = parts.misfit(i);
  });
  const std::vector<int> suspects = parts.suspects(misfits);
  if (suspects.empty()) return false;
  const FacingPoints points(m.surface, parts.origin());
  std::vector<Turned> turned(suspects.size());
  parallel_for(static_cast<int>(suspects.size()), threads, [&](int k, int) {
    if (context.cancelled()) throw Cancelled();
    turned[k] = parts.turned(suspects[k], points);
  });
  bool any = false;
  for (const Turned& part : turned) {
    if (!part.better) continue;
    any = true;
    for (std::size_t k = 0; k < part.vertex.size(); ++k) {
      const int p = part.partner[k];
      map.partner[part.vertex[k]] = p, map.point[part.vertex[k]] = {{p, p, p}, {1, 0, 0}};
    }
  }
  return any;
}

}  // namespace ga_symmetry
