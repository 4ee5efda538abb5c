// SPDX-License-Identifier: GPL-3.0-or-later
// The core's door: arbitrary coordinates and faces, parts and damages. What it lets in has to come back with a partner
// for every vertex; of some the whole search has to bear it.
#include <cmath>
#include <cstdlib>

#include "damage_kit.h"
#include "fuzz.h"
#include "ga_symmetry/symmetry.h"
#include "matching/prolongation.h"
#include "surface/search_surface.h"
#include "surface_result.h"

namespace {

using namespace ga_symmetry;

// A grid, wrapped or open, whose vertices are then moved and whose faces are changed: plain noise hardly ever passes
// the door. Afterwards come faces and coordinates as they are.
void add_grid(fuzz::Bytes& in, TriangleMesh& mesh) {
  const int columns = in.take<std::uint8_t>() % 12, rows = in.take<std::uint8_t>() % 12, wrap = in.take<std::uint8_t>();
  const int first = mesh.vertices();
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      mesh.position.insert(mesh.position.end(), {double(i), double(j), std::sin(2.0 * i + j * j)});
      const int ni = (i + 1) % columns, nj = (j + 1) % rows;
      if ((ni == 0 && !(wrap & 1)) || (nj == 0 && !(wrap & 2))) continue;
      const int a = first + i * rows + j, b = first + ni * rows + j, c = first + ni * rows + nj,
                d = first + i * rows + nj;
      mesh.triangle.insert(mesh.triangle.end(), {a, b, c, a, c, d});
    }
}

// What the door is made for: more parts, moved as a whole, then damages of the kit.
void add_parts_and_damage(fuzz::Bytes& in, TriangleMesh& mesh) {
  for (int parts = in.take<std::uint8_t>() % 4; parts > 0; --parts) {
    const int first = mesh.vertices();
    add_grid(in, mesh);
    const int shift[3] = {in.take<std::int8_t>(), in.take<std::int8_t>(), in.take<std::int8_t>()};
    const double size = std::ldexp(1.0, in.take<std::int8_t>() % 16);
    for (std::size_t i = 3 * static_cast<std::size_t>(first); i < mesh.position.size(); ++i)
      mesh.position[i] = size * mesh.position[i] + shift[i % 3] / 8.0;
  }
  for (int damages = in.take<std::uint8_t>() % 5; damages > 0 && mesh.triangles() > 0; --damages) {
    const auto& kind = damage::kinds()[in.take<std::uint8_t>() % damage::kinds().size()];
    mesh = damage::damaged(mesh, std::vector<int>(mesh.vertices(), -1), kind, in.take<std::uint8_t>()).mesh;
  }
}

TriangleMesh make_mesh(fuzz::Bytes& in, bool parts) {
  TriangleMesh mesh;
  add_grid(in, mesh);
  if (parts) add_parts_and_damage(in, mesh);
  while (!in.empty()) {
    const int kind = in.take<std::uint8_t>();
    const std::size_t at = in.take<std::uint16_t>();
    if (kind < 80 && !mesh.position.empty())
      mesh.position[at % mesh.position.size()] += in.take<std::int8_t>() / 64.0;
    else if (kind < 110 && !mesh.position.empty())
      mesh.position[at % mesh.position.size()] = in.take<double>();
    else if (kind < 150 && !mesh.triangle.empty())
      mesh.triangle[at % mesh.triangle.size()] = in.take<std::uint8_t>();
    else if (kind < 160 && !mesh.triangle.empty())
      mesh.triangle[at % mesh.triangle.size()] = in.take<int>();
    else if (kind < 200 && !mesh.triangle.empty())
      mesh.triangle.erase(mesh.triangle.begin() + static_cast<std::ptrdiff_t>(at % (mesh.triangle.size() / 3) * 3),
                          mesh.triangle.begin() + static_cast<std::ptrdiff_t>(at % (mesh.triangle.size() / 3) * 3 + 3));
    else if (kind < 230)
      mesh.position.insert(mesh.position.end(), {double(at), in.take<float>(), in.take<float>()});
    else
      for (int k = 0; k < 3; ++k) mesh.triangle.push_back(in.take<std::uint8_t>());
  }
  return mesh;
}

void check(const TriangleMesh& mesh, const Result& r) {
  const auto n = static_cast<std::size_t>(mesh.vertices());
  if (r.partners.partner.size() != n || r.partners.fitness.size() != n || r.partners.side.size() != n) std::abort();
  for (std::size_t v = 0; v < n; ++v)
    if (r.partners.partner[v] < -1 || r.partners.partner[v] >= mesh.vertices() || !(r.partners.fitness[v] >= 0) ||
        std::isinf(r.partners.fitness[v]) || std::abs(r.partners.side[v]) > 1)
      std::abort();
}

// The door and the ways there and back, with a map that takes every vertex to another: what the search makes of a
// surface does not depend on how broken the mesh was.
void through_the_door(const TriangleMesh& mesh, const Options& o) {
  const SearchSurface search(make_surface(mesh, o.largest_component), o);
  const Surface& s = search.searched();
  const int n = s.vertices();
  if (!search.direct() && search.place().size() != static_cast<std::size_t>(search.of_mesh().vertices())) std::abort();
  search.locate(o.references);
  SurfaceResult found;
  found.fitness.assign(n, 0.0);
  for (int v = 0; v < n; ++v) {
    found.partner.push_back(n - 1 - v);
    found.point.push_back({{n - 1 - v, n - 1 - v, n - 1 - v}, {1, 0, 0}});
  }
  if (!search.direct()) found = prolongate(std::move(found), search, o.symmetry != SymmetryKind::rotation, 1);
  found.side.assign(found.partner.size(), 0);
  check(mesh, to_mesh(std::move(found), {}, search.of_mesh(), 0));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes in(data, size);
  Options o;
  const int choice = in.take<std::uint8_t>();
  o.threads = 1;
  o.largest_component = choice & 1;
  o.symmetry = choice & 2 ? SymmetryKind::rotation : SymmetryKind::reflection;
  o.joint.samples = 20, o.joint.sites = 24, o.joint.population = 4, o.joint.max_generations = 1;
  o.pairs.samples = 20, o.pairs.max_generations = 3;
  if (choice & 4) {
    const auto vertex = [&] { return int{in.take<std::uint8_t>()}; };
    o.references.axis = {vertex(), vertex()};
    o.references.pairs = {{vertex(), vertex()}};
    if (choice & 8) o.method = Method::pairs;
  }
  const TriangleMesh mesh = make_mesh(in, choice & 16);
  // A whole search takes seconds here; mutations hardly ever set both bits.
  const bool search = (choice & 96) == 96;
  fuzz::expect_result_or_line([&] {
    if (search)
      check(mesh, find_symmetry(mesh, o));
    else
      through_the_door(mesh, o);
  });
  return 0;
}
