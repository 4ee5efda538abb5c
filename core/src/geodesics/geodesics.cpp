// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesics/geodesics.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <queue>
#include <string>
#include <utility>

#include "ga_symmetry/errors.h"
#include "util/parallel.h"

namespace ga_symmetry {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr double kPi = 3.14159265358979323846;
// Curvature of the front at a source: stands for infinity, but can be multiplied.
constexpr float kPointCurvature = 1e30f;
// An edge resolves a front whose radius is not much below its length; see `edge_curvature`.
constexpr float kResolved = 0.7f;
// A vertex that was done is visited again for a gain of so much of an edge: smaller ones cost more than they bring.
constexpr float kWorthwhile = 5e-5f;
// Where visits have no end: of an average edge. The smaller it is, the more visits.
constexpr float kPlainGain = 0.05f;
// Rings over which the Gaussian curvature is averaged: single vertices of a coarse mesh are too noisy to follow.
constexpr int kCurvatureRings = 3;
// Buckets of the queue, and how many of them an average edge spans.
constexpr int kBuckets = 1024;
constexpr float kBucketsPerEdge = 16;
// Vertices joined by an edge shorter than this share of a bucket leave it in no order, and are visited again and again.
// On meshes with more such edges the exact queue is faster.
constexpr float kShortest = 0.25f;
constexpr int kMostShort = 256;

// A neighbour of a vertex, and the angle to the next neighbour in the list if they share a triangle.
struct Spoke {
  int to;
  float length;
  float cosine, sine;  // sine 0 = no triangle
};

struct Hub {
  int first;        // of its spokes
  float curvature;  // Gaussian, of the surface
};

// State of a vertex: the front that passed it, and its place in a bucket of the queue (a doubly linked list).
struct Node {
  float distance, curvature;  // of the front: 1 / radius, > 0 where it spreads
  int next, prev;             // next < 0 = last; prev < 0 = first of bucket -1 - prev, or kOut
};
constexpr int kOut = std::numeric_limits<int>::min();
constexpr Node kFresh{kInfinity, 0, -1, kOut};

inline bool settled(const Node& x) { return x.prev == kOut && x.distance < kInfinity; }

// Vertices by distance in buckets: exact order does not matter within a small part of an edge, as a vertex that comes
// too early is visited again. Buckets are a ring; what is too far ahead waits in the last one.
class Queue {
 public:
  Queue(Node* node, int* head, std::uint64_t* occupied, float buckets_per_length)
      : node_(node), head_(head), occupied_(occupied), scale_(buckets_per_length) {}

  bool empty() const { return size_ == 0; }

  void put(int v, float distance, float curvature) {
    Node& x = node_[v];
    if (x.prev != kOut) unlink(x);
    x.distance = distance, x.curvature = curvature;
    const int b = static_cast<int>(std::clamp(bucket(distance), now_, now_ + kBuckets - 1) % kBuckets);
    x.next = head_[b], x.prev = -1 - b;
    if (x.next >= 0)
      node_[x.next].prev = v;
    else
      occupied_[b / 64] |= bit(b);
    head_[b] = v;
    ++size_;
  }

  // Takes a nearest vertex out; `after` is the one that will probably follow, or -1.
  int take(int& after) {
    for (;;) {
      advance();
      const int v = head_[now_ % kBuckets];
      Node& x = node_[v];
      after = x.next;
      unlink(x);
      if (bucket(x.distance) <= now_) return v;
      put(v, x.distance, x.curvature);
    }
  }

 private:
  static std::uint64_t bit(std::int64_t b) { return std::uint64_t{1} << (b % 64); }
  std::int64_t bucket(float distance) const { return static_cast<std::int64_t>(distance * scale_); }

  void unlink(Node& x) {
    if (x.next >= 0) node_[x.next].prev = x.prev;
    if (x.prev >= 0) {
      node_[x.prev].next = x.next;
    } else {
      const int b = -1 - x.prev;
      head_[b] = x.next;
      if (x.next < 0) occupied_[b / 64] &= ~bit(b);
    }
    x.prev = kOut;
    --size_;
  }

  void advance() {
    std::int64_t word = now_ / 64;
    std::uint64_t bits = occupied_[word % (kBuckets / 64)] & ~(bit(now_) - 1);
    while (!bits) bits = occupied_[++word % (kBuckets / 64)];
    now_ = 64 * word + __builtin_ctzll(bits);
  }

  Node* node_;
  int* head_;
  std::uint64_t* occupied_;  // one bit a bucket
  float scale_;
  std::int64_t now_ = 0;  // bucket that is being emptied, counted from distance 0
  int size_ = 0;
};

// The same in exact order: buckets as wide as whole parts of the mesh would be visited in no order at all, again and
// again, so this is for meshes with many edges that are far shorter than the average.
class ExactQueue {
 public:
  explicit ExactQueue(Node* node) : node_(node) {}

  bool empty() const { return size_ == 0; }

  void put(int v, float distance, float curvature) {
    Node& x = node_[v];
    if (x.prev == kOut) ++size_;
    x = {distance, curvature, -1, 0};
    heap_.emplace(distance, v);
  }

  int take(int& after) {
    after = -1;
    for (;;) {
      const auto [distance, v] = heap_.top();
      heap_.pop();
      Node& x = node_[v];
      if (x.prev == kOut || x.distance != distance) continue;  // has been put again since
      x.prev = kOut;
      --size_;
      return v;
    }
  }

 private:
  using Entry = std::pair<float, int>;
  Node* node_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> heap_;
  int size_ = 0;
};

// Curvature of the front where it crosses an edge, from that at its ends: the mean of the radii where it spreads, as
// the radius grows by the way travelled. If the radius is too small for the edge, the ends have seen different fronts;
// only the source's own front may be that narrow.
inline float edge_curvature(const Node& a, const Node& b, float length) {
  const float mean = a.curvature > 0 && b.curvature > 0 ? a.curvature * (2 * b.curvature / (a.curvature + b.curvature))
                                                        : 0.5f * (a.curvature + b.curvature);
  if (!(mean * length > kResolved)) return mean;
  return std::max(kResolved / length, std::min(mean, 2 / (a.distance + b.distance)));
}

struct Arrival {
  float distance = kInfinity, curvature = 0;
};

// Lowers `at` to the front's arrival at a vertex t, straight across the edge ab of a flat triangle, if it comes there.
// cosine, sine: of the angle at a. gauss: curvature of the surface.
//
// In the frame of the edge's midpoint, b on the right, t above: the front's centre lies below at (-r s, -h), where r is
// the mean of its distances to a and b, s = (d(b) - d(a)) / |ab| and h^2 = (1 - s^2) (r^2 - |ab|^2 / 4). All is
// divided by r, so that a straight front (k = 1 / r = 0) and one that closes in (k < 0) need no case of their own.
inline void cross_edge(const Node& a, const Node& b, float ab, float at, float cosine, float sine, float gauss,
                       Arrival& best) {
  const float slope = (b.distance - a.distance) / ab, rest = 1 - slope * slope;
  if (!(rest > 0)) return;
  const float k = edge_curvature(a, b, ab);
  const float room = 1 - 0.25f * k * k * ab * ab;
  if (!(room >= 0)) return;
  const float h = std::sqrt(rest * room), x = at * cosine - 0.5f * ab, y = at * sine, up = k * y + h;
  if (!(std::abs(x * h - y * slope) <= 0.5f * ab * up)) return;                       // the ray to t misses the edge
  const float across = k * x + slope, radius = std::sqrt(across * across + up * up);  // of the front at t, times k
  const float way = (k * (x * x + y * y - 0.25f * rest * ab * ab) + 2 * (x * slope + y * h)) / (1 + radius);
  const float distance = 0.5f * (a.distance + b.distance) + way;
  if (distance < best.distance) best = {distance, std::max(-1 / at, k / radius - gauss * way)};
}

// Whether a front over the edge ab can come to t before it comes to a: where the angle at t is obtuse, or so near to a
// right one that the curvature of the front makes up for it.
inline bool may_come_before(const Spoke& at, const Node& t, const Spoke& ab, float cosine) {
  return at.length * (1 - 0.5f * t.curvature * ab.length) < ab.length * cosine;
}

inline Arrival along_edge(const Node& a, float length, float gauss) {
  const float k = std::max(a.curvature, -0.5f / length);  // a front that closes in does so behind the next vertex
  return {a.distance + length, k / (1 + k * length) - gauss * length};
}

}  // namespace

// Vertices are renumbered along a space-filling curve, so that a front finds its neighbours in the cache.
struct GeodesicSolver::Impl {
  int n = 0;
  std::vector<int> vertex;  // new number -> vertex of the surface
  std::vector<int> number;  // the other way
  std::vector<Hub> hub;     // n + 1
  std::vector<Spoke> spoke;
  float buckets_per_length = 0;
  bool uneven = false;  // too many edges are short against a bucket

  void renumber(const Surface& s);
  void link(const Surface& s);
  void measure_curvature();
  void check(int source) const {
    if (source < 0 || source >= n)
      throw InvalidOption("a geodesic source must be a vertex in [0," + std::to_string(n - 1) + "], got " +
                          std::to_string(source));
  }
  template <bool labelled>
  void march(const int* sources, int count, float limit, Workspace& w, std::vector<int>* reached) const;
  template <bool labelled, bool plain, class Waiting>
  bool march(const int* sources, int count, float limit, Workspace& w, std::vector<int>* reached, Waiting queue,
             std::int64_t visits) const;
};

struct GeodesicSolver::Workspace {
  std::vector<Node> node;  // all fresh between two calls
  std::vector<int> head = std::vector<int>(kBuckets, -1);
  std::vector<std::uint64_t> occupied = std::vector<std::uint64_t>(kBuckets / 64, 0);
  std::vector<int> label;  // used by `nearest` alone
};

void GeodesicSolver::Impl::renumber(const Surface& s) {
  double low[3], size = 0;
  for (int k = 0; k < 3; ++k) {
    double high = low[k] = s.position[k];
    for (std::size_t i = k; i < s.position.size(); i += 3)
      low[k] = std::min(low[k], s.position[i]), high = std::max(high, s.position[i]);
    size = std::max(size, high - low[k]);
  }
  constexpr int kBits = 20;  // per axis
  std::vector<std::pair<std::uint64_t, int>> order(n);
  for (int v = 0; v < n; ++v) {
    std::uint64_t cell[3], key = 0;
    for (int k = 0; k < 3; ++k)
      cell[k] = static_cast<std::uint64_t>((s.point(v)[k] - low[k]) / size * ((1 << kBits) - 1));
    for (int bit = kBits; bit-- > 0;)
      for (const std::uint64_t c : cell) key = 2 * key + (c >> bit & 1);
    order[v] = {key, v};
  }
  std::sort(order.begin(), order.end());
  number.resize(n);
  for (int i = 0; i < n; ++i) {
    vertex.push_back(order[i].second);
    number[order[i].second] = i;
  }
}

void GeodesicSolver::Impl::link(const Surface& s) {
  const auto corner_of = [&](int face, int v) {
    int c = 3 * face;
    while (s.triangle[c] != v) ++c;
    return c;
  };
  // The corner opposite to the edge from v to x, in a face that has both.
  const auto facing = [&](int face, int v, int x) {
    int c = 3 * face;
    while (s.triangle[c] == v || s.triangle[c] == x) ++c;
    return c;
  };
  std::vector<char> seen(s.triangle.size(), 0);
  std::vector<int> fan;
  double total_length = 0;
  hub.reserve(n + 1);
  spoke.reserve(s.triangle.size() + n);
  for (int i = 0; i < n; ++i) {
    const int v = vertex[i];
    hub.push_back({static_cast<int>(spoke.size()), 0});
    for (int j = s.first_corner[v]; j < s.first_corner[v + 1]; ++j) {
      if (seen[s.corner_at[j]]) continue;
      // Back to the border, or once around; then forward, collecting the neighbours.
      const int start = s.corner_at[j] / 3;
      int face = start, x = s.triangle[next_corner(s.corner_at[j])];
      bool closed = false;
      for (int o; !closed && (o = s.opposite[facing(face, v, x)]) >= 0; closed = face == start)
        x = s.triangle[o], face = o / 3;
      fan.assign(1, x);
      for (int f = face, o; f >= 0; f = o < 0 || o / 3 == face ? -1 : o / 3) {
        seen[corner_of(f, v)] = 1;
        fan.push_back(s.triangle[facing(f, v, fan.back())]);
        o = s.opposite[facing(f, v, fan.back())];
      }
      // The same start and direction whatever the order of the faces and their corners.
      for (int& to : fan) to = number[to];
      if (closed) {
        fan.pop_back();
        std::rotate(fan.begin(), std::min_element(fan.begin(), fan.end()), fan.end());
        if (fan.back() < fan[1]) std::reverse(fan.begin() + 1, fan.end());
        fan.push_back(fan[0]);
      } else if (fan.back() < fan[0]) {
        std::reverse(fan.begin(), fan.end());
      }
      for (std::size_t k = 0; k < fan.size(); ++k) {
        const double length = s.edge_length(v, vertex[fan[k]]);
        double cosine = 1;
        if (k + 1 < fan.size()) {
          const double next = s.edge_length(v, vertex[fan[k + 1]]);
          const double far = s.edge_length(vertex[fan[k]], vertex[fan[k + 1]]);
          cosine = std::clamp((length * length + next * next - far * far) / (2 * length * next), -1.0, 1.0);
        }
        spoke.push_back({fan[k], static_cast<float>(length), static_cast<float>(cosine),
                         static_cast<float>(std::sqrt(1 - cosine * cosine))});
        total_length += length;
      }
    }
  }
  hub.push_back({static_cast<int>(spoke.size()), 0});
  buckets_per_length = static_cast<float>(kBucketsPerEdge * static_cast<double>(spoke.size()) / total_length);
  uneven = std::count_if(spoke.begin(), spoke.end(),
                         [&](const Spoke& s) { return s.length * buckets_per_length < kShortest; }) > kMostShort;
}

// Angle defect over area, averaged over a few rings; 0 where the surface ends, as nothing is known there.
void GeodesicSolver::Impl::measure_curvature() {
  std::vector<double> area(n, 0), curvature(n);
  for (int i = 0; i < n; ++i) {
    double defect = 2 * kPi;
    bool border = false;
    for (int j = hub[i].first, fan = j; j < hub[i + 1].first; ++j) {
      const Spoke& s = spoke[j];
      if (s.sine > 0) {
        defect -= std::atan2(s.sine, s.cosine);
        area[i] += s.length * spoke[j + 1].length * s.sine / 6;
      } else {
        border |= s.to != spoke[fan].to;
        fan = j + 1;
      }
    }
    curvature[i] = border ? 0 : defect / area[i];
  }
  std::vector<double> next(n);
  for (int ring = 0; ring < kCurvatureRings; ++ring) {
    for (int i = 0; i < n; ++i) {
      double weight = area[i], sum = area[i] * curvature[i];
      for (int j = hub[i].first; j < hub[i + 1].first; ++j)
        if (spoke[j].sine > 0) weight += area[spoke[j].to], sum += area[spoke[j].to] * curvature[spoke[j].to];
      next[i] = sum / weight;
    }
    curvature.swap(next);
  }
  for (int i = 0; i < n; ++i) hub[i].curvature = static_cast<float>(curvature[i]);
}

GeodesicSolver::GeodesicSolver(const Surface& surface) : impl_(new Impl) {
  impl_->n = surface.vertices();
  impl_->renumber(surface);
  impl_->link(surface);
  impl_->measure_curvature();
}

GeodesicSolver::~GeodesicSolver() = default;

void GeodesicSolver::WorkspaceDeleter::operator()(Workspace* w) const { delete w; }

GeodesicSolver::WorkspacePointer GeodesicSolver::make_workspace() const {
  WorkspacePointer w(new Workspace);
  w->node.assign(impl_->n, kFresh);
  return w;
}

// Lets the front run from the sources, up to `limit`, and leaves the distances in w.node. Sources are new numbers.
template <bool labelled>
void GeodesicSolver::Impl::march(const int* sources, int count, float limit, Workspace& w,
                                 std::vector<int>* reached) const {
  // Most vertices are visited once. Where many lie within a part of a bucket, or faces are so flat that gains are what
  // floats round, there is no end to visits: then in exact order, and for plain gains alone.
  constexpr std::int64_t kMostVisits = 4;  // of a vertex, on average
  Node* const node = w.node.data();
  const std::int64_t most = kMostVisits * n;
  if (uneven ? march<labelled, false>(sources, count, limit, w, reached, ExactQueue(node), most)
             : march<labelled, false>(sources, count, limit, w, reached,
                                      Queue(node, w.head.data(), w.occupied.data(), buckets_per_length), most))
    return;
  std::fill(w.node.begin(), w.node.end(), kFresh);
  std::fill(w.head.begin(), w.head.end(), -1);
  std::fill(w.occupied.begin(), w.occupied.end(), 0);
  if (reached) reached->clear();
  march<labelled, true>(sources, count, limit, w, reached, ExactQueue(node), std::numeric_limits<std::int64_t>::max());
}

// @return false if it had not ended after so many visits of vertices. plain: visits again for plain gains alone
template <bool labelled, bool plain, class Waiting>
bool GeodesicSolver::Impl::march(const int* sources, int count, float limit, Workspace& w, std::vector<int>* reached,
                                 Waiting queue, std::int64_t visits) const {
  Node* const node = w.node.data();
  int* const label = w.label.data();
  for (int i = 0; i < count; ++i) {
    if (node[sources[i]].distance == 0) continue;
    queue.put(sources[i], 0, kPointCurvature);
    if (labelled) label[sources[i]] = i;
    if (reached) reached->push_back(sources[i]);
  }
  const float beyond = std::nextafter(limit, kInfinity);
  const float plain_gain = kPlainGain * kBucketsPerEdge / buckets_per_length;
  while (!queue.empty()) {
    if (--visits < 0) return false;
    int after;
    const int number_a = queue.take(after);
    if (after >= 0) __builtin_prefetch(&spoke[hub[after].first]);
    const Node a = node[number_a];
    const float gauss = hub[number_a].curvature;
    const auto usable = [&](const Node& x, int v) { return settled(x) && (!labelled || label[v] == label[number_a]); };
    // Neighbours b and c in turn, with the triangle a, b, c between them. A settled one and a hold the edge over which
    // the front comes to the other.
    const Spoke* b = spoke.data() + hub[number_a].first;
    const Spoke* const end = spoke.data() + hub[number_a + 1].first;
    Node node_b = node[b->to];
    Arrival at_b, at_c;
    for (;;) {
      const Spoke* const c = b + 1;
      Node node_c = kFresh;
      at_c = Arrival{};
      if (c < end) {
        node_c = node[c->to];
        if (b->sine > 0) {
          if (usable(node_b, b->to) && (node_c.distance > a.distance || may_come_before(*c, node_c, *b, b->cosine)))
            cross_edge(a, node_b, b->length, c->length, b->cosine, b->sine, gauss, at_c);
          if (usable(node_c, c->to) && (node_b.distance > a.distance || may_come_before(*b, node_b, *c, b->cosine)))
            cross_edge(a, node_c, c->length, b->length, b->cosine, b->sine, gauss, at_b);
        }
      }
      const float along = a.distance + b->length;
      if (std::min(at_b.distance, along) < std::min(node_b.distance, beyond)) {
        if (!(at_b.distance < along)) at_b = along_edge(a, b->length, gauss);
        Node& x = node[b->to];
        if (labelled) label[b->to] = label[number_a];
        if (settled(node_b) &&
            !(at_b.distance <
              node_b.distance - (plain ? std::max(plain_gain, kWorthwhile * b->length) : kWorthwhile * b->length))) {
          x.distance = at_b.distance, x.curvature = at_b.curvature;
        } else {
          if (reached && !(x.distance < kInfinity)) reached->push_back(b->to);
          queue.put(b->to, at_b.distance, at_b.curvature);
        }
      }
      if (c == end) break;
      b = c, node_b = node_c, at_b = at_c;
    }
  }
  return true;
}

void GeodesicSolver::field(int source, float* out, Workspace& w) const {
  const Impl& m = *impl_;
  m.check(source);
  m.march<false>(&m.number[source], 1, kInfinity, w, nullptr);
  for (int i = 0; i < m.n; ++i) {
    out[m.vertex[i]] = w.node[i].distance;
    w.node[i] = kFresh;
  }
}

void GeodesicSolver::field_within(int source, float limit, float* out, std::vector<int>& reached, Workspace& w) const {
  const Impl& m = *impl_;
  m.check(source);
  for (const int v : reached) out[v] = kInfinity;
  reached.clear();
  m.march<false>(&m.number[source], 1, limit, w, &reached);
  for (int& v : reached) {
    const float distance = w.node[v].distance;
    w.node[v] = kFresh;
    v = m.vertex[v];
    out[v] = distance;
  }
}

void GeodesicSolver::nearest(const std::vector<int>& sources, float* distance, int* label, Workspace& w) const {
  const Impl& m = *impl_;
  if (sources.empty()) throw InvalidOption("the nearest source needs at least one source");
  std::vector<int> start;
  for (const int s : sources) {
    m.check(s);
    start.push_back(m.number[s]);
  }
  w.label.resize(m.n);
  m.march<true>(start.data(), static_cast<int>(start.size()), kInfinity, w, nullptr);
  for (int i = 0; i < m.n; ++i) {
    distance[m.vertex[i]] = w.node[i].distance;
    label[m.vertex[i]] = w.label[i];
    w.node[i] = kFresh;
  }
}

DistanceFields GeodesicSolver::fields(const std::vector<int>& sources, int threads, const Context& context) const {
  for (const int s : sources) impl_->check(s);
  DistanceFields out(static_cast<Eigen::Index>(sources.size()), impl_->n);
  std::vector<WorkspacePointer> workspace(thread_count(threads));
  parallel_for(static_cast<int>(sources.size()), threads, [&](int i, int worker) {
    if (worker == 0) context.advance(static_cast<double>(i) / static_cast<double>(sources.size()));  // the caller's
    if (context.cancelled()) throw Cancelled();
    if (!workspace[worker]) workspace[worker] = make_workspace();
    field(sources[i], out.row(i).data(), *workspace[worker]);
  });
  return out;
}

}  // namespace ga_symmetry
