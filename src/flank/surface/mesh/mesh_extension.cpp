#include "flank/surface/mesh/mesh_extension.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/base/parallel.h"
#include "flank/surface/mesh/jet_field.h"

namespace flank::internal {
namespace {

/// Each row is this much wider than the one before.
constexpr double kRowGrowth = 1.5;

/// The border's own jet has faded out after this many times the length of the border's sides.
constexpr double kFadeSides = 5.0;

/// Points that a far-reaching fit uses at most; more are thinned out evenly.
constexpr std::size_t kMostFitPoints = 400;
constexpr int kFarDegree = 3;

/// Half the width of such a fit along the border, as a share of its depth: the curvature along the border is none of
/// its business.
constexpr double kFitWidth = 0.4;

/// Triangles of a row may turn at most this far (cosine) from the border's normals.
constexpr double kLeastTurn = 0.2;

/// A border that turns by more than this away from the surface at one vertex has a notch there.
constexpr double kNotchTurn = 0.9;

/// One border loop with what the extension needs of it.
struct Rim {
  std::vector<TriangleSide> sides;
  std::vector<int> vertices;  // of the loop once its notches are covered
  std::vector<Vec3> points, normals, outward;
  double side_length = 0.0;  // mean
  bool hole = false;
};

std::size_t wrap(std::ptrdiff_t i, std::size_t count) {
  const auto n = static_cast<std::ptrdiff_t>(count);
  return static_cast<std::size_t>(((i % n) + n) % n);
}

/// Gaussian mean along a closed loop, sigma in sides.
std::vector<Vec3> smoothed(const std::vector<Vec3>& x, double sigma) {
  const auto reach =
      std::min(static_cast<std::ptrdiff_t>(std::ceil(2.5 * sigma)), static_cast<std::ptrdiff_t>(x.size() / 2));
  if (reach < 1) return x;
  std::vector<Vec3> result(x.size(), Vec3::Zero());
  for (std::size_t i = 0; i < x.size(); ++i) {
    double total = 0.0;
    for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
      const double s = static_cast<double>(k) / sigma, w = std::exp(-0.5 * s * s);
      result[i] += w * x[wrap(static_cast<std::ptrdiff_t>(i) + k, x.size())];
      total += w;
    }
    result[i] /= total;
  }
  return result;
}

/// Signed angle by which a path a, b, c turns to the left about `normal`.
double turn(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) {
  const Vec3 in = b - a, out = c - b;
  return std::atan2(normal.dot(in.cross(out)), in.dot(out));
}

/// Covers the notches of a jagged loop with triangles between its own vertices, sharpest first, so that rows can follow
/// it.
void fill_notches(JetSurface& surface, Rim& rim) {
  std::vector<int>& loop = rim.vertices;
  const auto place = [&](std::size_t i) -> const Vec3& {
    return surface.mesh.vertices[static_cast<std::size_t>(loop[i % loop.size()])];
  };
  const auto angle = [&](std::size_t i) {
    const Vec3 normal = surface.jets[static_cast<std::size_t>(loop[i])].normal(place(i));
    return turn(place(i + loop.size() - 1), place(i), place(i + 1), normal);
  };
  std::vector<double> angles(loop.size());
  for (std::size_t i = 0; i < loop.size(); ++i) angles[i] = angle(i);
  while (loop.size() > 4) {
    const auto sharpest = std::min_element(angles.begin(), angles.end());
    if (*sharpest > -kNotchTurn) return;
    const auto i = static_cast<std::size_t>(sharpest - angles.begin());
    const std::size_t n = loop.size();
    surface.mesh.triangles.push_back({loop[(i + 1) % n], loop[i], loop[(i + n - 1) % n]});
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(i));
    angles.erase(angles.begin() + static_cast<std::ptrdiff_t>(i));
    for (const std::size_t k : {(i + n - 2) % (n - 1), i % (n - 1)}) angles[k] = angle(k);
  }
}

/// Normals and outward directions along a border. A loop that turns right all in all, seen along the normals, is that
/// of a hole.
Rim make_rim(JetSurface& surface, std::vector<TriangleSide> sides) {
  Rim rim;
  rim.sides = std::move(sides);
  rim.hole = total_turning(surface.mesh, surface.topology, rim.sides) < -std::numbers::pi;
  for (const TriangleSide& s : rim.sides)
    rim.vertices.push_back(surface.mesh.triangles[static_cast<std::size_t>(s.triangle)][(s.side + 1) % 3]);
  fill_notches(surface, rim);
  for (const int v : rim.vertices) {
    const Jet& jet = surface.jets[static_cast<std::size_t>(v)];
    const Vec3& x = surface.mesh.vertices[static_cast<std::size_t>(v)];
    rim.points.push_back(jet.project(x));
    rim.normals.push_back(jet.normal(x));
  }
  const std::size_t n = rim.points.size();
  std::vector<Vec3> along(n);
  for (std::size_t i = 0; i < n; ++i) {
    along[i] = rim.points[(i + 1) % n] - rim.points[wrap(static_cast<std::ptrdiff_t>(i) - 1, n)];
    rim.side_length += (rim.points[(i + 1) % n] - rim.points[i]).norm() / static_cast<double>(n);
  }
  along = smoothed(along, 1.0);
  for (std::size_t i = 0; i < n; ++i) rim.outward.push_back(along[i].cross(rim.normals[i]).normalized());
  return rim;
}

/// How far the mesh reaches back from each rim vertex, against the outward direction; smoothed along the rim.
std::vector<double> extents(const JetSurface& surface, const Rim& rim, const std::vector<int>& members) {
  const std::size_t step = std::max<std::size_t>(1, members.size() / 500);
  std::vector<Vec3> extent(rim.points.size(), Vec3::Zero());
  for (std::size_t i = 0; i < rim.points.size(); ++i)
    for (std::size_t k = 0; k < members.size(); k += step)
      extent[i][0] =
          std::max(extent[i][0],
                   rim.outward[i].dot(rim.points[i] - surface.mesh.vertices[static_cast<std::size_t>(members[k])]));
  extent = smoothed(extent, 0.02 * static_cast<double>(rim.points.size()));
  std::vector<double> result;
  for (const Vec3& e : extent) result.push_back(e[0]);
  return result;
}

/// Points of the jets at real vertices within `radius` of a vertex, walking over the mesh, and within `half_width` of
/// the plane through it normal to `across`; thinned out.
std::vector<Vec3> surroundings(const JetSurface& surface, RingCollector& rings, int vertex, double radius,
                               const Vec3& across, double half_width) {
  const Vec3& center = surface.mesh.vertices[static_cast<std::size_t>(vertex)];
  std::vector<int> found;
  for (const int v : rings.collect_within(vertex, radius))
    if (std::abs(across.dot(surface.mesh.vertices[static_cast<std::size_t>(v)] - center)) <= half_width)
      found.push_back(v);
  const std::size_t step = found.size() / kMostFitPoints + 1;
  std::vector<Vec3> points;
  for (std::size_t k = 0; k < found.size(); k += step) {
    const auto v = static_cast<std::size_t>(found[k]);
    points.push_back(surface.jets[v].project(surface.mesh.vertices[v]));
  }
  return points;
}

/// 0 to 1 with two vanishing derivatives at either end: blended jets keep their second order where the blend begins and
/// ends.
double smooth_step(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * t * (10.0 + t * (6.0 * t - 15.0));
}

/// What the extension looks like at a distance from border vertex i: near (its own jet) fading into far (the wide fit,
/// moved to the border).
struct Blend {
  const Jet* near;
  const Jet* far;
  Vec3 shift;
  double share;  // of far

  [[nodiscard]] Vec3 at(const Vec3& q) const {
    Vec3 x = Vec3::Zero();
    if (share < 1.0) x += (1.0 - share) * near->project(q);
    if (share > 0.0) x += share * (far->project(q - shift) + shift);
    return x;
  }
  [[nodiscard]] Vec3 normal(const Vec3& q) const { return share < 0.5 ? near->normal(q) : far->normal(q); }
};

/// The blend as one jet about q, from samples within `radius`; exact where the blend is a polynomial.
Jet resampled(const Blend& blend, const Vec3& q, double radius, JetWorkspace& workspace) {
  const Vec3 origin = blend.at(q), normal = blend.normal(q), a = normal.unitOrthogonal(), b = normal.cross(a);
  std::vector<Vec3> points{origin};
  for (int ring = 1; ring <= 3; ++ring) {
    for (int k = 0; k < 8; ++k) {
      const double angle = (k + 0.5 * (ring % 2)) * std::numbers::pi / 4.0, r = radius * ring / 3.0;
      points.push_back(blend.at(origin + r * (std::cos(angle) * a + std::sin(angle) * b)));
    }
  }
  return fit_jet(points, origin, normal, Jet::kDegree, 2.0, workspace).jet;
}

/// Appends one rim's rows to the surface.
class Extender {
 public:
  Extender(JetSurface& surface, const Rim& rim) : surface_(surface), rim_(rim), last_(rim.vertices) {}

  /// Adds a closed row of vertices outside the last one unless a triangle would fold over; `blends[i]` gives the
  /// surface there.
  bool add_row(const std::vector<Vec3>& places, const std::vector<Blend>& blends, double width) {
    const std::size_t n = places.size();
    std::vector<Vec3> row(n);
    for (std::size_t i = 0; i < n; ++i) row[i] = blends[i].at(places[i]);
    if (folds(row)) return false;
    std::vector<int> ids(n);
    for (std::size_t i = 0; i < n; ++i) {
      ids[i] = static_cast<int>(surface_.mesh.vertices.size());
      surface_.mesh.vertices.push_back(row[i]);
      const double side = (row[(i + 1) % n] - row[i]).norm();
      surface_.jets.push_back(resampled(blends[i], row[i], 1.5 * std::max(side, width), workspace_));
    }
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t k = (i + 1) % n;
      surface_.mesh.triangles.push_back({last_[k], last_[i], ids[i]});
      surface_.mesh.triangles.push_back({last_[k], ids[i], ids[k]});
    }
    last_ = ids;
    return true;
  }

  /// Closes a hole by triangles from the last row to one centre.
  void close(const Blend& blend, const Vec3& center, double width) {
    const int id = static_cast<int>(surface_.mesh.vertices.size());
    surface_.mesh.vertices.push_back(blend.at(center));
    surface_.jets.push_back(resampled(blend, center, 1.5 * width, workspace_));
    for (std::size_t i = 0; i < last_.size(); ++i)
      surface_.mesh.triangles.push_back({last_[(i + 1) % last_.size()], last_[i], id});
  }

  [[nodiscard]] bool folds(const std::vector<Vec3>& row) const {
    const std::size_t n = row.size();
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t k = (i + 1) % n;
      const Vec3 &a = vertex(last_[k]), &b = vertex(last_[i]), normal = rim_.normals[i] + rim_.normals[k];
      if (turned(a, b, row[i], normal) || turned(a, row[i], row[k], normal)) return true;
    }
    return false;
  }

 private:
  [[nodiscard]] const Vec3& vertex(int v) const { return surface_.mesh.vertices[static_cast<std::size_t>(v)]; }
  static bool turned(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) {
    const Vec3 area = (b - a).cross(c - a);
    return !(area.dot(normal) > kLeastTurn * area.norm() * normal.norm()) || !(area.norm() > 0.0);
  }

  JetSurface& surface_;
  const Rim& rim_;
  std::vector<int> last_;
  JetWorkspace workspace_;
};

/// Rows outwards from a border, ever wider, over the border's own jets that fade into wide fits of the surroundings:
/// the jets are exact at the border and run away with its ripples, the wide fits are off at the border (so they are
/// shifted to it) and steady.
void extend_rim(JetSurface& surface, const Rim& rim, const std::vector<Vec3>& normals,
                const std::vector<double>& extent, const ExtensionOptions& options) {
  const std::size_t n = rim.points.size();
  std::vector<Jet> far(n);
  constexpr std::size_t kGrain = 64;
  parallel_blocks(n, kGrain, [&](std::size_t begin, std::size_t end) {
    RingCollector rings(surface.mesh, surface.topology, normals);
    JetWorkspace workspace;
    for (std::size_t i = begin; i < end; ++i) {
      const double radius = std::max(options.fit_share * extent[i], 3.5 * rim.side_length);
      const Vec3 along = rim.outward[i].cross(rim.normals[i]);
      const double half_width = std::max(kFitWidth * radius, 3.5 * rim.side_length);
      const auto points = surroundings(surface, rings, rim.vertices[i], radius, along, half_width);
      far[i] = fit_jet(points, rim.points[i], rim.normals[i], kFarDegree, 1.0, workspace).jet;
    }
  });
  double length = 0.0;
  for (double e : extent) length = std::max(length, options.length_share * e);
  Extender extender(surface, rim);
  double reached = 0.0, width = rim.side_length;
  while (reached < length * (1.0 - 1e-9)) {
    const double next = length - reached < 1.4 * width ? length : reached + width;
    const double sigma = std::max(1.0, 0.5 * next / rim.side_length);
    const std::vector<Vec3> base = smoothed(rim.points, reached > 0.0 ? 0.5 * sigma : 0.0),
                            out = smoothed(rim.outward, sigma);
    std::vector<Vec3> places(n);
    std::vector<Blend> blends(n);
    const double share = smooth_step(next / (kFadeSides * rim.side_length));
    for (std::size_t i = 0; i < n; ++i) {
      const double t = next * std::max(extent[i] * options.length_share, 1e-3 * length) / length;
      places[i] = base[i] + t * (out[i] - out[i].dot(rim.normals[i]) * rim.normals[i]).normalized();
      const auto v = static_cast<std::size_t>(rim.vertices[i]);
      blends[i] = {&surface.jets[v], &far[i], rim.points[i] - far[i].project(rim.points[i]), share};
    }
    // The near jets live in a vector that grows with the row; take them over first.
    std::vector<Jet> near(n);
    for (std::size_t i = 0; i < n; ++i) {
      near[i] = *blends[i].near;
      blends[i].near = &near[i];
    }
    if (!extender.add_row(places, blends, next - reached)) return;
    width = kRowGrowth * (next - reached);
    reached = next;
  }
}

/// Rings towards the centre over one polynomial fitted to the hole's surroundings. False if the first ring would fold
/// over: the hole is too far from round.
bool fill_hole(JetSurface& surface, const Rim& rim, const std::vector<Vec3>& normals) {
  const std::size_t n = rim.points.size();
  Vec3 center = Vec3::Zero(), normal = Vec3::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    center += rim.points[i] / static_cast<double>(n);
    normal += rim.normals[i];
  }
  normal.normalize();
  double radius = 0.0;
  for (const Vec3& x : rim.points) radius += (x - center).norm() / static_cast<double>(n);
  RingCollector rings(surface.mesh, surface.topology, normals);
  const double reach = std::max(0.7 * radius, 4.0 * rim.side_length);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < n; i += n / 12 + 1)
    for (const Vec3& x : surroundings(surface, rings, rim.vertices[i], reach, normal, reach)) points.push_back(x);
  JetWorkspace workspace;
  const Jet far = fit_jet(points, center, normal, Jet::kDegree, 0.0, workspace).jet;
  const int count = std::clamp(static_cast<int>(std::lround(0.7 * radius / rim.side_length)), 2, 12);
  Extender extender(surface, rim);
  std::vector<Jet> near(n);
  for (std::size_t i = 0; i < n; ++i) near[i] = surface.jets[static_cast<std::size_t>(rim.vertices[i])];
  for (int ring = 1; ring < count; ++ring) {
    const double inner = static_cast<double>(ring) / count;
    // A jagged border is evened out on the way in.
    const std::vector<Vec3> base = smoothed(rim.points, 1.0 + 0.5 * ring);
    std::vector<Vec3> places(n);
    std::vector<Blend> blends(n);
    for (std::size_t i = 0; i < n; ++i) {
      places[i] = base[i] + inner * (center - base[i]);
      const Vec3 shift = rim.points[i] - far.project(rim.points[i]);
      blends[i] = {&near[i], &far, (1.0 - inner) * shift, smooth_step(inner * radius / (kFadeSides * rim.side_length))};
    }
    if (!extender.add_row(places, blends, radius / count)) return ring > 1;
  }
  const Blend blend{&far, &far, Vec3::Zero(), 1.0};
  extender.close(blend, center, radius / count);
  return true;
}

/// Links the sides of the appended triangles with each other and with the open sides of the real ones.
void link_appended(JetSurface& surface, std::size_t first, const std::vector<Rim>& rims) {
  struct Use {
    int from, to;
    TriangleSide side;
  };
  std::vector<Use> uses;
  const auto add = [&](int t, int k) {
    const auto& corners = surface.mesh.triangles[static_cast<std::size_t>(t)];
    uses.push_back({corners[(k + 1) % 3], corners[(k + 2) % 3], {t, k}});
  };
  for (const Rim& rim : rims)
    for (const TriangleSide& s : rim.sides) add(s.triangle, s.side);
  for (std::size_t t = first; t < surface.mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) add(static_cast<int>(t), k);
  const auto key = [](const Use& u) { return std::pair(std::min(u.from, u.to), std::max(u.from, u.to)); };
  std::stable_sort(uses.begin(), uses.end(), [&](const Use& a, const Use& b) { return key(a) < key(b); });
  surface.topology.neighbors.resize(surface.mesh.triangles.size(), {-1, -1, -1});
  for (std::size_t i = 0; i + 1 < uses.size(); ++i) {
    const Use &a = uses[i], &b = uses[i + 1];
    if (key(a) != key(b) || a.from != b.to) continue;
    surface.topology.neighbors[static_cast<std::size_t>(a.side.triangle)][a.side.side] = b.side.triangle;
    surface.topology.neighbors[static_cast<std::size_t>(b.side.triangle)][b.side.side] = a.side.triangle;
    ++i;
  }
}

}  // namespace

void extend(JetSurface& surface, const std::vector<Vec3>& normals, const ExtensionOptions& options) {
  const std::size_t first = surface.mesh.triangles.size();
  const std::vector<int> component = components(surface.topology);
  std::vector<std::vector<int>> members;
  for (std::size_t t = 0; t < first; ++t) {
    const auto c = static_cast<std::size_t>(component[t]);
    if (members.size() <= c) members.resize(c + 1);
    members[c].push_back(surface.mesh.triangles[t][0]);
  }
  std::vector<Rim> rims;
  for (auto& loop : border_loops(surface.mesh, surface.topology))
    if (loop.size() >= 3) rims.push_back(make_rim(surface, std::move(loop)));
  for (const Rim& rim : rims) {
    if (rim.hole && fill_hole(surface, rim, normals)) continue;
    const auto c = static_cast<std::size_t>(component[static_cast<std::size_t>(rim.sides[0].triangle)]);
    extend_rim(surface, rim, normals, extents(surface, rim, members[c]), options);
  }
  link_appended(surface, first, rims);
}

}  // namespace flank::internal
