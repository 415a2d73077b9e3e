#include "flank/wheel/guarded.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "flank/base/parallel.h"
#include "flank/io/face_names.h"
#include "flank/wheel/point/axis_rod.h"
#include "flank/wheel/point/motion_guard.h"
#include "flank/wheel/point/pass_strips.h"

namespace flank::internal {
namespace {

constexpr double kMostShare = 0.96;  ///< of the tolerance, that a face may be cut
constexpr double kLiftFrom = 0.9, kLiftTo = 0.7;
constexpr double kOffShare = 0.05;
constexpr int kLifts = 4;  ///< rounds
constexpr int kAlong = 8;  ///< poses to either side that are lifted along, less and less

/// What keeps off need not know the part more closely than a share of how far.
double off_of(const WheelWork& work, double most_mm) {
  return std::max(WheelWork::kGuardShare * work.job.tolerance_mm, -kOffShare * most_mm);
}

MotionGuard guard_of(WheelWork& work, const Path& path, const RadialFunction& radial, double most_mm) {
  const double off = off_of(work, most_mm);
  return {work.guard_triangles(path, radial, off), off, radial, most_mm};
}

/// How far each pose moves: as the one beside it that needs most asks, less by how far that is.
std::vector<Vec3> spread(const std::vector<Vec3>& needs) {
  std::vector<Vec3> out(needs.size(), Vec3::Zero());
  const int count = static_cast<int>(needs.size());
  for (int k = 0; k < count; ++k)
    for (int n = std::max(0, k - kAlong); n <= std::min(count - 1, k + kAlong); ++n) {
      const double share = 1.0 - std::abs(n - k) / (kAlong + 1.0);
      const Vec3 here = share * needs[static_cast<std::size_t>(n)];
      if (here.squaredNorm() > out[static_cast<std::size_t>(k)].squaredNorm()) out[static_cast<std::size_t>(k)] = here;
    }
  return out;
}

}  // namespace

PathGuard::PathGuard(WheelWork& work, const Path& around, const Tool& tool, double most_mm)
    : flank_(guard_of(work, around, tool.radial, most_mm)),
      rod_(ToolFamily::kCylinder, work.reach_mm(),
           Eigen::VectorXd::Constant(1, rod_radius(shank_radius(tool), work.reach_mm(), RodRoom::kGuarded))),
      rod_from_mm_(tool.radial.axis_length() + shank_radius(tool)),
      shank_(work.wheel_triangles(), 0.0, rod_, 0.0) {}

bool PathGuard::is_free(const Pose& from, const Pose& to) const {
  return flank_.is_free(from, to) && shank_.is_free({from.at(rod_from_mm_), from.axis}, {to.at(rod_from_mm_), to.axis});
}

Path lifted(WheelWork& work, const Path& path) {
  const MotionGuard guard = guard_of(work, path, work.tool->radial, kMostShare * work.job.tolerance_mm);
  Path out = path;
  for (Strip& strip : out.strips)
    for (int round = 0; round < kLifts; ++round) {
      std::vector<Vec3> needs(strip.poses.size(), Vec3::Zero());
      parallel_for(needs.size(), [&](std::size_t k) {
        const MotionGuard::Depth depth = guard.depth(strip.poses[k]);
        if (depth.mm > kLiftFrom * work.job.tolerance_mm)
          needs[k] = (depth.mm - kLiftTo * work.job.tolerance_mm) * depth.away;
      });
      if (std::all_of(needs.begin(), needs.end(), [](const Vec3& v) { return v.isZero(); })) break;
      const std::vector<Vec3> moves = spread(needs);
      for (std::size_t k = 0; k < moves.size(); ++k) strip.poses[k].tip += moves[k];
    }
  return out;
}

Path guarded(WheelWork& work, const Path& path) {
  return guarded(work, path, *work.tool, kMostShare * work.job.tolerance_mm, Turns::kHeld);
}

Path guarded(WheelWork& work, const Path& path, const Tool& tool, double most_mm, Turns turns) {
  const RadialFunction& radial = tool.radial;
  const PathGuard guard(work, path, tool, most_mm);
  std::vector<std::pair<std::size_t, std::size_t>> all;
  for (std::size_t s = 0; s < path.strips.size(); ++s)
    for (std::size_t k = 0; k + 1 < path.strips[s].poses.size(); ++k) all.emplace_back(s, k);
  std::vector<char> free(all.size(), 0);
  parallel_for(all.size(), [&](std::size_t n) {
    const std::vector<Pose>& poses = path.strips[all[n].first].poses;
    const Pose &from = poses[all[n].second], &to = poses[all[n].second + 1];
    free[n] = guard.is_free(from, to) ? 1 : 0;
  });
  Path out;
  std::map<std::string, PointOptions> options_of;
  std::size_t n = 0;
  for (const Strip& strip : path.strips) {
    const auto [known, is_new] = options_of.try_emplace(strip.face);
    if (is_new) known->second = work.point_options(face_list_items(strip.face));
    if (turns == Turns::kAny) known->second.most_turn_rad = std::numbers::pi;
    const PointOptions& options = known->second;
    Strip run = strip;
    run.poses.assign(1, strip.poses.front());
    for (std::size_t k = 0; k + 1 < strip.poses.size(); ++k, ++n) {
      if (free[n] == 0) {
        add_strip(run, radial, options, out.strips);
        run.poses.clear();
      }
      run.poses.push_back(strip.poses[k + 1]);
    }
    add_strip(std::move(run), radial, options, out.strips);
  }
  // There are millions of triangles, and the path's judge needs memory of its own.
  work.fine.reset();
  for (std::size_t k = 0; k < out.strips.size(); ++k) out.strips[k].id = static_cast<int>(k) + 1;
  return out;
}

}  // namespace flank::internal
