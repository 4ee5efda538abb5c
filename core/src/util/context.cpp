// SPDX-License-Identifier: GPL-3.0-or-later
#include "ga_symmetry/context.h"

#include "ga_symmetry/errors.h"

namespace ga_symmetry {

void Context::report(double fraction, const char* stage) const {
  if (cancelled()) throw Cancelled();
  if (progress) progress(fraction, stage);
}

void Context::advance(double fraction) const {
  if (cancelled()) throw Cancelled();
  if (progress && stage) progress(fraction, stage);
}

Context Context::part(double first, double last) const { return part(first, last, stage); }

Context Context::part(double first, double last, const char* name) const {
  Context out{nullptr, cancel, name};
  if (progress)
    out.progress = [whole = progress, first, last](double fraction, const char* stage) {
      whole(first + (last - first) * fraction, stage);
    };
  return out;
}

}  // namespace ga_symmetry
