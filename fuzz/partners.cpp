// SPDX-License-Identifier: GPL-3.0-or-later
// Imports: partners as CSV or JSON, value tables and truth files, for a small mesh. The first byte chooses.
#include "ga_symmetry/partners.h"

#include <cstdlib>

#include "fuzz.h"
#include "ga_symmetry/asymmetry.h"
#include "ga_symmetry/axis.h"
#include "ga_symmetry/evaluation.h"
#include "ga_symmetry/io.h"
#include "ga_symmetry/mirror.h"
#include "io/value_table.h"

namespace {

using namespace ga_symmetry;

TriangleMesh small_mesh() {
  TriangleMesh mesh;
  constexpr int kSide = 5;
  for (int i = 0; i < kSide * kSide; ++i) {
    const int row = i / kSide, column = i % kSide;
    mesh.position.insert(mesh.position.end(), {double(column), double(row), 0.1 * (i % 3)});
    if (column + 1 == kSide || row + 1 == kSide) continue;
    mesh.triangle.insert(mesh.triangle.end(), {i, i + 1, i + kSide + 1, i, i + kSide + 1, i + kSide});
  }
  return mesh;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const TriangleMesh mesh = small_mesh();
  if (size == 0) return 0;
  const int kind = data[0] % 4;
  const std::string path = fuzz::as_file(kind == 1 ? ".json" : ".csv", fuzz::Bytes(data + 1, size - 1).rest());
  fuzz::expect_result_or_line([&] {
    if (kind == 2) {
      for (const auto& column : read_value_table(path, mesh.vertices()).columns)
        if (column.size() != static_cast<std::size_t>(mesh.vertices())) std::abort();
      return;
    }
    if (kind == 3) {
      evaluate_partners(mesh, read_truth(path), std::vector<int>(mesh.vertices(), 0));
      return;
    }
    const Partners raw = read_partners(path, mesh);
    if (raw.partner.size() != static_cast<std::size_t>(mesh.vertices())) std::abort();
    for (const int p : raw.partner)
      if (p < -1 || p >= mesh.vertices()) std::abort();
    const Partners partners = read_checked_partners(path, mesh);
    AsymmetryOptions options;
    options.threads = 1;
    asymmetry(mesh, partners, options);
  });
  return 0;
}
