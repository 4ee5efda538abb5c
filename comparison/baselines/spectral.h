// SPDX-License-Identifier: GPL-3.0-or-later
// Symmetries as signs of Laplacian eigenfunctions, and their spectral refinement.
#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "baselines/spectrum.h"
#include "ga_symmetry/context.h"
#include "ga_symmetry/symmetry.h"
#include "surface/surface.h"

namespace ga_symmetry::baselines {

/// A functional map of a surface to itself: row v of functions.leftCols(k) * map is what the row of v's partner should
/// be.
using FunctionalMap = Eigen::MatrixXd;

struct SignOptions {
  int enumerated = 7;     ///< eigenfunctions after the constant one whose signs are all tried, [1, 12]
  int functions = 20;     ///< eigenfunctions in all; the further signs follow from the map of the first
  int starts = 6;         ///< the best ones are returned
  bool reversing = true;  ///< those that reverse orientation come first
};

/// Symmetries turn eigenfunctions into themselves or their negatives, so a pattern of signs is a candidate for one. Its
/// score is how far the mirrored samples are from the nearest samples, over how far they were moved, in the embedding
/// by eigenfunctions over the roots of their eigenvalues.
/// @param references  surface vertices; their own distances are added to the score, if there are any
/// @return diagonal maps of options.functions + 1 functions, best first; at least one
/// Source: Ovsjanikov, Sun & Guibas 2008 (the embedding, signs); Nagar & Raman 2018 (further signs from
/// correspondences, in closed form). Differs: all patterns of the first signs are tried instead of a pruned search;
/// patterns next to the identity are kept away by the division; orientation tells a reflection from a half turn.
std::vector<FunctionalMap> sign_patterns(const Surface& surface, const Spectrum& spectrum, const References& references,
                                         const SignOptions& options, int threads);

struct ZoomOutOptions {
  int samples = 1000;     ///< vertices that the map is refined on; 0 = all
  int functions = 100;    ///< eigenfunctions at the end, those of the spectrum at most
  int step = 5;           ///< by so many it grows
  bool reversing = true;  ///< maps that reverse orientation come first
};

/// Refines functional maps by turning them into point maps and back with more and more functions, and takes the one of
/// least energy: |C^T C - I|^2 / k at the end, plus how far the references are off.
/// @param starts  square maps
/// @return per vertex: its partner
/// @throws Cancelled
/// Source: Melzi, Ren, Rodola, Sharma, Wonka & Ovsjanikov, ZoomOut: spectral upsampling for efficient shape
/// correspondence, 2019: also samples by farthest points through space, and the energy.
std::vector<int> zoomout(const Surface& surface, const Spectrum& spectrum, const std::vector<FunctionalMap>& starts,
                         const References& references, const ZoomOutOptions& options, int threads,
                         const Context& context = {});

/// Partners by a functional map. @param map  square, of spectrum.function's columns at most
std::vector<int> to_partners(const Spectrum& spectrum, const FunctionalMap& map, int threads);

/// The functional map of a point map, by least squares over some vertices.
/// @param partner  per vertex of `vertices`
FunctionalMap to_functional_map(const Spectrum& spectrum, const std::vector<int>& vertices,
                                const std::vector<int>& partner, int functions);

/// Share of the triangles whose images are turned over, of those that do not collapse, [0,1]; near 1 for a reflection.
/// @param partner  per vertex; triangles of a vertex with -1 are left out
double reversed_share(const Surface& surface, const std::vector<int>& partner);

/// Evenly spaced vertices by distance through space, the first is the one farthest from the centre.
std::vector<int> space_samples(const Surface& surface, int count);

}  // namespace ga_symmetry::baselines
