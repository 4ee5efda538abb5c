#include "ga_symmetry/context.h"

#include "ga_symmetry/errors.h"

namespace ga_symmetry {

void Context::report(double fraction, const char* stage) const {
  if (cancelled()) throw Cancelled();
  if (progress) progress(fraction, stage);
}

Context Context::part(double first, double last) const {
  Context out{nullptr, cancel};
  if (progress)
    out.progress = [whole = progress, first, last](double fraction, const char* stage) {
      whole(first + (last - first) * fraction, stage);
    };
  return out;
}

}  // namespace ga_symmetry
