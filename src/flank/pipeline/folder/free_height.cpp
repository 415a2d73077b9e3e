#include "flank/pipeline/folder/free_height.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "flank/geom/tessellate.h"
#include "flank/geom/triangle_bvh.h"
#include "flank/io/cad/triangulate.h"

namespace flank::internal {
namespace {

constexpr double kChordShare = 0.4;  ///< of the tolerance: how true the triangles are
constexpr double kUpright = 0.99;    ///< cosine between the way to the hub and its normal: less is beyond its border

/// The faces of the steps of a kind.
TriangleMesh faces_of(const WheelPlan& plan, const std::vector<FaceTriangles>& faces, const std::string& kind) {
  TriangleMesh out;
  for (const FaceTriangles& face : faces) {
    const auto has = [&](const WheelStep& step) {
      return step.kind == kind && std::count(step.faces.begin(), step.faces.end(), face.face) > 0;
    };
    if (std::any_of(plan.steps.begin(), plan.steps.end(), has)) append(out, face.mesh);
  }
  return out;
}

/// Whether a place is over the hub and not beyond its border, and how high.
std::optional<double> height_over(const TriangleMesh& hub, const TriangleBvh& tree, const Vec3& p) {
  const BvhHit hit = tree.closest(p);
  const auto& t = hub.triangles[static_cast<std::size_t>(hit.triangle)];
  const auto corner = [&](int k) { return hub.vertices[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])]; };
  const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)), way = p - hit.point;
  if (std::abs(way.dot(normal)) < kUpright * way.norm() * normal.norm()) return {};
  return way.norm();
}

}  // namespace

double free_height(const WheelPlan& plan, const Setup& setup, const std::vector<Path>& operations, double tip_radius) {
  const std::vector<FaceTriangles> faces = triangulate(setup.part, kChordShare * setup.tolerance_mm);
  const TriangleMesh hub = faces_of(plan, faces, "rough"), sides = faces_of(plan, faces, "side");
  if (hub.triangles.empty() || sides.triangles.empty()) return 0.0;
  const TriangleBvh tree(hub);
  double left = 0.0, most = 0.0;
  for (const Vec3& p : sides.vertices) left = std::max(left, height_over(hub, tree, p).value_or(0.0));
  for (const Path& operation : operations) {
    double lowest = left;
    for (const Strip& strip : operation.strips)
      for (const Pose& pose : strip.poses)
        lowest = std::min(lowest, std::max(0.0, std::sqrt(tree.closest(pose.tip).squared_distance) - tip_radius));
    most = std::max(most, left - lowest);
    left = lowest;
  }
  return most;
}

}  // namespace flank::internal
