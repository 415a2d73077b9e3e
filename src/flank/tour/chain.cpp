#include "flank/tour/chain.h"

#include <algorithm>
#include <utility>

namespace flank::internal {
namespace {

constexpr double kTouchMm = 2e-3;     ///< how near ends of edges are that are one
constexpr double kOffChordMm = 1e-4;  ///< how far a straight edge may be off its chord
constexpr double kOverMm = 1e-2;      ///< shorter edges say nothing of a direction

/// A straight edge of one face.
struct FaceLine {
  std::size_t face = 0;
  const BSplineCurve2* trim = nullptr;
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();
};

/// A straight edge of two.
struct SharedLine {
  std::size_t a = 0, b = 0;  ///< faces
  const BSplineCurve2 *trim_a = nullptr, *trim_b = nullptr;
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();
  [[nodiscard]] bool has(std::size_t face) const { return a == face || b == face; }
};

bool is_straight(const std::vector<Vec3>& points) {
  const Vec3 chord = points.back() - points.front();
  const double length = chord.norm();
  if (length < kOverMm) return false;
  return std::all_of(points.begin(), points.end(),
                     [&](const Vec3& p) { return (p - points.front()).cross(chord).norm() <= kOffChordMm * length; });
}

std::vector<FaceLine> straight_edges(const std::vector<Face>& faces) {
  constexpr int kPoints = 7;
  std::vector<FaceLine> lines;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (const TrimLoop& loop : faces[f].loops)
      for (const BSplineCurve2& edge : loop.edges) {
        const std::vector<Vec3> points = points_along(faces[f], edge, kPoints);
        if (is_straight(points)) lines.push_back({f, &edge, points.front(), points.back()});
      }
  return lines;
}

std::vector<SharedLine> shared_lines(const std::vector<Face>& faces) {
  const std::vector<FaceLine> lines = straight_edges(faces);
  std::vector<SharedLine> shared;
  const auto near = [](const Vec3& p, const Vec3& q) { return (p - q).norm() <= kTouchMm; };
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t j = i + 1; j < lines.size(); ++j) {
      const FaceLine &p = lines[i], &q = lines[j];
      const bool same = near(p.from, q.from) && near(p.to, q.to), turned = near(p.from, q.to) && near(p.to, q.from);
      if (p.face != q.face && (same || turned)) shared.push_back({p.face, q.face, p.trim, q.trim, p.from, p.to});
    }
  return shared;
}

std::size_t count_of(const std::vector<SharedLine>& shared, std::size_t face) {
  return static_cast<std::size_t>(
      std::count_if(shared.begin(), shared.end(), [&](const SharedLine& line) { return line.has(face); }));
}

/// The edge as it is passed by who comes from `face`, with the direction of the edge before.
LateralEdge passed(const SharedLine& line, std::size_t face, const std::optional<LateralEdge>& before) {
  LateralEdge edge{line.from, line.to, line.trim_a, line.trim_b};
  if (line.a != face) std::swap(edge.before, edge.after);
  if (before && edge.direction().dot(before->direction()) < 0.0) std::swap(edge.foot, edge.head);
  return edge;
}

}  // namespace

const LateralEdge* Chain::begin_of(std::size_t i) const {
  if (i > 0) return &edges[i - 1];
  return closed ? &edges.back() : nullptr;
}

const LateralEdge* Chain::end_of(std::size_t i) const { return i < edges.size() ? &edges[i] : nullptr; }

Chain Chain::reversed() const {
  Chain other = *this;
  std::reverse(other.order.begin(), other.order.end());
  std::reverse(other.edges.begin(), other.edges.end());
  // Of a closed chain the edge that leads back stays the last one: the new first wall was the last one.
  if (closed) std::rotate(other.edges.begin(), other.edges.begin() + 1, other.edges.end());
  for (LateralEdge& edge : other.edges) std::swap(edge.before, edge.after);
  return other;
}

Chain Chain::upside_down() const {
  Chain other = *this;
  for (LateralEdge& edge : other.edges) std::swap(edge.foot, edge.head);
  return other;
}

std::vector<Vec3> points_along(const Face& face, const BSplineCurve2& edge, int count) {
  std::vector<Vec3> points;
  for (int k = 0; k < count; ++k) {
    const Vec2 q = edge.value(edge.first() + (edge.last() - edge.first()) * k / (count - 1));
    points.push_back(face.surface.value(q.x(), q.y()));
  }
  return points;
}

std::optional<Chain> find_chain(const std::vector<Face>& faces) {
  if (faces.size() < 2) return {};
  const std::vector<SharedLine> shared = shared_lines(faces);
  std::size_t start = 0, ends = 0;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const std::size_t joints = count_of(shared, f);
    if (joints == 0 || joints > 2) return {};
    if (joints == 1 && ends++ == 0) start = f;
  }
  if (ends != 0 && ends != 2) return {};
  Chain chain;
  chain.closed = ends == 0;
  chain.order = {start};
  std::vector<char> used(shared.size(), 0);
  std::optional<LateralEdge> before;
  for (;;) {
    const std::size_t here = chain.order.back();
    std::size_t next = 0;
    while (next < shared.size() && (used[next] != 0 || !shared[next].has(here))) ++next;
    if (next == shared.size()) break;
    used[next] = 1;
    before = passed(shared[next], here, before);
    chain.edges.push_back(*before);
    const std::size_t other = shared[next].a == here ? shared[next].b : shared[next].a;
    if (other == start) break;
    chain.order.push_back(other);
  }
  // Several chains are not one.
  if (chain.order.size() != faces.size()) return {};
  return chain;
}

}  // namespace flank::internal
