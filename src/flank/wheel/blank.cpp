#include "flank/wheel/blank.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "flank/error.h"
#include "flank/geom/tessellate.h"
#include "flank/io/cad/triangulate.h"

namespace flank::internal {
namespace {

constexpr double kDeviationMm = 0.02;  ///< of the triangles from their faces
constexpr double kStepsAlong = 200.0;  ///< of an outline
constexpr double kChordMm = 0.05;      ///< of a turned body's polygon outside of its circle, at most
constexpr int kFewestCorners = 48;

TriangleMesh triangles_of(const Part& part, const std::vector<std::string>& without) {
  TriangleMesh all;
  for (const FaceTriangles& face : triangulate(part, kDeviationMm))
    if (std::find(without.begin(), without.end(), face.face) == without.end()) append(all, face.mesh);
  return all;
}

/// The largest radii over stretches of the axis.
struct Outline {
  double low = 1e300, high = -1e300, step = 1.0;
  std::vector<double> radii;

  Outline(const TriangleMesh& mesh, const WheelAxis& axis) {
    for (const Vec3& p : mesh.vertices) low = std::min(low, axis.along(p)), high = std::max(high, axis.along(p));
    step = std::max(1e-6, (high - low) / kStepsAlong);
    radii.assign(static_cast<std::size_t>(kStepsAlong), 0.0);
    for (const auto& t : mesh.triangles)
      for (std::size_t k = 0; k < 3; ++k) add(axis, vertex(mesh, t[k]), vertex(mesh, t[(k + 1) % 3]));
  }
  [[nodiscard]] static const Vec3& vertex(const TriangleMesh& mesh, int k) {
    return mesh.vertices[static_cast<std::size_t>(k)];
  }
  [[nodiscard]] std::size_t stretch(double along) const {
    return static_cast<std::size_t>(std::clamp((along - low) / step, 0.0, static_cast<double>(radii.size()) - 1.0));
  }
  /// A side of a triangle: along it, and over the triangle, the radius is largest at the ends of a stretch.
  void add(const WheelAxis& axis, Vec3 a, Vec3 b) {
    if (axis.along(b) < axis.along(a)) std::swap(a, b);
    const double from = axis.along(a), length = axis.along(b) - from;
    const std::size_t first = stretch(from), last = stretch(axis.along(b));
    raise(first, axis.radius(a)), raise(last, axis.radius(b));
    for (std::size_t k = first; k < last; ++k) {
      const double at = low + static_cast<double>(k + 1) * step;
      const Vec3 p = a + std::clamp((at - from) / length, 0.0, 1.0) * (b - a);
      raise(k, axis.radius(p)), raise(k + 1, axis.radius(p));
    }
  }
  void raise(std::size_t k, double radius) { radii[k] = std::max(radii[k], radius); }
  /// Through the ends of the stretches, outside of both that meet there, and `more` all round.
  [[nodiscard]] std::vector<Vec2> line(double more) const {
    std::vector<Vec2> out;
    for (std::size_t k = 0; k <= radii.size(); ++k) {
      const double radius = std::max(radii[k > 0 ? k - 1 : 0], radii[std::min(k, radii.size() - 1)]);
      out.emplace_back(low + static_cast<double>(k) * step, radius + more);
    }
    out.front().x() -= more, out.back().x() += more;
    return out;
  }
};

/// Turned about the axis, with a polygon that goes round its circles; both ends are flat.
TriangleMesh turned_body(const std::vector<Vec2>& outline, const WheelAxis& axis) {
  double largest = 0.0;
  for (const Vec2& p : outline) largest = std::max(largest, p.y());
  const double half = std::acos(std::clamp(largest / (largest + kChordMm), 0.0, 1.0));
  const int corners = std::max(kFewestCorners, static_cast<int>(std::ceil(std::numbers::pi / half)));
  const double out = 1.0 / std::cos(std::numbers::pi / corners);
  const Vec3 x = axis.direction.unitOrthogonal(), y = axis.direction.cross(x);
  TriangleMesh mesh;
  const auto add = [&](double along, double radius, double angle) {
    mesh.vertices.emplace_back(axis.point + along * axis.direction +
                               radius * (std::cos(angle) * x + std::sin(angle) * y));
  };
  for (const Vec2& p : outline)
    for (int k = 0; k < corners; ++k) add(p.x(), out * p.y(), 2.0 * std::numbers::pi * k / corners);
  add(outline.front().x(), 0.0, 0.0), add(outline.back().x(), 0.0, 0.0);
  const int rings = static_cast<int>(outline.size()), before = rings * corners, behind = before + 1;
  for (int k = 0; k < corners; ++k) {
    const int next = (k + 1) % corners, last = (rings - 1) * corners;
    for (int ring = 0; ring + 1 < rings; ++ring) {
      const int a = ring * corners + k, b = ring * corners + next, c = a + corners, d = b + corners;
      mesh.triangles.push_back({a, b, d}), mesh.triangles.push_back({a, d, c});
    }
    mesh.triangles.push_back({before, next, k}), mesh.triangles.push_back({behind, last + k, last + next});
  }
  return mesh;
}

}  // namespace

WheelBlank turned_blank(const Part& part, const WheelRoles& roles, double allowance_mm) {
  WheelBlank out;
  out.outline = Outline(triangles_of(part, roles.debris), roles.axis).line(allowance_mm + kDeviationMm);
  out.body = turned_body(out.outline, roles.axis);
  return out;
}

WheelBlank read_blank(const std::string& file, const std::optional<std::string>& unit, const WheelAxis& axis) {
  WheelBlank out;
  out.body = triangles_of(read_part(file, unit), {});
  if (out.body.triangles.empty()) throw InputError(file + ": has no faces; expected a closed body as blank");
  out.outline = Outline(out.body, axis).line(0.0);
  return out;
}

}  // namespace flank::internal
