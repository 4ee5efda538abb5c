// SPDX-License-Identifier: GPL-3.0-or-later
#include "assemble.h"

#include "complete.h"
#include "damage.h"
#include "damage_kit.h"
#include "remesh.h"
#include "tessellate.h"

namespace samples {
namespace {

namespace kit = ga_symmetry::damage;

kit::Damaged to_kit(const Sample& s) {
  ga_symmetry::TriangleMesh mesh;
  for (const Vec3& p : s.mesh.point) mesh.position.insert(mesh.position.end(), p.data(), p.data() + 3);
  for (const Face& f : s.mesh.face) mesh.triangle.insert(mesh.triangle.end(), f.begin(), f.end());
  return kit::whole(mesh, s.partner);
}

// @param refs  of the sample as it was
Sample from_kit(const kit::Damaged& d, const std::string& name, const std::array<int, 4>& refs) {
  Sample s;
  s.name = name;
  for (int v = 0; v < d.mesh.vertices(); ++v) s.mesh.point.emplace_back(&d.mesh.position[3 * v]);
  for (int f = 0; f < d.mesh.triangles(); ++f)
    s.mesh.face.push_back({d.mesh.triangle[3 * f], d.mesh.triangle[3 * f + 1], d.mesh.triangle[3 * f + 2]});
  s.rest = s.mesh.point;
  s.partner = d.partner;
  s.assembled = true;
  s.closed = false;
  for (int k = 0; k < 4; ++k) s.refs[k] = d.copy_of(refs[k]);
  // Two copies of one vertex are one reference, and of a fixed one the partner is any copy.
  for (int k = 0; k < 2; ++k) s.partner[s.refs[k]] = s.refs[k];
  s.partner[s.refs[2]] = s.refs[3], s.partner[s.refs[3]] = s.refs[2];
  return s;
}

// What is not inside the body.
Sample opened(const Sample& s, const Field& body) {
  constexpr double kInside = -0.3;  // cm
  std::vector<bool> drop;
  for (const Vec3& p : s.rest) drop.push_back(body.value(Vec3(std::abs(p.x()), p.y(), p.z())) < kInside);
  return without(s, drop);
}

Sample at_rest(const std::string& name, Mesh mesh, std::vector<int> partner) {
  Sample s;
  s.name = name;
  s.rest = mesh.point;
  s.mesh = std::move(mesh);
  s.partner = std::move(partner);
  return s;
}

// The left one and its mirror image.
Sample both(const Sample& left) {
  Sample s = left;
  const int n = left.mesh.points();
  for (const Vec3& p : left.rest) s.rest.push_back(Vec3(-p.x(), p.y(), p.z()));
  for (const Face& f : left.mesh.face) s.mesh.face.push_back({n + f[0], n + f[2], n + f[1]});
  s.mesh.point = s.rest;
  s.partner.clear();
  for (int v = 0; v < 2 * n; ++v) s.partner.push_back(v < n ? n + v : v - n);
  return s;
}

void append(Sample& s, const Sample& part) {
  const int n = s.mesh.points();
  s.mesh.point.insert(s.mesh.point.end(), part.mesh.point.begin(), part.mesh.point.end());
  for (const Face& f : part.mesh.face) s.mesh.face.push_back({n + f[0], n + f[1], n + f[2]});
  for (const int w : part.partner) s.partner.push_back(w < 0 ? -1 : n + w);
}

}  // namespace

Sample posed(const std::string& name, const Mesh& rest, std::vector<int> partner, const NamedPose& pose,
             ga_symmetry::Random& random) {
  constexpr double kFlipped = 0.12;  // share of the edges flipped, so that connectivity is not symmetric
  Sample s = at_rest(name, rest, std::move(partner));
  s.mesh.point = bend(pose.joints, rest.point);
  flip_edges(s.mesh, kFlipped, random);
  return s;
}

Sample dressed(const NamedPose& pose, ga_symmetry::Random& random) {
  constexpr int kBody = 2300, kCharts = 14;
  Shape body = person();
  body.vertices = kBody;
  const Symmetric whole_body = complete(fundamental_piece(body), body.group);
  const std::string name = "person_dressed_" + pose.name;
  Sample s = posed(name, whole_body.mesh, whole_body.image[body.generator], pose, random);
  check_surface(s);
  const std::array<int, 4> refs = references(s);
  for (const Garment& g : garments()) {
    Sample part;
    if (g.pair || g.alone) {
      Mesh mesh = whole(g.shape);
      part = at_rest(g.shape.name, mesh, std::vector<int>(mesh.point.size(), -1));
    } else {
      const Symmetric made = complete(fundamental_piece(g.shape), g.shape.group);
      part = at_rest(g.shape.name, made.mesh, made.image[g.shape.generator]);
    }
    if (g.worn) part = opened(part, body.field);
    const bool closed = part.closed;
    check_surface(part);
    if (g.pair) part = both(part);
    part.mesh.point = part.rest;
    part = posed(g.shape.name, part.mesh, part.partner, pose, random);
    part.closed = closed;
    if (!g.pair) check_surface(part);
    append(s, part);
  }
  kit::Damaged d = to_kit(s);
  kit::split_seams(d, kCharts, random);
  kit::finish(d, random);
  return from_kit(d, name, refs);
}

Sample low_poly(const Shape& shape, const NamedPose& pose, ga_symmetry::Random& random) {
  Shape coarse = shape;
  coarse.vertices = 2000;
  coarse.low_poly = 270;
  const Symmetric made = complete(fundamental_piece(coarse), shape.group);
  Sample s = posed(shape.name + "_" + pose.name + "_low_poly", made.mesh, made.image[shape.generator], pose, random);
  check_surface(s);
  s.assembled = true;  // few edges can be flipped without changing the shape
  shuffle(s, random);
  return s;
}

Sample scanned_with_debris(const Sample& sample, ga_symmetry::Random& random) {
  constexpr double kNoise = 0.08;  // cm
  constexpr int kPieces = 40;
  kit::Damaged d = to_kit(sample);
  kit::add_noise(d, kNoise, random);
  kit::add_debris(d, kPieces, random);
  kit::finish(d, random);
  return from_kit(d, sample.name + "_debris", references(sample));
}

}  // namespace samples
