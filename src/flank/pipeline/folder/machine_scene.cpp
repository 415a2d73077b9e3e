#include "flank/pipeline/folder/machine_scene.h"

#include <algorithm>

#include "flank/io/cad/triangulate.h"

namespace flank::internal {
namespace {

/// Of the triangles for part and fixtures, mm: spindles pass them at a distance.
constexpr double kWorkDeviationMm = 0.1;
/// Cylinders that hold the flank, and looks at its meridian for each.
constexpr int kFlankPieces = 24, kLooks = 8;

/// The tool along a line that begins at s = 0, where all joints are zero.
class ToolShapes {
 public:
  ToolShapes(const Vec3& tip, const Vec3& axis) : tip_(tip), axis_(axis) {}

  void add_flank(const RadialFunction& radial) {
    const std::vector<Vec2> points = meridian(radial, kFlankPieces * kLooks + 1);
    for (std::size_t k = 0; k + 1 < points.size(); k += kLooks) {
      double radius = 0.0;
      for (std::size_t i = k; i <= k + kLooks; ++i) radius = std::max(radius, points[i].y());
      add(points[k].x(), radius, points[k + kLooks].x(), radius);
    }
    // The balls that round the ends.
    const double length = radial.axis_length(), low = radial.at(0.0).r, high = radial.at(length).r;
    add(-low, low, points.front().x(), low);
    add(points.back().x(), high, length + high, high);
  }
  void add_profile(const std::vector<Vec2>& profile) {
    for (std::size_t k = 0; k + 1 < profile.size(); ++k)
      add(profile[k].x(), profile[k].y(), profile[k + 1].x(), profile[k + 1].y());
  }
  [[nodiscard]] std::vector<ConvexShape> take() { return std::move(shapes_); }

 private:
  void add(double low, double low_radius, double high, double high_radius) {
    if (high - low > 1e-9)
      shapes_.push_back(ConvexShape::frustum(tip_ + low * axis_, low_radius, tip_ + high * axis_, high_radius));
  }
  Vec3 tip_, axis_;
  std::vector<ConvexShape> shapes_;
};

void add_triangles(const TriangleMesh& mesh, const WorkSetup& place, std::vector<ConvexShape>& shapes) {
  const Eigen::Matrix3d turn = place.rotation();
  const auto at = [&](int k) -> Vec3 { return turn * mesh.vertices[static_cast<std::size_t>(k)] + place.translation; };
  for (const auto& t : mesh.triangles) shapes.push_back(ConvexShape::triangle(at(t[0]), at(t[1]), at(t[2])));
}

bool holds(const std::vector<int>& faces, std::size_t face) {
  return std::find(faces.begin(), faces.end(), static_cast<int>(face)) != faces.end();
}

}  // namespace

MachineScene machine_scene(const Machine& machine, const Tool& tool, double tip_offset) {
  MachineScene scene;
  scene.solids = machine_solids(machine);
  if (scene.solids.empty()) return scene;
  ToolShapes shapes(machine.gauge + (tip_offset - machine.tool_length) * machine.tool_axis, machine.tool_axis);
  shapes.add_flank(tool.radial);
  shapes.add_profile(tool.shank);
  shapes.add_profile(tool.holder);
  scene.solids.emplace_back("the tool", SolidKind::kTool, kJointCount, shapes.take());
  return scene;
}

void add_work(const Setup& setup, const ObstacleRequest& request, const WorkSetup& place, MachineScene& scene) {
  scene.required_mm = request.clearance_mm.value_or(0.0);
  if (scene.solids.empty()) return;
  std::vector<ConvexShape> part, fixtures;
  const std::vector<FaceTriangles> faces = triangulate(setup.part, kWorkDeviationMm);
  // What is left unchecked by name is left unchecked here, too.
  for (std::size_t k = 0; k < faces.size(); ++k)
    if (holds(setup.targets, k) || holds(setup.checks, k)) add_triangles(faces[k].mesh, place, part);
  for (const Part& fixture : setup.fixtures)
    for (const FaceTriangles& face : triangulate(fixture, kWorkDeviationMm)) add_triangles(face.mesh, place, fixtures);
  scene.solids.emplace_back("the part", SolidKind::kWork, 0, std::move(part));
  scene.solids.emplace_back("a fixture", SolidKind::kWork, 0, std::move(fixtures));
}

}  // namespace flank::internal
