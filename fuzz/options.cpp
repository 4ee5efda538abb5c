// SPDX-License-Identifier: GPL-3.0-or-later
// Options of any value: refused in one line, or such that the search begins (it is stopped there).
#include <atomic>
#include <cmath>

#include "fuzz.h"
#include "ga_symmetry/symmetry.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ga_symmetry;
  fuzz::Bytes in(data, size);
  Options o;
  o.method = in.take<std::uint8_t>() % 2 ? Method::pairs : Method::joint;
  o.symmetry = in.take<std::uint8_t>() % 2 ? SymmetryKind::rotation : SymmetryKind::reflection;
  for (int* value :
       {&o.threads, &o.proxy, &o.pairs.samples, &o.pairs.individuals, &o.pairs.regions, &o.pairs.max_generations,
        &o.joint.samples, &o.joint.sites, &o.joint.population, &o.joint.max_generations})
    if (in.take<std::uint8_t>() % 2) *value = in.take<int>();
  for (double* value :
       {&o.pairs.outlier_z, &o.pairs.mutation_barrier_z, &o.pairs.mutation_probability, &o.joint.mutation_probability,
        &o.joint.turn_probability, &o.joint.ruin_probability, &o.joint.outlier_z, &o.joint.distance_weight,
        &o.joint.orientation_weight, &o.joint.continuity_weight, &o.joint.descriptor_weight,
        &o.joint.bijectivity_weight, &o.joint.reference_weight})
    if (in.take<std::uint8_t>() % 2) *value = in.take<double>();
  for (int count = in.take<std::uint8_t>() % 4; count-- > 0;) o.references.axis.push_back(in.take<int>());
  for (int count = in.take<std::uint8_t>() % 4; count-- > 0;)
    o.references.pairs.push_back({in.take<int>(), in.take<int>()});

  static const TriangleMesh mesh = [] {
    TriangleMesh m;
    for (int i = 0; i < 40; ++i) {
      const int row = i / 2, column = i % 2;
      m.position.insert(m.position.end(), {double(row), double(column), std::sin(0.3 * i)});
      if (i + 2 < 40) m.triangle.insert(m.triangle.end(), {i, i + 1, i + 2});
    }
    return m;
  }();
  // Stopped once the mesh has been checked and the references have been looked up.
  std::atomic<bool> stop{false};
  Context context;
  context.cancel = &stop;
  context.progress = [&](double fraction, const char*) { stop = fraction > 0; };
  fuzz::expect_result_or_line([&] { find_symmetry(mesh, o, context); });
  return 0;
}
