#include "flank/clearance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "flank/base/parallel.h"
#include "flank/error.h"
#include "flank/verify/clearance/flank_profile.h"
#include "flank/verify/clearance/motion_gap.h"
#include "flank/verify/clearance/obstacle_set.h"
#include "flank/verify/swept/pose_tree.h"

namespace flank {
using namespace internal;
namespace {

using namespace internal::verify;

constexpr std::array kRoles{ObstacleRole::kTarget, ObstacleRole::kPart, ObstacleRole::kFixture};

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

/// A body on its way, against the obstacles of one role.
struct Pair {
  const Body& body;
  ObstacleRole role;
  const ObstacleStore& obstacles;
  const std::vector<Segment>& segments;
  const BodyWay& way;
};

/// The obstacles within this are looked at first, mm; then those within so many times as much, until nothing nearer can be left.
double first_reach(const Pair& pair) { return std::max(pair.way.radius_mm, kPoseClearanceMm); }
constexpr double kFarther = 4.0;

/// What is nearest, and the obstacles that it is one of.
struct Nearest {
  GapPlace place;
  std::shared_ptr<const ObstacleScene> scene;
};

Nearest nearest_of(const Pair& pair, double accuracy_mm) {
  for (double reach = first_reach(pair);; reach *= kFarther) {
    const double limit = std::min(reach, pair.body.limit_mm);
    auto scene = pair.obstacles.near(pair.role, pair.way, limit);
    const bool last = scene->whole || limit >= pair.body.limit_mm;
    GapPlace place;
    if (!scene->tree.empty())
      place =
          MotionGap(pair.body.parts, scene->tree, pair.segments).least(accuracy_mm, last ? pair.body.limit_mm : limit);
    if (place.segment >= 0 || last) return {place, std::move(scene)};
  }
}

/// `notes` gets what is inexact about the obstacle.
ClearanceFigure measure(const Pair& pair, const ClearanceOptions& options, std::vector<std::string>& notes) {
  ClearanceFigure figure;
  figure.body = pair.body.name;
  figure.role = pair.role;
  figure.required_mm = requirement(options, pair.body.name, pair.role);
  const auto [place, scene] = nearest_of(pair, options.accuracy_mm);
  if (place.segment < 0) {
    figure.clearance_mm = std::numeric_limits<double>::infinity();
    return figure;
  }
  const Segment& segment = pair.segments[static_cast<std::size_t>(place.segment)];
  figure.clearance_mm = place.value;
  figure.bound_mm = gap_bound(place.value, options.accuracy_mm) + pair.body.deviation_mm + scene->deviation_mm;
  figure.kept = figure.clearance_mm - figure.bound_mm >= figure.required_mm;
  const Obstacle& nearest = pair.obstacles.made(scene->obstacle_of[static_cast<std::size_t>(place.triangle)]);
  figure.obstacle = nearest.name;
  if (!nearest.caveat.empty() && std::find(notes.begin(), notes.end(), nearest.caveat) == notes.end())
    notes.push_back(nearest.caveat);
  figure.point = place.point;
  figure.strip = segment.strip;
  figure.t = segment.pose + place.tau;
  figure.z_mm = place.z;
  figure.rho_mm = place.rho;
  return figure;
}

/// Nothing of the obstacles is farther from any point of the tool.
double farthest(const ObstacleSet& obstacles, const Path& path) {
  Box3 box;
  for (const DistantObstacle& o : obstacles.obstacles()) box.add(o.box);
  for (const Strip& strip : path.strips)
    for (const Pose& pose : strip.poses) box.add(pose.tip);
  return box.diagonal();
}

double spare(const ClearanceFigure& f) { return f.clearance_mm - f.bound_mm - f.required_mm; }

/// The figure of the role of which least is spare. Of a fixture only shank and holder themselves say what is in their way: it may
/// stand anywhere beyond them.
ClearanceFigure tightest(const Body& body, const ObstacleSet& obstacles, const std::vector<Segment>& segments,
                         const ClearanceOptions& options) {
  std::optional<ClearanceFigure> least;
  const BodyWay way = way_of(body.parts, segments);
  std::vector<std::string> unsaid;  // it is measured coarsely anyway
  for (const ObstacleRole role : kRoles) {
    if (!store_of(obstacles).has(role) || role == ObstacleRole::kFixture) continue;
    const ClearanceFigure here = measure({body, role, store_of(obstacles), segments, way}, options, unsaid);
    if (!least || spare(here) < spare(*least)) least = here;
  }
  return *least;
}

/// The clearances at the poses of one segment each: of its first one, at the end of a strip of both of its ends.
struct PosesOf {
  int segment = 0;
  double* poses = nullptr;  ///< one, or two
  int count = 1;
};

constexpr double kLeftOut = std::numeric_limits<double>::quiet_NaN();

/// All poses of a path, as far as nothing; of a long one every so many, and the last ones of its strips.
std::vector<std::vector<double>> poses_to_show(const Path& path) {
  const std::size_t every = 1 + path.pose_count() / kMostShownPoses;
  std::vector<std::vector<double>> by_strip;
  for (const Strip& strip : path.strips) {
    std::vector<double>& poses = by_strip.emplace_back(strip.poses.size(), std::numeric_limits<double>::infinity());
    for (std::size_t k = 0; k + 2 < poses.size(); ++k)
      if (k % every != 0) poses[k] = kLeftOut;
  }
  return by_strip;
}

/// What was left out gets the lesser one of what is known to either side.
void fill_left_out(std::vector<double>& poses) {
  std::size_t before = 0;
  for (std::size_t k = 1; k < poses.size(); ++k) {
    if (std::isnan(poses[k])) continue;
    const double least = std::min(poses[before], poses[k]);
    std::fill(poses.begin() + static_cast<std::ptrdiff_t>(before) + 1, poses.begin() + static_cast<std::ptrdiff_t>(k),
              least);
    before = k;
  }
}

std::vector<PosesOf> poses_of(const std::vector<Segment>& segments, std::vector<std::vector<double>>& by_strip) {
  std::vector<PosesOf> all;
  for (std::size_t k = 0; k < segments.size(); ++k) {
    std::vector<double>& poses = by_strip[static_cast<std::size_t>(segments[k].strip)];
    const auto first = static_cast<std::size_t>(segments[k].pose);
    if (std::isnan(poses[first])) continue;
    const bool ends = k + 1 == segments.size() || segments[k + 1].strip != segments[k].strip;
    all.push_back({static_cast<int>(k), &poses[first],
                   static_cast<int>(std::min(poses.size() - first, std::size_t{ends ? 2u : 1u}))});
  }
  return all;
}

/// Lowers the clearance of every pose that is not left out to that of this pair.
void lower_to(std::vector<std::vector<double>>& by_strip, const Pair& pair) {
  constexpr std::size_t kGrain = 16;  // segments per task; each is one query of a tree
  std::vector<PosesOf> open = poses_of(pair.segments, by_strip);
  for (double reach = first_reach(pair); !open.empty(); reach *= kFarther) {
    const auto scene = pair.obstacles.near(pair.role, pair.way, reach);
    const double limit = scene->whole ? std::numeric_limits<double>::max() : reach;
    if (!scene->tree.empty()) {
      const MotionGap gap(pair.body.parts, scene->tree, pair.segments);
      parallel_blocks(open.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k)
          for (int i = 0; i < open[k].count; ++i) {
            double& least = open[k].poses[i];
            const double below = std::min(least, limit);
            const double here = gap.at(open[k].segment, i, kPoseClearanceMm, below);
            if (here < below) least = here;
          }
      });
    }
    if (scene->whole) return;
    // What is not nearer than the reach may be nearer to something that was not looked at.
    std::erase_if(open, [&](const PosesOf& of) {
      return std::all_of(of.poses, of.poses + of.count, [&](double least) { return least < reach; });
    });
  }
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
  const ObstacleStore& obstacles;  ///< must outlive this
  std::vector<Segment> segments;
  std::vector<Body> bodies;

  Pairs(const Tool& tool, const Path& path, const ObstacleSet& of, const ClearanceOptions& options)
      : obstacles(store_of(of)) {
    if (!(options.accuracy_mm > 0.0) || !(options.tolerance_mm > 0.0))
      throw UsageError("clearance: accuracy and tolerance must be > 0 mm");
    segments = PoseTree(path, tool.radial.axis_length(), 1e300).segments;
    bodies = bodies_of(tool);
  }

  /// Until a call says that it is enough.
  void each(const std::function<bool(const Pair&)>& call) const {
    for (const Body& body : bodies) {
      const BodyWay way = way_of(body.parts, segments);
      for (const ObstacleRole role : kRoles) {
        const bool judged_elsewhere = body.name == ToolBody::kFlank && role != ObstacleRole::kFixture;
        if (body.parts.empty() || !obstacles.has(role) || judged_elsewhere) continue;
        if (!call({body, role, obstacles, segments, way})) return;
      }
    }
  }
};

}  // namespace

ClearanceReport judge_clearance(const Tool& tool, const Path& path, const ObstacleSet& obstacles,
                                const ClearanceOptions& options) {
  const Pairs pairs(tool, path, obstacles, options);
  ClearanceReport report;
  report.pose_clearance_mm = poses_to_show(path);
  pairs.each([&](const Pair& pair) {
    report.figures.push_back(measure(pair, options, report.notes));
    if (!may_touch(pair.body.name, pair.role)) lower_to(report.pose_clearance_mm, pair);
    return true;
  });
  for (std::vector<double>& poses : report.pose_clearance_mm) fill_left_out(poses);
  return report;
}

bool keeps_clear(const Tool& tool, const Path& path, const ObstacleSet& obstacles, const ClearanceOptions& options,
                 double shank_least_mm) {
  const Pairs pairs(tool, path, obstacles, options);
  bool kept = true;
  pairs.each([&](const Pair& pair) {
    double least = requirement(options, pair.body.name, pair.role);
    if (pair.body.name == ToolBody::kShank) least = std::max(least, shank_least_mm);
    // What is farther than that is clear of the body, however well it is known.
    const auto scene =
        pair.obstacles.near(pair.role, pair.way, std::max(0.0, least) + pair.body.deviation_mm + options.accuracy_mm);
    if (scene->tree.empty()) return true;
    least += pair.body.deviation_mm + scene->deviation_mm;
    kept = MotionGap(pair.body.parts, scene->tree, pair.segments).stays_above(least, options.accuracy_mm);
    return kept;
  });
  return kept;
}

std::optional<HoldReport> judge_hold(const Tool& tool, const Path& path, const ObstacleSet& obstacles,
                                     const ClearanceOptions& options) {
  constexpr double kAccuracyShare =
      0.02;  // of the upper end's radius: whether something is in the way, not by how much
  const Vec2 top = meridian_point(tool.radial, tool.radial.axis_length());
  const std::vector<Segment> segments = PoseTree(path, tool.radial.axis_length(), 1e300).segments;
  const bool something = store_of(obstacles).has(ObstacleRole::kTarget) || store_of(obstacles).has(ObstacleRole::kPart);
  if (segments.empty() || !something || !(top.y() > 0.0)) return std::nullopt;
  const auto cylinder = [&](ToolBody name, double radius, double length, double limit) {
    return Body{name, convex_bodies({{top.x(), radius}, {top.x() + length, radius}}), 0.0, limit};
  };
  ClearanceOptions coarse = options;
  coarse.accuracy_mm = std::max(options.accuracy_mm, kAccuracyShare * top.y());
  coarse.required_mm = -1.0;  // a clearance is asked of shank and holder, not of what stands for them here
  HoldReport report;
  const double beyond = farthest(obstacles, path) + tool.radial.axis_length();
  report.axis = tightest(cylinder(ToolBody::kAxis, kRodShare * top.y(), beyond, top.y()), obstacles, segments, coarse);
  if (tool.shank.empty())
    report.as_thick =
        tightest(cylinder(ToolBody::kShank, top.y(), 2.0 * top.y(), top.y()), obstacles, segments, coarse);
  return report;
}

}  // namespace flank
