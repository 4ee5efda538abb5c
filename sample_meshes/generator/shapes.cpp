// SPDX-License-Identifier: GPL-3.0-or-later
#include "shapes.h"

#include <cmath>

namespace samples {
namespace {

const double kPi = std::acos(-1.0);

Eigen::Matrix3d turn_z(double degrees) {
  return Eigen::AngleAxisd(degrees * kPi / 180, Vec3::UnitZ()).toRotationMatrix();
}

Vec3 around_z(double degrees) { return {std::cos(degrees * kPi / 180), std::sin(degrees * kPi / 180), 0}; }

// Both mirror twins of each solid.
std::vector<Solid> pairs(const std::vector<Solid>& left) {
  std::vector<Solid> out;
  for (const Solid& s : left) {
    Solid twin = s;
    twin.a.x() = -s.a.x();
    if (s.kind == Solid::Kind::kCone) twin.b.x() = -s.b.x();
    out.insert(out.end(), {s, twin});
  }
  return out;
}

// The three images of each solid about the z axis.
std::vector<Solid> triples(const std::vector<Solid>& cones) {
  std::vector<Solid> out;
  for (const Solid& s : cones)
    for (int k = 0; k < 3; ++k) {
      const Eigen::Matrix3d turn = turn_z(120 * k);
      out.push_back(cone(turn * s.a, s.radius_a, turn * s.b, s.radius_b));
    }
  return out;
}

Shape mirror_shape(const std::string& name, std::vector<Layer> layers) {
  Shape shape;
  shape.name = name;
  shape.field = Field(std::move(layers));
  shape.group = {Eigen::Matrix3d::Identity(), Vec3(-1, 1, 1).asDiagonal()};
  shape.lattice = Eigen::Matrix3d::Identity();
  return shape;
}

Ramp above(double y, double half_width) { return {Vec3(0, y, 0), Vec3::UnitY(), half_width}; }
Ramp below(double y, double half_width) { return {Vec3(0, y, 0), -Vec3::UnitY(), half_width}; }
Ramp beside(double x, double half_width) { return {Vec3(x, 0, 0), Vec3::UnitX(), half_width}; }
Ramp before(double z, double half_width) { return {Vec3(0, 0, z), Vec3::UnitZ(), half_width}; }
Ramp behind(double z, double half_width) { return {Vec3(0, 0, z), -Vec3::UnitZ(), half_width}; }

// Degrees about x, y, z, told for the left side (+x). An arm hangs by z = -80 and goes forward by y < 0 or x < 0;
// a leg goes forward by x < 0; a knee bends by x > 0.
struct PersonSide {
  Vec3 shoulder, elbow, wrist, hip, knee, ankle;
};

Pose person_pose(const PersonSide& left, const PersonSide& right, const Vec3& head, const Vec3& spine) {
  Pose pose;
  const auto side = [&](const PersonSide& s, bool mirror) {
    const Joint joints[] = {
        joint({66, 138, 0}, {beside(66, 5)}, s.wrist),
        joint({42, 138, -1}, {beside(42, 9)}, s.elbow),
        joint({17, 137, -1}, {beside(18, 10), above(121, 9)}, s.shoulder),
        joint({14, 9, -2}, {below(11, 5), beside(0, 1)}, s.ankle),
        joint({12.5, 50, 0}, {below(50, 10), beside(0, 1)}, s.knee),
        joint({10, 90, 0}, {below(87, 11), beside(3.5, 3.5)}, s.hip),
    };
    for (const Joint& j : joints) pose.push_back(mirror ? mirrored(j) : j);
  };
  side(left, false);
  side(right, true);
  pose.push_back(joint({0, 150, -1}, {above(151, 5)}, head));
  pose.push_back(joint({0, 108, 0}, {above(110, 14)}, spine));
  return pose;
}

struct AnimalSide {
  Vec3 shoulder, carpus, hip, stifle, hock;
};

Pose animal_pose(const AnimalSide& left, const AnimalSide& right, const Vec3& neck, const Vec3& head, const Vec3& spine,
                 const Vec3& tail_root, const Vec3& tail_middle, const Vec3& tail_tip) {
  Pose pose;
  const auto side = [&](const AnimalSide& s, bool mirror) {
    const Joint joints[] = {
        joint({9.5, 26, 29}, {below(26, 6), before(0, 1), beside(0, 1)}, s.carpus),
        joint({9, 52, 28}, {below(46, 11), before(4, 8), beside(3.5, 3.5)}, s.shoulder),
        joint({10.5, 20, -38}, {below(20, 5), behind(0, 1), beside(0, 1)}, s.hock),
        joint({10.5, 36, -25}, {below(35, 6), behind(0, 1), beside(0, 1)}, s.stifle),
        joint({9, 57, -30}, {below(49, 9), behind(-4, 8), beside(3.5, 3.5)}, s.hip),
    };
    for (const Joint& j : joints) pose.push_back(mirror ? mirrored(j) : j);
  };
  side(left, false);
  side(right, true);
  const Vec3 along_neck = Vec3(0, 0.8, 0.6);
  pose.push_back(joint({0, 90, -71}, {above(90, 6), behind(-58, 3)}, tail_tip));
  pose.push_back(joint({0, 78, -60}, {behind(-60, 6), above(60, 4)}, tail_middle));
  pose.push_back(joint({0, 72, -44}, {behind(-48, 5), above(60, 4)}, tail_root));
  pose.push_back(joint({0, 98, 54}, {{Vec3(0, 96, 52), along_neck, 6}}, head));
  pose.push_back(joint({0, 74, 37}, {{Vec3(0, 80, 42), along_neck, 10}}, neck));
  pose.push_back(joint({0, 64, 0}, {before(0, 22)}, spine));
  return pose;
}

struct Arm {
  Vec3 root, middle;  ///< degrees about x, y, z, told for the arm along +x: y < 0 lifts, z > 0 turns left
};

Pose hub_pose(const Arm (&arms)[3], double middle_direction) {
  Pose pose;
  for (int k = 0; k < 3; ++k) {
    const Vec3 along = around_z(middle_direction);
    pose.push_back(
        turned(joint(Vec3(62, 0, 0), {{Vec3(62, 0, 0), along, 18}, {Vec3(35, 0, 0), Vec3::UnitX(), 5}}, arms[k].middle),
               120 * k));
    pose.push_back(turned(joint(Vec3(30, 0, 0), {{Vec3(36, 0, 0), Vec3::UnitX(), 14}}, arms[k].root), 120 * k));
  }
  return pose;
}

const std::vector<Solid> kHub = {ellipsoid({0, 0, 0}, {30, 30, 14})};
const std::vector<Solid> kKnob = {cone({0, 0, 10}, 8, {0, 0, 24}, 7), ball({0, 0, 32}, 11)};

}  // namespace

Shape person() {
  Shape shape = mirror_shape(
      "person", {{2.5,
                  {ellipsoid({0, 93, -1}, {14.5, 11, 10}), ellipsoid({0, 108, 0}, {12, 14, 8.5}),
                   ellipsoid({0, 126, -0.5}, {15, 15, 9.8}), cone({0, 138, -1.5}, 5.5, {0, 152, 0}, 4.6)}},
                 {2.0, pairs({cone({6, 136, -1}, 6.5, {17, 138, -1}, 5.6), cone({17, 138, -1}, 5.4, {42, 138, -1}, 3.9),
                              cone({42, 138, -1}, 3.9, {66, 138, 0}, 2.9), ball({7, 91, -5}, 8),
                              cone({9.5, 88, 0}, 8.6, {12.5, 50, 1}, 5.4), cone({12.5, 50, 0}, 5, {14, 10, -2}, 3.6),
                              ellipsoid({13, 36, -3.2}, {4.6, 11, 4.6})})},
                 {1.5,
                  {ellipsoid({0, 166.5, 0.5}, {9, 12, 10.5}), ellipsoid({0, 169, -2}, {9.2, 9.8, 10.5}),
                   ellipsoid({0, 158.5, 4}, {6.4, 5.4, 6}), ball({0, 178, -11}, 5)}},
                 {1.0, pairs({ellipsoid({73, 138, 0}, {7, 2.9, 4.6}), ellipsoid({81, 137.6, 0.3}, {6.5, 2.4, 4}),
                              cone({70, 137.5, 3}, 2, {77.5, 136.5, 8.2}, 1.8),
                              cone({14, 5.2, -3.5}, 4.2, {16.2, 3.6, 11}, 3.6)})},
                 {0.8, {cone({0, 167.5, 10.4}, 1.3, {0, 163.8, 13.2}, 2.1)}}});
  shape.poses = {
      {"wave", person_pose({{0, -10, 12}, {0, 0, 72}, {0, 0, -12}, {-28, 0, 6}, {22, 0, 0}, {0, 0, 0}},
                           {{-12, 0, -62}, {0, -55, 0}, {0, 0, 0}, {14, 0, 3}, {8, 0, 0}, {-8, 0, 0}}, {6, 32, -6},
                           {3, 10, -4})},
      {"run", person_pose({{40, 0, -58}, {0, -80, 0}, {0, 0, 0}, {-68, 0, 2}, {72, 0, 0}, {8, 0, 0}},
                          {{-48, 0, -55}, {0, -85, 0}, {0, 0, 0}, {30, 0, 2}, {48, 0, 0}, {20, 0, 0}}, {-12, -18, 0},
                          {16, -14, 0})},
      {"dance", person_pose({{0, -12, 58}, {0, -20, 48}, {0, 0, 20}, {-10, 0, 62}, {18, 0, 0}, {25, 0, 0}},
                            {{0, 20, -30}, {0, 0, 60}, {0, 0, 25}, {6, 0, -2}, {14, 0, 0}, {-14, 0, 0}}, {0, -28, 14},
                            {0, -8, 16})},
  };
  return shape;
}

std::vector<Garment> garments() {
  const auto garment = [](const char* name, int vertices, std::vector<Layer> layers) {
    Garment out;
    out.shape = mirror_shape(name, std::move(layers));
    out.shape.vertices = vertices;
    return out;
  };
  Garment shirt = garment(
      "shirt", 700,
      {{2.5,
        {ellipsoid({0, 97, -1}, {16.6, 9, 11.8}), ellipsoid({0, 108, 0}, {14, 15, 10.3}),
         ellipsoid({0, 126, -0.5}, {16.8, 15.5, 11.5})}},
       {2.0, pairs({cone({6, 136, -1}, 8, {17, 138, -1}, 7.2), cone({17, 138, -1}, 7.2, {30, 138, -1}, 6.2)})}});
  Garment hat = garment("hat", 350,
                        {{1.2, {ellipsoid({0, 174, -1.5}, {11.2, 8.5, 12.8}), ellipsoid({0, 171.5, 2}, {14, 2, 17})}}});
  Garment shoe =
      garment("shoe", 160,
              {{1.0, {cone({14, 4.6, -4}, 5.6, {16.4, 3.8, 12}, 4.9), cone({14, 5, -3.5}, 5.4, {14, 14, -2}, 5.2)}}});
  Garment eye = garment("eye", 70, {{1.0, {ball({3.6, 168, 9.6}, 1.7)}}});
  // On the left shoulder alone: a bag, and a strap over the shoulder.
  const Vec3 strap[] = {{21, 104, 5}, {16, 126, 13}, {11, 145, 0}, {16, 126, -13}, {21, 104, -5}};
  std::vector<Solid> bag = {ellipsoid({22, 97, 0}, {4.5, 9, 8})};
  for (int k = 0; k < 4; ++k) bag.push_back(cone(strap[k], 1.6, strap[k + 1], 1.6));
  Garment shoulder_bag = garment("bag", 500, {{0.8, bag}});
  shoe.pair = eye.pair = true;
  eye.worn = shoulder_bag.worn = false;
  shoulder_bag.alone = true;
  return {shirt, hat, shoe, eye, shoulder_bag};
}

std::vector<NamedPose> dressed_poses() {
  return {
      {"walk",
       person_pose({{-24, 0, -58}, {0, -30, 0}, {0, 0, 0}, {-30, 0, 3}, {18, 0, 0}, {6, 0, 0}},
                   {{26, 0, -62}, {0, -22, 0}, {0, 0, 0}, {20, 0, 2}, {36, 0, 0}, {10, 0, 0}}, {0, 16, 0}, {4, -8, 2})},
      {"reach", person_pose({{0, -35, 38}, {0, -18, 20}, {0, 0, -10}, {-12, 0, 12}, {14, 0, 0}, {0, 0, 0}},
                            {{-14, 0, -52}, {0, -60, 0}, {0, 0, 0}, {8, 0, 4}, {6, 0, 0}, {-4, 0, 0}}, {-10, -22, 6},
                            {-3, 10, -6})},
  };
}

Shape animal() {
  Shape shape = mirror_shape(
      "animal",
      {{3.0,
        {ellipsoid({0, 62, 24}, {12.5, 16, 17}), ellipsoid({0, 62, 0}, {11.5, 12.5, 26}),
         ellipsoid({0, 64, -27}, {12, 14, 15}), cone({0, 72, 36}, 9.5, {0, 97, 53}, 6.3)}},
       {2.0, pairs({cone({8.5, 58, 27}, 7.5, {9.5, 30, 29}, 4.3), cone({9.5, 30, 29}, 4, {9.5, 6, 28}, 3.4),
                    cone({8.5, 59, -29}, 10, {10.5, 37, -24}, 5.4), cone({10.5, 37, -24}, 5, {10.5, 20, -38}, 3.7),
                    cone({10.5, 20, -38}, 3.6, {10.5, 6, -36}, 3.4)})},
       {1.5,
        {ellipsoid({0, 101, 57}, {7.6, 7.8, 9}), cone({0, 98.5, 63}, 5.4, {0, 94.5, 78}, 3.7),
         cone({0, 70, -40}, 4, {0, 75, -57}, 3.6), cone({0, 75, -57}, 3.6, {0, 86, -69}, 3.4),
         cone({0, 86, -69}, 3.4, {0, 101, -75}, 3)}},
       {1.0, pairs({cone({9.5, 4, 28}, 3.9, {9.5, 3.4, 34}, 3.5), cone({10.5, 4, -36}, 3.9, {10.5, 3.4, -29.5}, 3.5),
                    cone({4.2, 106, 53}, 3.8, {8.4, 116.5, 50}, 2.3)})},
       {0.8, {ball({0, 97, 80.5}, 2.3)}}});
  shape.poses = {
      {"walk", animal_pose({{-32, 0, 0}, {24, 0, 0}, {24, 0, 0}, {10, 0, 0}, {-22, 0, 0}},
                           {{26, 0, 0}, {6, 0, 0}, {-30, 0, 0}, {28, 0, 0}, {-10, 0, 0}}, {10, 22, 0}, {6, 24, 8},
                           {0, 14, 0}, {0, -30, 0}, {0, -40, 0}, {20, 0, -30})},
      {"beg", animal_pose({{-52, 0, 0}, {64, 0, 0}, {-8, 0, 0}, {10, 0, 0}, {-6, 0, 0}},
                          {{-8, 0, 0}, {4, 0, 0}, {22, 0, 0}, {-6, 0, 0}, {-16, 0, 0}}, {-14, -30, 0}, {14, -18, -14},
                          {0, -10, 0}, {-20, 38, 0}, {0, 45, 0}, {0, 0, 40})},
      {"graze", animal_pose({{18, 0, 0}, {10, 0, 0}, {-34, 0, 0}, {30, 0, 0}, {-12, 0, 0}},
                            {{-30, 0, 0}, {16, 0, 0}, {20, 0, 0}, {6, 0, 0}, {-14, 0, 0}}, {72, 14, 0}, {-6, 22, 0},
                            {6, 12, 0}, {34, -26, 0}, {14, -44, 0}, {-20, -30, 0})},
  };
  return shape;
}

Shape trefoil() {
  Shape shape;
  shape.name = "trefoil";
  shape.field = Field({{3.0, kHub},
                       {3.0, triples({cone({18, 0, 0}, 10.5, {60, 0, 5}, 8.6), cone({60, 0, 5}, 8.6, {100, 0, -6}, 7.4),
                                      ball({104, 0, -7}, 11.5)})},
                       {2.0, kKnob}});
  const Eigen::Matrix3d mirror = Vec3(1, -1, 1).asDiagonal();
  for (int k = 0; k < 3; ++k) shape.group.push_back(turn_z(120 * k));
  for (int k = 0; k < 3; ++k) shape.group.push_back(turn_z(120 * k) * mirror);
  shape.lattice << around_z(0), around_z(60), Vec3::UnitZ();
  shape.half_space = false;
  shape.vertices = 3000;
  shape.poses = {
      {"bend", hub_pose({{{0, -35, 0}, {0, 0, 60}}, {{0, 25, 0}, {0, -60, 0}}, {{0, 0, -28}, {0, 35, 20}}}, 0)},
      {"curl", hub_pose({{{0, 30, 0}, {0, -72, 0}}, {{0, -20, 25}, {0, 0, 65}}, {{0, -48, 0}, {0, 30, -20}}}, 0)},
  };
  return shape;
}

Shape pinwheel() {
  Shape shape;
  shape.name = "pinwheel";
  shape.field = Field({{3.0, kHub},
                       {3.0, triples({cone({18, -3, 0}, 10.5, {55, 0, 4}, 8.8), cone({55, 0, 4}, 8.8, {82, 20, 3}, 7.8),
                                      cone({82, 20, 3}, 7.8, {96, 50, -5}, 7), ball({97, 54, -6}, 10.5)})},
                       {2.0, kKnob},
                       {2.0, triples({cone({64, 0, 4}, 6.5, {86, -16, 8}, 6.2)})}});
  for (int k = 0; k < 3; ++k) shape.group.push_back(turn_z(120 * k));
  shape.lattice << around_z(-60), around_z(60), Vec3::UnitZ();
  shape.half_space = false;
  shape.seam_is_mirror = false;
  shape.vertices = 3000;
  shape.poses = {
      {"bend", hub_pose({{{0, -38, 0}, {0, 0, 40}}, {{0, 22, 0}, {0, -55, 0}}, {{0, 0, -25}, {0, 40, -20}}}, 25)},
      {"curl", hub_pose({{{0, 28, 0}, {20, -80, 0}}, {{0, -25, 20}, {0, 40, 0}}, {{0, -60, 0}, {0, 0, -45}}}, 25)},
  };
  return shape;
}

}  // namespace samples
