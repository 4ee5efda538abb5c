#include "ga_symmetry/geodesics.h"

#include <algorithm>
#include <cmath>

#include "ga_symmetry/errors.h"
#include "ga_symmetry/parallel.h"

namespace ga_symmetry {

struct GeodesicSolver::Impl {
  // A triangle as its vertex `a` sees it: where the front comes from a (with b) and goes to c, and the other way.
  struct Wedge {
    int b, c;
    float ab, ac, bc;
    float cx, cy;  // c in the frame a = (0,0), b = (ab,0)
    float bx, by;  // b in the frame a = (0,0), c = (ac,0)
  };
  int n = 0;
  std::vector<int> first;
  std::vector<Wedge> wedges;
};

struct GeodesicSolver::Workspace {
  std::vector<int> heap;  // 4-ary, by distance
  std::vector<int> slot;  // vertex -> place in heap, -1 = not in it
};

void GeodesicSolver::WorkspaceDeleter::operator()(Workspace* w) const { delete w; }

GeodesicSolver::WorkspacePointer GeodesicSolver::make_workspace() const {
  WorkspacePointer w(new Workspace);
  w->heap.reserve(impl_->n);
  w->slot.assign(impl_->n, -1);
  return w;
}

GeodesicSolver::GeodesicSolver(const Surface& s) : impl_(new Impl) {
  Impl& m = *impl_;
  m.n = s.vertices();
  m.first = s.first_corner;
  m.wedges.resize(s.corner_at.size());
  for (std::size_t i = 0; i < s.corner_at.size(); ++i) {
    const int corner = s.corner_at[i];
    Impl::Wedge& w = m.wedges[i];
    const int a = s.triangle[corner];
    w.b = s.triangle[next_corner(corner)];
    w.c = s.triangle[previous_corner(corner)];
    const double ab = s.edge_length(a, w.b), ac = s.edge_length(a, w.c), bc = s.edge_length(w.b, w.c);
    w.ab = static_cast<float>(ab), w.ac = static_cast<float>(ac), w.bc = static_cast<float>(bc);
    const double cx = (ab * ab + ac * ac - bc * bc) / (2 * ab), bx = (ab * ab + ac * ac - bc * bc) / (2 * ac);
    w.cx = static_cast<float>(cx), w.cy = static_cast<float>(std::sqrt(std::max(0.0, ac * ac - cx * cx)));
    w.bx = static_cast<float>(bx), w.by = static_cast<float>(std::sqrt(std::max(0.0, ab * ab - bx * bx)));
  }
}

GeodesicSolver::~GeodesicSolver() = default;

namespace {

// Arrival at c = (x,y) of a circular front that passed a = (0,0) at time da and b = (l,0) at time db: the source is
// unfolded into the plane of the triangle, below ab. Valid only where the ray from there to c crosses ab.
inline float through_edge(float da, float db, float l, float x, float y) {
  const float sx = 0.5f * ((da - db) * (da + db) / l + l);
  const float h2 = da * da - sx * sx;
  if (!(h2 > 0)) return std::numeric_limits<float>::infinity();
  const float h = std::sqrt(h2), dx = x - sx, dy = y + h;
  const float crossing = sx * dy + dx * h;  // times dy
  if (crossing < 0 || crossing > l * dy) return std::numeric_limits<float>::infinity();
  return std::sqrt(dx * dx + dy * dy);
}

}  // namespace

void GeodesicSolver::field(int source, float* d, Workspace& workspace) const {
  const Impl& m = *impl_;
  std::fill(d, d + m.n, std::numeric_limits<float>::infinity());
  std::vector<int>& heap = workspace.heap;
  int* slot = workspace.slot.data();
  heap.clear();
  const auto place = [&](int at, int v) { heap[at] = v, slot[v] = at; };
  const auto lower = [&](int v, float value) {
    d[v] = value;
    int at = slot[v];
    if (at < 0) {
      at = static_cast<int>(heap.size());
      heap.push_back(v);
    }
    while (at > 0) {
      const int up = (at - 1) / 4;
      if (d[heap[up]] <= value) break;
      place(at, heap[up]);
      at = up;
    }
    place(at, v);
  };
  const auto pop = [&] {
    const int top = heap[0], last = heap.back();
    heap.pop_back();
    slot[top] = -1;
    const int size = static_cast<int>(heap.size());
    if (size) {
      int at = 0;
      for (;;) {
        int best = -1;
        float least = d[last];
        for (int child = 4 * at + 1, end = std::min(size, 4 * at + 5); child < end; ++child)
          if (d[heap[child]] < least) least = d[heap[child]], best = child;
        if (best < 0) break;
        place(at, heap[best]);
        at = best;
      }
      place(at, last);
    }
    return top;
  };
  lower(source, 0);
  while (!heap.empty()) {
    const int a = pop();
    const float da = d[a];
    for (int i = m.first[a]; i < m.first[a + 1]; ++i) {
      const Impl::Wedge& w = m.wedges[i];
      const float db = d[w.b], dc = d[w.c];
      if (dc > da) {
        float t = da + w.ac;
        if (db < std::numeric_limits<float>::infinity()) t = std::min(t, through_edge(da, db, w.ab, w.cx, w.cy));
        if (t < dc * (1 - 1e-6f)) lower(w.c, t);
      }
      if (db > da) {
        float t = da + w.ab;
        if (dc < std::numeric_limits<float>::infinity()) t = std::min(t, through_edge(da, dc, w.ac, w.bx, w.by));
        if (t < db * (1 - 1e-6f)) lower(w.b, t);
      }
    }
  }
}

DistanceFields GeodesicSolver::fields(const std::vector<int>& sources, int threads, const Context& context) const {
  for (int s : sources)
    if (s < 0 || s >= impl_->n) throw InvalidOption("geodesic source " + std::to_string(s) + " is not a vertex");
  DistanceFields out(static_cast<Eigen::Index>(sources.size()), impl_->n);
  std::vector<WorkspacePointer> workspace(thread_count(threads));
  parallel_for(static_cast<int>(sources.size()), threads, [&](int i, int worker) {
    if (context.cancelled()) throw Cancelled();
    if (!workspace[worker]) workspace[worker] = make_workspace();
    field(sources[i], out.row(i).data(), *workspace[worker]);
  });
  return out;
}

}  // namespace ga_symmetry
