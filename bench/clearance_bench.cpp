// Is this pose free, and by how much? The planner's PoseChecker against FCL (a bounding-volume hierarchy of the same
// triangles against two cylinders, shank and holder) on the same poses: equal answers, one thread. And the judge's
// clearance of a path of 1,000 poses along a part of 100,000 triangles. Where the real impeller is at hand the scene is
// that, else a bumpy plate.
#include <fcl/fcl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <vector>

#include "flank/base/random.h"
#include "flank/clearance.h"
#include "flank/io/cad/triangulate.h"
#include "flank/obstacle/pose_clearance.h"
#include "flank/threads.h"

namespace {

using namespace flank;
using namespace flank::internal;

constexpr double kShankRadius = 5.0, kShankLength = 30.0, kHolderRadius = 10.0, kHolderLength = 40.0, kLength = 60.0;

Tool tool_of() {
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kCylinder, kLength, Eigen::VectorXd::Constant(1, kShankRadius));
  const double top = kLength + kShankLength;
  tool.shank = {{kLength, kShankRadius}, {top, kShankRadius}};
  tool.holder = {{top, kHolderRadius}, {top + kHolderLength, kHolderRadius}};
  return tool;
}

double seconds_of(const auto& run) {
  const auto start = std::chrono::steady_clock::now();
  run();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TriangleMesh bumpy_plate(int cells, double size) {
  TriangleMesh mesh;
  for (int i = 0; i <= cells; ++i) {
    for (int j = 0; j <= cells; ++j) {
      const double x = size * (2.0 * i / cells - 1.0), y = size * (2.0 * j / cells - 1.0);
      mesh.vertices.emplace_back(x, y, 3.0 * std::sin(0.2 * x) * std::cos(0.17 * y));
    }
  }
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      const int a = i * (cells + 1) + j, b = a + cells + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  }
  return mesh;
}

TriangleMesh impeller() {
  const char* folder = std::getenv("FLANK_DATA");
  const auto file =
      (folder != nullptr ? std::filesystem::path(folder) : std::filesystem::path(FLANK_SOURCE_DIR) / "../shared/data") /
      "kj66_impeller.step";
  TriangleMesh all;
  if (!std::filesystem::exists(file)) return all;
  for (const FaceTriangles& face : triangulate(read_part(file.string()), 0.01)) {
    const int first = static_cast<int>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), face.mesh.vertices.begin(), face.mesh.vertices.end());
    for (const auto& t : face.mesh.triangles) all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return all;
}

/// Poses around a mesh, about half of them free: a surface point, a distance from it, any direction.
std::vector<Pose> poses_near(const TriangleMesh& mesh, int count) {
  Random random(9);
  std::vector<Pose> poses;
  for (int k = 0; k < count; ++k) {
    const auto& t = mesh.triangles[random.next() % mesh.triangles.size()];
    const Vec3 x = mesh.vertices[static_cast<std::size_t>(t[0])];
    const Vec3 axis = Vec3(random.normal(), random.normal(), random.normal()).normalized();
    poses.push_back(
        {x - random.uniform(20.0, 70.0) * axis + 6.0 * Vec3(random.normal(), random.normal(), random.normal()), axis});
  }
  return poses;
}

class Rival {
 public:
  explicit Rival(const TriangleMesh& mesh)
      : shank_(std::make_shared<fcl::Cylinderd>(kShankRadius, kShankLength)),
        holder_(std::make_shared<fcl::Cylinderd>(kHolderRadius, kHolderLength)) {
    auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
    model->beginModel();
    std::vector<fcl::Vector3d> vertices(mesh.vertices.begin(), mesh.vertices.end());
    std::vector<fcl::Triangle> triangles;
    for (const auto& t : mesh.triangles)
      triangles.emplace_back(static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]),
                             static_cast<std::size_t>(t[2]));
    model->addSubModel(vertices, triangles);
    model->endModel();
    part_ = std::make_unique<fcl::CollisionObjectd>(model);
  }

  [[nodiscard]] bool is_free(const Pose& pose) const {
    for (const auto& [shape, height] : bodies()) {
      const fcl::CollisionObjectd body(shape, transform(pose, height));
      fcl::CollisionRequestd request;
      fcl::CollisionResultd result;
      fcl::collide(part_.get(), &body, request, result);
      if (result.isCollision()) return false;
    }
    return true;
  }

  [[nodiscard]] double distance(const Pose& pose) const {
    double least = 1e300;
    for (const auto& [shape, height] : bodies()) {
      const fcl::CollisionObjectd body(shape, transform(pose, height));
      const fcl::DistanceRequestd request;
      fcl::DistanceResultd result;
      least = std::min(least, fcl::distance(part_.get(), &body, request, result));
    }
    return least;
  }

 private:
  using Body = std::pair<std::shared_ptr<fcl::Cylinderd>, double>;
  [[nodiscard]] std::vector<Body> bodies() const {
    return {{shank_, kLength + 0.5 * kShankLength}, {holder_, kLength + kShankLength + 0.5 * kHolderLength}};
  }
  static fcl::Transform3d transform(const Pose& pose, double height) {
    fcl::Transform3d t = fcl::Transform3d::Identity();
    const Vec3 e1 = pose.axis.unitOrthogonal();
    t.linear().col(0) = e1;
    t.linear().col(1) = pose.axis.cross(e1);
    t.linear().col(2) = pose.axis;
    t.translation() = pose.at(height);
    return t;
  }

  std::shared_ptr<fcl::Cylinderd> shank_, holder_;
  std::unique_ptr<fcl::CollisionObjectd> part_;
};

void race(const char* name, const TriangleMesh& mesh) {
  const std::vector<Pose> poses = poses_near(mesh, 2000);
  ObstacleMesh surface;
  surface.mesh = mesh;
  surface.flank_may_touch = true;
  std::unique_ptr<PoseChecker> checker;
  std::unique_ptr<Rival> rival;
  const double build = seconds_of([&] { checker = std::make_unique<PoseChecker>(tool_of(), std::span(&surface, 1)); });
  const double rival_build = seconds_of([&] { rival = std::make_unique<Rival>(mesh); });
  std::vector<char> free(poses.size()), rival_free(poses.size());
  std::vector<PoseClearance> measured(poses.size());
  std::vector<double> distances(poses.size(), -1.0);
  const double one = seconds_of([&] {
    for (std::size_t k = 0; k < poses.size(); ++k) free[k] = static_cast<char>(checker->is_free(poses[k]));
  });
  const double rival_one = seconds_of([&] {
    for (std::size_t k = 0; k < poses.size(); ++k) rival_free[k] = static_cast<char>(rival->is_free(poses[k]));
  });
  const double all = seconds_of([&] {
    for (std::size_t k = 0; k < poses.size(); ++k) measured[k] = checker->measure(poses[k]);
  });
  // FCL gives no depths: its distances are asked of free poses alone, and so are ours for this comparison.
  double rival_all = 0.0, ours_all = 0.0, difference = 0.0;
  int unequal = 0, free_count = 0;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    unequal += free[k] != rival_free[k] && std::abs(measured[k].clearance_mm) > 1e-6;
    if (free[k] == 0 || rival_free[k] == 0) continue;
    ++free_count;
    rival_all += seconds_of([&] { distances[k] = rival->distance(poses[k]); });
    ours_all += seconds_of([&] { measured[k] = checker->measure(poses[k]); });
    difference = std::max(difference, std::abs(distances[k] - measured[k].clearance_mm));
  }
  const double n = static_cast<double>(poses.size());
  std::printf("%s: %zu triangles, %zu poses, %d of them free, one thread\n", name, mesh.triangles.size(), poses.size(),
              free_count);
  std::printf("  build                ours %9.2f ms    FCL %9.2f ms\n", 1e3 * build, 1e3 * rival_build);
  std::printf("  is it free           ours %9.2f us    FCL %9.2f us    ratio %6.1f, %d unequal answers\n",
              1e6 * one / n, 1e6 * rival_one / n, rival_one / one, unequal);
  std::printf("  distance, free poses ours %9.2f us    FCL %9.2f us    ratio %6.1f, largest difference %.1e mm\n",
              1e6 * ours_all / free_count, 1e6 * rival_all / free_count, rival_all / ours_all, difference);
  std::printf("  clearance or depth with gradients, all poses: ours %9.2f us\n", 1e6 * all / n);
}

/// The path of a tool that leans and swings over the part, its holder near it.
void judge_path(const char* name, const TriangleMesh& mesh, const Path& path) {
  for (const ObstacleRole role : {ObstacleRole::kPart, ObstacleRole::kFixture}) {
    ClearanceReport report;
    const double time = seconds_of([&] { report = judge_clearance(tool_of(), path, {{"mesh", role, mesh, 0.0}}, {}); });
    std::printf("judge, %s: %zu poses, %zu triangles, one thread%s: %.3f s\n", name, path.pose_count(),
                mesh.triangles.size(), role == ObstacleRole::kPart ? "" : ", flank too", time);
    for (const ClearanceFigure& f : report.figures)
      std::printf("  %-7s %10.4f mm, true to %.4f mm\n", std::string(body_name(f.body)).c_str(), f.clearance_mm,
                  f.bound_mm);
  }
}

Path swinging_path(double height, double lean) {
  Strip strip;
  for (int i = 0; i < 1000; ++i) {
    const double t = i / 999.0;
    strip.poses.push_back({Vec3(-40 + 80 * t, 5 * std::sin(6 * t), height),
                           Vec3(lean * std::sin(5 * t), 1.0, 0.25 + lean * std::cos(4 * t)).normalized()});
  }
  return {{strip}};
}

}  // namespace

int main() {
  set_thread_count(1);
  const TriangleMesh plate = bumpy_plate(224, 120.0), wheel = impeller();
  race("bumpy plate", plate);
  if (!wheel.triangles.empty()) race("impeller", wheel);
  judge_path("free over the plate", plate, swinging_path(14.0, 0.1));
  judge_path("colliding with the plate", plate, swinging_path(-8.0, 0.1));
  // Parallel to a plane all the way: every pose is as near as every other.
  Strip level;
  for (int i = 0; i < 1000; ++i) level.poses.push_back({Vec3(-40 + 0.08 * i, -60, 13), Vec3::UnitY()});
  TriangleMesh flat = plate;
  for (Vec3& v : flat.vertices) v.z() = 0.0;
  judge_path("parallel to a plane", flat, {{level}});
  if (!wheel.triangles.empty()) {
    Strip orbit;
    for (int i = 0; i < 1000; ++i) {
      const double a = 0.004 * i;
      orbit.poses.push_back({Vec3(75 * std::cos(a), -20, 75 * std::sin(a)),
                             Vec3(0.3 * std::cos(a), 1.0, 0.3 * std::sin(a)).normalized()});
    }
    judge_path("around the impeller", wheel, {{orbit}});
  }
  return 0;
}
