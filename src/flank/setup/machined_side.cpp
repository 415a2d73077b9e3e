#include "flank/setup/machined_side.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "flank/base/parallel.h"
#include "flank/error.h"
#include "flank/geom/tessellate.h"
#include "flank/geom/triangle_bvh.h"
#include "flank/obstacle/enclosure.h"
#include "flank/obstacle/line_of_sight.h"
#include "flank/setup/closed_mesh.h"
#include "flank/setup/joints.h"

namespace flank::internal {
namespace {

/// A space is enclosed where this share of what is seen from its walls is walls: its openings are less than a fifth of them. Of blades
/// without root and tip 0.9 are and more, of channels and pockets half to three quarters.
constexpr double kEncloses = 0.8;
/// Of the part's size: triangles this near tell what is before what.
constexpr double kChordShare = 1e-3;

/// Faces with one side, and all faces of the part, as triangles.
struct Sheet {
  std::vector<int> faces;
  TriangleMesh mesh;
};

struct Choice {
  int side = +1;
  const char* reason = "where the normal of the file points";
};

TriangleMesh triangles_of(const Part& part, const std::vector<int>& faces) {
  if (part.is_mesh()) return extract_mesh(part, faces);
  const double chord = kChordShare * std::max(part.box.diagonal(), kSmallestBoxMm);
  std::vector<TriangleMesh> meshes(faces.size());
  parallel_for(faces.size(), [&](std::size_t k) {
    if (!part.is_left_out(faces[k]))
      meshes[k] = tessellate(part.faces[static_cast<std::size_t>(faces[k])], {.chord_mm = chord}).mesh;
  });
  TriangleMesh all;
  for (const TriangleMesh& mesh : meshes) append(all, mesh);
  return all;
}

/// The targets that bound no material, those that are joined as one.
std::vector<Sheet> sheets_of(const Part& part, const std::vector<int>& targets) {
  std::vector<Sheet> sheets;
  if (part.is_mesh() && bound_a_solid(part, targets)) return sheets;
  for (std::vector<int>& group : connected_groups(part, targets)) {
    if (!part.is_mesh())
      std::erase_if(group, [&](int face) { return part.faces[static_cast<std::size_t>(face)].of_solid; });
    TriangleMesh mesh = triangles_of(part, group);
    if (!mesh.triangles.empty()) sheets.push_back({std::move(group), std::move(mesh)});
  }
  return sheets;
}

Vec3 normal_of(const TriangleMesh& mesh, std::size_t triangle) {
  const auto t = corners_of(mesh, triangle);
  return 0.5 * (t[1] - t[0]).cross(t[2] - t[0]);
}

Vec3 middle_of(const TriangleMesh& mesh, std::size_t triangle) {
  const auto t = corners_of(mesh, triangle);
  return (t[0] + t[1] + t[2]) / 3.0;
}

/// +1: most of a wall's normals point to the other wall.
int side_facing(const TriangleMesh& wall, const TriangleMesh& other) {
  const TriangleBvh nearest(other);
  double front = 0.0;
  for (std::size_t k = 0; k < wall.triangles.size(); ++k) {
    const Vec3 middle = middle_of(wall, k), normal = normal_of(wall, k);
    front += std::copysign(normal.norm(), normal.dot(nearest.closest(middle).point - middle));
  }
  return front < 0.0 ? -1 : +1;
}

Choice choose(const PartRequest& request, const Part& part, const Sheet& sheet, const std::vector<int>& others) {
  if (request.side) return {*request.side, "as requested"};
  if (request.facing && !others.empty())
    return {side_facing(sheet.mesh, triangles_of(part, others)), "towards the other wall"};
  std::vector<int> all, open;
  for (int face = 0; face < part.face_count(); ++face) {
    all.push_back(face);
    if (part.is_mesh() || !part.faces[static_cast<std::size_t>(face)].of_solid) open.push_back(face);
  }
  const TriangleMesh around = triangles_of(part, all);
  // Beside an opening a face of what is enclosed sees much of it; its neighbours, which were read to agree with it, see less.
  for (const TriangleMesh& walls : {sheet.mesh, triangles_of(part, open)}) {
    const Enclosure seen = enclosure(walls, around);
    const bool behind = seen.behind >= kEncloses, before = seen.before >= kEncloses;
    if (behind != before) return {behind ? +1 : -1, "away from the space that the faces enclose"};
  }
  return {};
}

/// A triangle in the middle of the sheet: nearest to the centre of its area.
std::size_t middle_triangle(const TriangleMesh& mesh) {
  Vec3 centre = Vec3::Zero();
  double area = 0.0;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const double own = normal_of(mesh, k).norm();
    centre += own * middle_of(mesh, k);
    area += own;
  }
  centre /= area;
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const double distance = (middle_of(mesh, k) - centre).squaredNorm();
    if (distance < least && normal_of(mesh, k).norm() > 0.0) least = distance, best = k;
  }
  return best;
}

void turn(const std::vector<int>& faces, Part& part) {
  for (const int face : faces) {
    if (!part.is_mesh()) {
      bool& reversed = part.faces[static_cast<std::size_t>(face)].reversed;
      reversed = !reversed;
      continue;
    }
    for (const int t : part.mesh_faces[static_cast<std::size_t>(face)]) {
      auto& corners = part.mesh.triangles[static_cast<std::size_t>(t)];
      std::swap(corners[1], corners[2]);
    }
  }
}

/// The targets that are not of this sheet.
std::vector<int> without(std::vector<int> targets, const Sheet& sheet) {
  std::erase_if(targets, [&](int face) { return std::count(sheet.faces.begin(), sheet.faces.end(), face) > 0; });
  return targets;
}

SheetSide described(const Part& part, const Sheet& sheet, const Choice& choice, bool asked) {
  SheetSide out;
  for (const int face : sheet.faces) out.faces += (out.faces.empty() ? "" : ",") + part.face_id(face);
  const std::size_t middle = middle_triangle(sheet.mesh);
  out.side = choice.side;
  out.asked = asked;
  out.towards = choice.side * normal_of(sheet.mesh, middle).normalized();
  out.place = middle_of(sheet.mesh, middle);
  out.reason = choice.reason;
  return out;
}

}  // namespace

std::vector<SheetSide> turn_to_machined_side(const PartRequest& request, const std::vector<int>& targets, Part& part) {
  const std::vector<Sheet> sheets = sheets_of(part, targets);
  if (sheets.empty() && request.side && *request.side < 0)
    throw UsageError("side", "-",
                     fmt::format("{} is part of a solid, whose material determines the side; `side` is for open sheets",
                                 request.target_text()));
  std::vector<SheetSide> sides;
  // All are chosen before any is turned: the one must not see the other turned.
  for (const Sheet& sheet : sheets)
    sides.push_back(described(part, sheet, choose(request, part, sheet, without(targets, sheet)),
                              request.side.has_value() || request.facing));
  for (std::size_t k = 0; k < sheets.size(); ++k)
    if (sides[k].side < 0) turn(sheets[k].faces, part);
  return sides;
}

std::string side_text(const SheetSide& side) {
  constexpr const char* kAxes = "XYZ";
  int axis = 0;
  side.towards.cwiseAbs().maxCoeff(&axis);
  const auto rounded = [&](int k) { return std::round(100.0 * side.towards[k]) / 100.0 + 0.0; };  // no -0.00
  return fmt::format("side {}, towards ({:.2f}, {:.2f}, {:.2f}), mostly {}{}: {}", side.side > 0 ? "+" : "-",
                     rounded(0), rounded(1), rounded(2), side.towards[axis] < 0.0 ? "-" : "+", kAxes[axis],
                     side.reason);
}

}  // namespace flank::internal
