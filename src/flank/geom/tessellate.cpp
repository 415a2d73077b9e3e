#include "flank/geom/tessellate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "flank/error.h"
#include "flank/geom/trim.h"

namespace flank::internal {
namespace {

constexpr int kProbes = 9;        ///< per direction, where the surface is asked how it bends
constexpr int kFiner = 4;         ///< a cut cell is divided into this many cells a side
constexpr int kBisections = 20;   ///< of the place where a loop crosses the side of a cell
constexpr int kBorderSteps = 24;  ///< points on a trimming edge, between two of its knots at least one

/// Grid lines in one direction: every kink of the surface is one, between them equal steps.
std::vector<double> grid_lines(const std::vector<double>& knots, int degree, double low, double high, int steps) {
  std::vector<double> stops{low};
  for (std::size_t k = 0; k < knots.size(); ++k) {
    // A knot as often as the degree is where the surface may have a kink: a triangle across it would round it off.
    const auto same = std::count(knots.begin(), knots.end(), knots[k]);
    if (same >= degree && knots[k] > stops.back() && knots[k] < high) stops.push_back(knots[k]);
  }
  stops.push_back(high);
  std::vector<double> lines{low};
  for (std::size_t k = 0; k + 1 < stops.size(); ++k) {
    const double width = stops[k + 1] - stops[k];
    // The slack keeps a width of exactly one step from becoming two.
    const int count = std::max(1, static_cast<int>(std::ceil(steps * width / (high - low) - 1e-9)));
    for (int i = 1; i <= count; ++i) lines.push_back(i == count ? stops[k + 1] : stops[k] + width * i / count);
  }
  return lines;
}

/// Cells that one direction needs: by its length, and by its bend (a chord over h is off by |S''| h^2 / 8).
struct Need {
  double length = 0.0, bend = 0.0;
  [[nodiscard]] int steps(const TessellationOptions& o) const {
    // The larger of both demands, at least one cell.
    const double wanted = std::max({1.0, length / o.edge_mm, std::sqrt(bend / (8.0 * o.chord_mm))});
    return static_cast<int>(std::min<double>(std::ceil(wanted), o.most_steps));
  }
};

/// Sampled, so a picture only: nothing is promised between the samples.
std::pair<Need, Need> needs(const BSplineSurface& s, const ParameterRectangle& box) {
  Need u, v;
  const double width = box.u1 - box.u0, height = box.v1 - box.v0;
  for (int i = 0; i < kProbes; ++i)
    for (int j = 0; j < kProbes; ++j) {
      const SurfaceJet jet = s.jet(box.u0 + width * (i + 0.5) / kProbes, box.v0 + height * (j + 0.5) / kProbes);
      u.length = std::max(u.length, jet.du.norm() * width);
      v.length = std::max(v.length, jet.dv.norm() * height);
      // The mixed derivative bends a cell's diagonal; each direction takes its share of it.
      u.bend = std::max(u.bend, (jet.duu.norm() * width + jet.duv.norm() * height) * width);
      v.bend = std::max(v.bend, (jet.dvv.norm() * height + jet.duv.norm() * width) * height);
    }
  return {u, v};
}

/// Triangles of the cells. Vertices at equal parameters are one, so that neighbours share them.
class Builder {
 public:
  Builder(const Face& face, const TrimRegion& region) : face_(face), region_(region) {}

  /// Whole if inside, left out if outside, in finer cells if a loop passes through.
  void add_cell(const ParameterRectangle& cell) {
    const TrimRegion::Side side = region_.classify(cell);
    if (side == TrimRegion::Side::kOutside) return;
    if (side == TrimRegion::Side::kInside) return add_polygon(corners(cell));
    // Finer only along loops: there the corners of cells are what is seen.
    for (int i = 0; i < kFiner; ++i)
      for (int j = 0; j < kFiner; ++j) add_cut(part(cell, i, j));
  }

  TriangleMesh take() { return std::move(mesh_); }
  std::vector<Vec2> take_parameters() { return std::move(parameters_); }

 private:
  static std::vector<Vec2> corners(const ParameterRectangle& r) {
    return {{r.u0, r.v0}, {r.u1, r.v0}, {r.u1, r.v1}, {r.u0, r.v1}};
  }

  static ParameterRectangle part(const ParameterRectangle& r, int i, int j) {
    const auto at = [](double low, double high, int k) { return k == kFiner ? high : low + (high - low) * k / kFiner; };
    return {at(r.u0, r.u1, i), at(r.u0, r.u1, i + 1), at(r.v0, r.v1, j), at(r.v0, r.v1, j + 1)};
  }

  [[nodiscard]] bool inside(const Vec2& q) const { return region_.inside(q.x(), q.y()); }

  /// Where the loop crosses the side of a cell between a point inside and one outside.
  [[nodiscard]] Vec2 crossing(Vec2 in, Vec2 out) const {
    for (int k = 0; k < kBisections; ++k) {
      const Vec2 middle = 0.5 * (in + out);
      (inside(middle) ? in : out) = middle;
    }
    return 0.5 * (in + out);
  }

  /// Keeps the corners that are inside, and the crossings between them.
  void add_cut(const ParameterRectangle& cell) {
    const std::vector<Vec2> all = corners(cell);
    std::vector<Vec2> kept;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const Vec2 &a = all[k], &b = all[(k + 1) % all.size()];
      const bool a_in = inside(a), b_in = inside(b);
      if (a_in) kept.push_back(a);
      if (a_in != b_in) kept.push_back(a_in ? crossing(a, b) : crossing(b, a));
    }
    if (kept.size() > 2) add_polygon(kept);
  }

  /// A fan: the polygons are convex, or nearly.
  void add_polygon(const std::vector<Vec2>& polygon) {
    std::vector<int> index;
    for (const Vec2& q : polygon) index.push_back(vertex(q));
    for (std::size_t k = 1; k + 1 < index.size(); ++k) {
      const int a = index[0], b = index[k], c = index[k + 1];
      if (a == b || b == c || c == a) continue;
      // Triangles turn as the face's normal does, which is the surface's or its opposite.
      if (face_.reversed)
        mesh_.triangles.push_back({a, c, b});
      else
        mesh_.triangles.push_back({a, b, c});
    }
  }

  int vertex(const Vec2& q) {
    // Equal to the bit: neighbouring cells compute a common corner from the same numbers (part, grid_lines).
    const auto [entry, is_new] = index_.try_emplace({q.x(), q.y()}, static_cast<int>(mesh_.vertices.size()));
    if (is_new) {
      mesh_.vertices.push_back(face_.surface.value(q.x(), q.y()));
      parameters_.push_back(q);
    }
    return entry->second;
  }

  const Face& face_;
  const TrimRegion& region_;
  TriangleMesh mesh_;
  std::vector<Vec2> parameters_;
  std::map<std::pair<double, double>, int> index_;
};

/// The points of a loop on the surface, in its order.
std::vector<Vec3> border(const Face& face, const TrimLoop& loop) {
  std::vector<Vec3> points;
  for (const BSplineCurve2& edge : loop.edges) {
    // More for edges of many poles; an edge's number of knots is about that of its poles.
    const int steps = kBorderSteps * std::clamp(static_cast<int>(edge.poles.cols()) / 8, 1, 8);
    for (int k = points.empty() ? 0 : 1; k <= steps; ++k) {
      const Vec2 q = edge.value(edge.first() + (edge.last() - edge.first()) * k / steps);
      points.push_back(face.surface.value(q.x(), q.y()));
    }
  }
  return points;
}

}  // namespace

Tessellation tessellate(const Face& face, const TessellationOptions& options) {
  if (!(options.chord_mm > 0.0) || !(options.edge_mm > 0.0) || options.most_steps < 1)
    throw UsageError("a tessellation needs a chord and an edge > 0 mm and at least one step");
  const BSplineSurface& s = face.surface;
  const ParameterRectangle domain{s.u_first(), s.u_last(), s.v_first(), s.v_last()};
  const TrimRegion region(face.loops, domain);
  const ParameterRectangle& box = region.box();
  const auto [need_u, need_v] = needs(s, box);
  const std::vector<double> us = grid_lines(s.knots_u, s.degree_u, box.u0, box.u1, need_u.steps(options));
  const std::vector<double> vs = grid_lines(s.knots_v, s.degree_v, box.v0, box.v1, need_v.steps(options));
  Builder builder(face, region);
  for (std::size_t j = 0; j + 1 < vs.size(); ++j)
    for (std::size_t i = 0; i + 1 < us.size(); ++i) builder.add_cell({us[i], us[i + 1], vs[j], vs[j + 1]});
  Tessellation out;
  out.mesh = builder.take();
  out.parameters = builder.take_parameters();
  std::vector<TrimLoop> loops = face.loops;
  // The rim of the whole surface: every face has a border to be drawn.
  if (loops.empty()) loops.push_back(rectangle_loop(domain));
  for (const TrimLoop& loop : loops) out.borders.push_back(border(face, loop));
  return out;
}

void append(TriangleMesh& all, const TriangleMesh& mesh) {
  const int first = static_cast<int>(all.vertices.size());
  all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
  for (const auto& t : mesh.triangles) all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

}  // namespace flank::internal
