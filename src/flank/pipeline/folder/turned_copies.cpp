#include "flank/pipeline/folder/turned_copies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/error.h"
#include "flank/geom/triangle_bvh.h"
#include "flank/io/cad/triangulate.h"
#include "flank/machine/nc/nc_number.h"

namespace flank::internal {
namespace {

/// How true the triangles are: of the tolerance, and of the part's diagonal at least.
constexpr double kDeviationShare = 0.1, kLeastDeviation = 1e-5;

constexpr double kShortestDirection = 1e-6;

/// The faces that are machined or checked, as one mesh.
TriangleMesh judged_faces(const Setup& setup, double deviation) {
  const std::vector<FaceTriangles> faces = triangulate(setup.part, deviation);
  TriangleMesh all;
  const auto add = [&](int k) {
    const TriangleMesh& mesh = faces[static_cast<std::size_t>(k)].mesh;
    const int first = static_cast<int>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const auto& t : mesh.triangles) all.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  };
  for (const int k : setup.targets) add(k);
  for (const int k : setup.checks) add(k);
  return all;
}

/// The numbers between commas; empty where anything else is there.
std::vector<double> numbers_of(std::string_view text) {
  std::vector<double> values;
  for (;;) {
    const auto number = leading_number(text);
    if (!number) return {};
    values.push_back(number->value);
    text.remove_prefix(number->length);
    if (text.empty()) return values;
    if (text.front() != ',') return {};
    text.remove_prefix(1);
  }
}

}  // namespace

CopyAxis parse_copy_axis(const std::string& text) {
  const std::vector<double> v = numbers_of(text);
  const Vec3 direction = v.size() == 6 ? Vec3(v[3], v[4], v[5]) : Vec3(Vec3::Zero());
  if (!(direction.norm() > kShortestDirection))
    throw UsageError("copy_axis", text, "expected x,y,z,x,y,z: a point of the axis, mm, and its direction");
  return {Vec3(v[0], v[1], v[2]), direction.normalized()};
}

std::string copy_axis_text(const CopyAxis& axis) {
  // Programs know no exponents, and 1e-12 mm is nothing.
  const auto plain = [](double value) {
    std::string text = fmt::format("{:.12f}", value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text == "-0" ? std::string("0") : text;
  };
  const Vec3 &p = axis.point, &d = axis.direction;
  return fmt::format("{},{},{},{},{},{}", plain(p.x()), plain(p.y()), plain(p.z()), plain(d.x()), plain(d.y()),
                     plain(d.z()));
}

Eigen::Isometry3d copy_turn(const CopyAxis& axis, int copy, int copies) {
  const double angle = 2.0 * std::numbers::pi * static_cast<double>(copy - 1) / static_cast<double>(copies);
  return Eigen::Translation3d(axis.point) * Eigen::AngleAxisd(angle, axis.direction) *
         Eigen::Translation3d(-axis.point);
}

Path turned(Path path, const Eigen::Isometry3d& turn) {
  for (Strip& strip : path.strips)
    for (Pose& p : strip.poses) p = {turn * p.tip, (turn.linear() * p.axis).normalized()};
  return path;
}

void require_same_when_turned(const Setup& setup, const CopyAxis& axis, int copies) {
  if (!setup.fixtures.empty())
    throw InputError("copies", std::to_string(copies),
                     "fixtures do not turn with the part; expected none, or one copy");
  const double deviation = std::max(kDeviationShare * setup.tolerance_mm, kLeastDeviation * setup.part.box.diagonal());
  const TriangleMesh mesh = judged_faces(setup, deviation);
  const TriangleBvh tree(mesh);
  const Eigen::Isometry3d turn = copy_turn(axis, 2, copies);
  double farthest = 0.0;
  Vec3 where = Vec3::Zero();
  for (const Vec3& p : mesh.vertices) {
    const double squared = tree.closest(turn * p).squared_distance;
    if (squared > farthest) farthest = squared, where = p;
  }
  // Corners of triangles are on their faces: the triangles that they come to lie on may be off by their own deviation.
  if (const double off = std::sqrt(farthest); off > deviation + kDeviationShare * setup.tolerance_mm)
    throw InputError("copies", std::to_string(copies),
                     fmt::format("turned by {:g} degrees about {} the part is not the same: ({:.3f}, {:.3f}, {:.3f}) "
                                 "comes to lie {:.4f} mm off its faces; expected another number, another copy_axis, or "
                                 "faces to ignore",
                                 360.0 / copies, copy_axis_text(axis), where.x(), where.y(), where.z(), off));
}

}  // namespace flank::internal
