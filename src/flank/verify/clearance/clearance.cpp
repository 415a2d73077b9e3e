#include "flank/clearance.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <optional>

#include "flank/base/parallel.h"
#include "flank/error.h"
#include "flank/geom/tessellate.h"
#include "flank/verify/clearance/flank_profile.h"
#include "flank/verify/clearance/motion_gap.h"
#include "flank/verify/swept/pose_tree.h"

namespace flank {
using namespace internal;
namespace {

using namespace internal::verify;

constexpr std::array kRoles{ObstacleRole::kTarget, ObstacleRole::kPart, ObstacleRole::kFixture};

/// All obstacles of one role as one mesh that remembers where its triangles come from.
struct Scene {
  ObstacleRole role = ObstacleRole::kPart;
  ObstacleTree tree;
  std::vector<int> obstacle_of;  ///< of each triangle
  double deviation_mm = 0.0;
};

Scene scene_of(const std::vector<Obstacle>& obstacles, ObstacleRole role) {
  Scene scene;
  scene.role = role;
  TriangleMesh all;
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    const Obstacle& o = obstacles[k];
    if (o.role != role || o.mesh.triangles.empty()) continue;
    append(all, o.mesh);
    scene.obstacle_of.resize(all.triangles.size(), static_cast<int>(k));
    scene.deviation_mm = std::max(scene.deviation_mm, o.deviation_mm);
  }
  scene.tree = ObstacleTree(all);
  return scene;
}

struct Body {
  ToolBody name = ToolBody::kShank;
  std::vector<Revolved> parts;
  double deviation_mm = 0.0;
  double limit_mm = std::numeric_limits<double>::max();  ///< clearances of that much and more need not be told apart
};

std::vector<Body> bodies_of(const Tool& tool) {
  std::vector<Body> bodies;
  bodies.push_back({ToolBody::kFlank, flank_bodies(tool.radial), kFlankProfileErrorMm});
  bodies.push_back({ToolBody::kShank, convex_bodies(tool.shank), 0.0});
  bodies.push_back({ToolBody::kHolder, convex_bodies(tool.holder), 0.0});
  return bodies;
}

bool may_touch(ToolBody body, ObstacleRole role) { return body == ToolBody::kShank && role == ObstacleRole::kTarget; }

/// A requirement of the user holds for every pair but shank and target, which touch where the flank does. Without one,
/// the holder must not touch anything, and the others have the tolerance. What is left on the part is kept besides.
double requirement(const ClearanceOptions& options, ToolBody body, ObstacleRole role) {
  const double left = role == ObstacleRole::kFixture ? 0.0 : options.allowance_mm;
  if (options.required_mm >= 0.0 && !may_touch(body, role)) return left + options.required_mm;
  return left + (body == ToolBody::kHolder || body == ToolBody::kAxis ? 0.0 : -options.tolerance_mm);
}

ClearanceFigure measure(const Body& body, const Scene& scene, const std::vector<Obstacle>& obstacles,
                        const std::vector<Segment>& segments, const ClearanceOptions& options) {
  ClearanceFigure figure;
  figure.body = body.name;
  figure.role = scene.role;
  figure.required_mm = requirement(options, body.name, scene.role);
  const GapPlace place = MotionGap(body.parts, scene.tree, segments).least(options.accuracy_mm, body.limit_mm);
  if (place.segment < 0) {
    figure.clearance_mm = std::numeric_limits<double>::infinity();
    return figure;
  }
  const Segment& segment = segments[static_cast<std::size_t>(place.segment)];
  figure.clearance_mm = place.value;
  figure.bound_mm = gap_bound(place.value, options.accuracy_mm) + body.deviation_mm + scene.deviation_mm;
  figure.kept = figure.clearance_mm - figure.bound_mm >= figure.required_mm;
  const int obstacle = scene.obstacle_of[static_cast<std::size_t>(place.triangle)];
  figure.obstacle = obstacles[static_cast<std::size_t>(obstacle)].name;
  figure.point = place.point;
  figure.strip = segment.strip;
  figure.t = segment.pose + place.tau;
  figure.z_mm = place.z;
  figure.rho_mm = place.rho;
  return figure;
}

/// Nothing of the obstacles is farther from any point of the tool.
double farthest(const std::vector<Obstacle>& obstacles, const Path& path) {
  Box3 box;
  for (const Obstacle& o : obstacles)
    for (const Vec3& p : o.mesh.vertices) box.add(p);
  for (const Strip& strip : path.strips)
    for (const Pose& pose : strip.poses) box.add(pose.tip);
  return box.diagonal();
}

double spare(const ClearanceFigure& f) { return f.clearance_mm - f.bound_mm - f.required_mm; }

/// The figure of the role of which least is spare. Of a fixture only shank and holder themselves say what is in their way: it may
/// stand anywhere beyond them.
ClearanceFigure tightest(const Body& body, const std::array<Scene, kRoles.size()>& scenes,
                         const std::vector<Obstacle>& obstacles, const std::vector<Segment>& segments,
                         const ClearanceOptions& options) {
  std::optional<ClearanceFigure> least;
  for (const Scene& scene : scenes) {
    if (scene.tree.empty() || scene.role == ObstacleRole::kFixture) continue;
    const ClearanceFigure here = measure(body, scene, obstacles, segments, options);
    if (!least || spare(here) < spare(*least)) least = here;
  }
  return *least;
}

/// Lowers the clearance of every pose to that of this pair.
void lower_to(std::vector<std::vector<double>>& by_strip, const Body& body, const Scene& scene,
              const std::vector<Segment>& segments) {
  constexpr std::size_t kGrain = 16;  // segments per task; each is one query of a tree
  const MotionGap gap(body.parts, scene.tree, segments);
  parallel_blocks(segments.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      std::vector<double>& poses = by_strip[static_cast<std::size_t>(segments[k].strip)];
      const auto first = static_cast<std::size_t>(segments[k].pose);
      // Each segment answers for its first pose, the last one of a strip for both of its ends.
      const bool ends = k + 1 == segments.size() || segments[k + 1].strip != segments[k].strip;
      for (std::size_t i = first; i < std::min(poses.size(), first + (ends ? 2 : 1)); ++i)
        poses[i] = gap.at(static_cast<int>(k), i == first ? 0.0 : 1.0, kPoseClearanceMm, poses[i]);
    }
  });
}

}  // namespace

std::string_view body_name(ToolBody body) {
  constexpr std::array<std::string_view, 4> kNames{"flank", "shank", "holder", "axis"};
  return kNames[static_cast<std::size_t>(body)];
}

std::string_view role_name(ObstacleRole role) {
  return role == ObstacleRole::kTarget ? "target" : role == ObstacleRole::kPart ? "part" : "fixture";
}

bool ClearanceReport::kept() const {
  return std::all_of(figures.begin(), figures.end(), [](const ClearanceFigure& f) { return f.kept; });
}

const ClearanceFigure* ClearanceReport::worst() const {
  const auto least = std::min_element(figures.begin(), figures.end(),
                                      [&](const auto& a, const auto& b) { return spare(a) < spare(b); });
  return least == figures.end() ? nullptr : &*least;
}

namespace {

/// What is measured of a tool on a path: each body against the obstacles of each role.
struct Pairs {
  std::vector<Segment> segments;
  std::array<Scene, kRoles.size()> scenes;
  std::vector<Body> bodies;

  Pairs(const Tool& tool, const Path& path, const std::vector<Obstacle>& obstacles, const ClearanceOptions& options) {
    if (!(options.accuracy_mm > 0.0) || !(options.tolerance_mm > 0.0))
      throw UsageError("clearance: accuracy and tolerance must be > 0 mm");
    segments = PoseTree(path, tool.radial.axis_length(), 1e300).segments;
    for (std::size_t k = 0; k < kRoles.size(); ++k) scenes[k] = scene_of(obstacles, kRoles[k]);
    bodies = bodies_of(tool);
  }

  /// Until a call says that it is enough.
  void each(const std::function<bool(const Body&, const Scene&)>& call) const {
    for (const Body& body : bodies)
      for (const Scene& scene : scenes) {
        const bool judged_elsewhere = body.name == ToolBody::kFlank && scene.role != ObstacleRole::kFixture;
        if (!body.parts.empty() && !scene.tree.empty() && !judged_elsewhere && !call(body, scene)) return;
      }
  }
};

}  // namespace

ClearanceReport judge_clearance(const Tool& tool, const Path& path, const std::vector<Obstacle>& obstacles,
                                const ClearanceOptions& options) {
  const Pairs pairs(tool, path, obstacles, options);
  ClearanceReport report;
  for (const Strip& strip : path.strips)
    report.pose_clearance_mm.emplace_back(strip.poses.size(), std::numeric_limits<double>::infinity());
  pairs.each([&](const Body& body, const Scene& scene) {
    report.figures.push_back(measure(body, scene, obstacles, pairs.segments, options));
    if (!may_touch(body.name, scene.role)) lower_to(report.pose_clearance_mm, body, scene, pairs.segments);
    return true;
  });
  return report;
}

bool keeps_clear(const Tool& tool, const Path& path, const std::vector<Obstacle>& obstacles,
                 const ClearanceOptions& options, double shank_least_mm) {
  const Pairs pairs(tool, path, obstacles, options);
  bool kept = true;
  pairs.each([&](const Body& body, const Scene& scene) {
    double least = requirement(options, body.name, scene.role);
    if (body.name == ToolBody::kShank) least = std::max(least, shank_least_mm);
    least += body.deviation_mm + scene.deviation_mm;
    kept = MotionGap(body.parts, scene.tree, pairs.segments).stays_above(least, options.accuracy_mm);
    return kept;
  });
  return kept;
}

std::optional<HoldReport> judge_hold(const Tool& tool, const Path& path, const std::vector<Obstacle>& obstacles,
                                     const ClearanceOptions& options) {
  constexpr double kAccuracyShare =
      0.02;  // of the upper end's radius: whether something is in the way, not by how much
  const Vec2 top = meridian_point(tool.radial, tool.radial.axis_length());
  const std::vector<Segment> segments = PoseTree(path, tool.radial.axis_length(), 1e300).segments;
  std::array<Scene, kRoles.size()> scenes;
  for (std::size_t k = 0; k < kRoles.size(); ++k) scenes[k] = scene_of(obstacles, kRoles[k]);
  const bool something = std::any_of(
      scenes.begin(), scenes.end(), [](const Scene& s) { return !s.tree.empty() && s.role != ObstacleRole::kFixture; });
  if (segments.empty() || !something || !(top.y() > 0.0)) return std::nullopt;
  const auto cylinder = [&](ToolBody name, double radius, double length, double limit) {
    return Body{name, convex_bodies({{top.x(), radius}, {top.x() + length, radius}}), 0.0, limit};
  };
  ClearanceOptions coarse = options;
  coarse.accuracy_mm = std::max(options.accuracy_mm, kAccuracyShare * top.y());
  coarse.required_mm = -1.0;  // a clearance is asked of shank and holder, not of what stands for them here
  HoldReport report;
  const double beyond = farthest(obstacles, path) + tool.radial.axis_length();
  report.axis =
      tightest(cylinder(ToolBody::kAxis, kRodShare * top.y(), beyond, top.y()), scenes, obstacles, segments, coarse);
  if (tool.shank.empty())
    report.as_thick =
        tightest(cylinder(ToolBody::kShank, top.y(), 2.0 * top.y(), top.y()), scenes, obstacles, segments, coarse);
  return report;
}

}  // namespace flank
