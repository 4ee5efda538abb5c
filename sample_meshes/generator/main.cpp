// SPDX-License-Identifier: GPL-3.0-or-later
// make_sample_meshes: writes the sample meshes and their truth into a folder, the same bytes every time.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "assemble.h"
#include "complete.h"
#include "damage.h"
#include "remesh.h"
#include "sample.h"
#include "shapes.h"
#include "tessellate.h"

namespace samples {
namespace {

Sample exact_sample(const Shape& shape, const Symmetric& whole, const NamedPose& pose, ga_symmetry::Random& random) {
  Sample s = posed(shape.name + "_" + pose.name, whole.mesh, whole.image[shape.generator], pose, random);
  s.order = shape.half_space ? 2 : 3;
  for (std::size_t g = 0; g < shape.group.size(); ++g)
    if (s.order == 3 && shape.group[g].determinant() < 0) s.mirrors.push_back(whole.image[g]);
  return s;
}

// The vertex nearest to where the z axis leaves the surface, at the top (side = 1) or at the bottom (-1).
int nearest_to_axis(const std::vector<Vec3>& points, double side) {
  int best = -1;
  for (std::size_t v = 0; v < points.size(); ++v)
    if (side * points[v].z() > 0 && (best < 0 || points[v].head<2>().norm() < points[best].head<2>().norm()))
      best = static_cast<int>(v);
  return best;
}

// Meshed without regard to the symmetry: a vertex's partner is the vertex nearest to its image at rest. The vertex
// nearest to a fixed point of a turn is its own partner.
Sample remeshed_sample(const Shape& shape, const NamedPose& pose) {
  Sample s;
  s.name = shape.name + "_" + pose.name;
  s.mesh = whole(shape);
  s.rest = s.mesh.point;
  s.exact = false;
  s.order = shape.half_space ? 2 : 3;
  const auto images_under = [&](const Eigen::Matrix3d& element) {
    std::vector<Vec3> images;
    for (const Vec3& p : s.rest) images.push_back(element * p);
    return images;
  };
  const std::vector<Vec3> images = images_under(shape.group[shape.generator]);
  s.partner = nearest(s.rest, images);
  if (s.order == 3)
    for (int v : {nearest_to_axis(s.rest, 1), nearest_to_axis(s.rest, -1)}) s.partner[v] = v;
  for (const Eigen::Matrix3d& element : shape.group)
    if (s.order == 3 && element.determinant() < 0) s.mirrors.push_back(nearest(s.rest, images_under(element)));
  double error = 0, area = 0;
  for (std::size_t v = 0; v < images.size(); ++v) error += (images[v] - s.rest[s.partner[v]]).norm() / images.size();
  for (const Face& f : s.mesh.face) area += (s.rest[f[1]] - s.rest[f[0]]).cross(s.rest[f[2]] - s.rest[f[0]]).norm() / 2;
  std::printf("%s: truth by nearest vertex, mean error %.4f sqrt(area)\n", s.name.c_str(), error / std::sqrt(area));
  s.mesh.point = bend(pose.joints, s.rest);
  return s;
}

void make(const std::string& folder, int vertices) {
  if (!std::filesystem::is_directory(folder)) throw std::runtime_error(folder + " is not a folder: make it first");
  for (Shape shape : {person(), animal(), trefoil(), pinwheel()}) {
    if (vertices > 0) shape.vertices = vertices;
    const Symmetric whole = complete(fundamental_piece(shape), shape.group);
    for (std::size_t i = 0; i < shape.poses.size(); ++i) {
      ga_symmetry::Random random(i + 1);
      const bool last = i + 1 == shape.poses.size();
      Sample sample =
          last ? remeshed_sample(shape, shape.poses[i]) : exact_sample(shape, whole, shape.poses[i], random);
      std::vector<Sample> all = {sample};
      if (sample.name == "person_wave") {
        const std::pair<const char*, Sample (*)(const Sample&)> damages[] = {
            {"_no_hand", without_left_hand}, {"_hump", with_hump}, {"_hole", with_hole}, {"_scan", partial_scan}};
        for (const auto& [suffix, damage] : damages) {
          all.push_back(damage(sample));
          all.back().name += suffix;
        }
      }
      for (Sample& s : all) {
        shuffle(s, random);
        write(s, folder);
      }
      if (sample.name == "animal_beg") {
        ga_symmetry::Random other(1);
        write(scanned_with_debris(sample, other), folder);
      }
    }
  }
  ga_symmetry::Random random(1);
  for (const NamedPose& pose : dressed_poses()) write(dressed(pose, random), folder);
  write(low_poly(person(), person().poses[0], random), folder);
}

}  // namespace
}  // namespace samples

int main(int argc, char** argv) {
  const bool sized = argc == 4 && !std::strcmp(argv[2], "--vertices");
  const int vertices = sized ? std::atoi(argv[3]) : 0;
  if ((argc != 2 && !sized) || argv[1][0] == '-' || (sized && vertices < 2000)) {
    std::fprintf(stderr,
                 "usage: make_sample_meshes FOLDER [--vertices N]\n"
                 "Writes all sample meshes into FOLDER, which must exist; N: about so many vertices each, >= 2000\n");
    return 2;
  }
  try {
    samples::make(argv[1], vertices);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "make_sample_meshes: %s\n", e.what());
    return 1;
  }
}
