#include "flank/pipeline/program/program_rapids.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "flank/results/acceptance.h"
#include "flank/setup/clearance_scene.h"

namespace flank::internal {
namespace {

/// The axis of all of the tool: where it begins and ends, and how thick it is at most, mm.
struct Reach {
  double low = 0.0, high = 0.0, radius = 0.0;
};

Reach reach_of(const Tool& tool) {
  constexpr int kLooks = 200;
  Reach reach{0.0, tool.radial.axis_length(), 0.0};
  for (int k = 0; k <= kLooks; ++k) reach.radius = std::max(reach.radius, tool.radial.at(reach.high * k / kLooks).r);
  for (const auto* profile : {&tool.shank, &tool.holder})
    for (const Vec2& p : *profile) {
      reach.high = std::max(reach.high, p.x());
      reach.radius = std::max(reach.radius, p.y());
    }
  return reach;
}

/// From a point to the axis at a pose.
double to_axis(const Vec3& point, const Pose& pose, const Reach& reach) {
  const double s = std::clamp((point - pose.tip).dot(pose.axis), reach.low, reach.high);
  return (pose.at(s) - point).norm();
}

/// Whether a strip surely stays outside of a ball, by `room`: most rapids are far away, and then nothing else is asked. Between
/// two poses no point of the axis is farther from one of them than half of its way.
bool stays_outside(const Strip& strip, const Vec3& center, double radius, const Reach& reach) {
  for (std::size_t k = 0; k < strip.poses.size(); ++k) {
    const Pose& pose = strip.poses[k];
    double way = 0.0;
    if (k > 0) {
      const Pose& before = strip.poses[k - 1];
      way = std::max((pose.tip - before.tip).norm(), (pose.at(reach.high) - before.at(reach.high)).norm());
      if (!(to_axis(center, before, reach) - 0.5 * way > radius + reach.radius)) return false;
    }
    if (!(to_axis(center, pose, reach) - 0.5 * way > radius + reach.radius)) return false;
  }
  return true;
}

/// The strips that may come near to the part or to a fixture.
RapidMoves near_rapids(const RapidMoves& all, const Setup& setup, const Tool& tool, double room) {
  const Reach reach = reach_of(tool);
  RapidMoves near;
  for (std::size_t k = 0; k < all.path.strips.size(); ++k) {
    const Strip& strip = all.path.strips[k];
    const auto clear_of = [&](const Part& part) {
      return stays_outside(strip, part.box.center(), 0.5 * part.box.diagonal() + room, reach);
    };
    if (clear_of(setup.part) && std::all_of(setup.fixtures.begin(), setup.fixtures.end(), clear_of)) continue;
    near.path.strips.push_back(strip);
    near.lines.push_back(all.lines[k]);
  }
  return near;
}

}  // namespace

RapidMoves rapid_moves(const Backplot& plot) {
  RapidMoves out;
  for (std::size_t s = 0; s < plot.path.strips.size(); ++s) {
    const std::vector<Pose>& poses = plot.path.strips[s].poses;
    bool open = false;
    for (std::size_t k = 0; k < poses.size(); ++k) {
      const PoseMove& move = plot.moves[s][k];
      const bool counts = move.rapid && (k > 0 || move.from_afar);
      if (counts && !open) {
        out.path.strips.push_back({static_cast<int>(out.path.strips.size()) + 1, "rapid", "", {}});
        out.lines.emplace_back();
        if (!move.from_afar) {
          out.path.strips.back().poses.push_back(poses[k - 1]);
          out.lines.back().push_back(move.line);
        }
      }
      open = counts;
      if (!counts) continue;
      out.path.strips.back().poses.push_back(poses[k]);
      out.lines.back().push_back(move.line);
    }
  }
  return out;
}

namespace {

/// The first poses that are looked at together; twice as many each time nothing is found: a program that cuts at rapid is found
/// out at once, and one that does not costs no more than all of it.
constexpr std::size_t kFirstPoses = 128;

/// Takes rapids apart from the front.
class RapidPieces {
 public:
  explicit RapidPieces(const RapidMoves& all) : all_(all) {}

  [[nodiscard]] bool done() const { return strip_ == all_.path.strips.size(); }
  /// The next so many poses, at least two of a strip that has them; where a strip goes on, its last pose comes again.
  RapidMoves take(std::size_t poses) {
    RapidMoves out;
    for (std::size_t taken = 0; !done() && taken < poses;) {
      const Strip& strip = all_.path.strips[strip_];
      const std::size_t count = std::min(std::max<std::size_t>(poses - taken, 2), strip.poses.size() - pose_);
      out.path.strips.push_back({strip.id, strip.kind, "", {}});
      out.lines.emplace_back();
      for (std::size_t k = pose_; k < pose_ + count; ++k) {
        out.path.strips.back().poses.push_back(strip.poses[k]);
        out.lines.back().push_back(all_.lines[strip_][k]);
      }
      taken += count;
      pose_ += count - 1;
      if (pose_ + 1 < strip.poses.size()) continue;
      ++strip_;
      pose_ = 0;
    }
    return out;
  }

 private:
  const RapidMoves& all_;
  std::size_t strip_ = 0, pose_ = 0;
};

/// Adds what comes too near on some rapids; false: nothing does.
bool add_touches(const std::string& file, const ClearanceScene& scene, const Tool& tool, const RapidMoves& rapids,
                 Acceptance& acceptance) {
  bool found = false;
  for (const ClearanceFigure& f : measure_clearance(scene, tool, rapids.path).figures) {
    if (f.kept || f.strip < 0) continue;
    found = true;
    const std::vector<std::int32_t>& lines = rapids.lines[static_cast<std::size_t>(f.strip)];
    const auto pose = std::min(static_cast<std::size_t>(std::ceil(std::max(0.0, f.t))), lines.size() - 1);
    add_reason(acceptance, Figure::kRapid,
               fmt::format("{}: line {}: a rapid move brings the {} to {:.3f} mm from {} at ({:.3f}, {:.3f}, {:.3f}); "
                           "{:g} mm are required",
                           file, lines[pose], body_name(f.body), f.clearance_mm, f.obstacle, f.point.x(), f.point.y(),
                           f.point.z(), scene.options.required_mm));
  }
  return found;
}

}  // namespace

void accept_rapids(const std::string& file, const Setup& setup, const ObstacleRequest& obstacles, const Tool& tool,
                   const Backplot& plot, Acceptance& acceptance) {
  const double room = std::max({kRapidRoomMm, setup.tolerance_mm, obstacles.clearance_mm.value_or(0.0)});
  const RapidMoves rapids = near_rapids(rapid_moves(plot), setup, tool, room);
  if (rapids.path.strips.empty()) return;
  std::vector<std::string> notes;  // the verdict of the program has told them
  ClearanceScene scene = make_clearance_scene(setup, obstacles, true, notes);
  // Of a rapid nothing may touch anything: the flank the target as little as the holder a fixture.
  scene.obstacles = scene.obstacles.as_fixtures();
  scene.options.required_mm = room;
  RapidPieces pieces(rapids);
  for (std::size_t poses = kFirstPoses; !pieces.done(); poses *= 2)
    if (add_touches(file, scene, tool, pieces.take(poses), acceptance)) return;
}

}  // namespace flank::internal
