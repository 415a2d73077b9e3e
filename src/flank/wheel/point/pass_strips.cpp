#include "flank/wheel/point/pass_strips.h"

#include <algorithm>
#include <utility>

#include "flank/base/parallel.h"
#include "flank/path/turning.h"

namespace flank::internal {
namespace {

constexpr std::size_t kFewestPoses = 3;
constexpr double kStillMm = 1e-9;
constexpr int kTurnRounds = 120;     ///< in which axes are turned
constexpr std::size_t kAround = 10;  ///< poses to either side of a turn, whose axes are turned

/// Pieces that turn nowhere too sharply, in their order; those that are not worth a link are left out.
void cut_at_turns(Strip strip, const RadialFunction& radial, const PointOptions& options, std::vector<Strip>& pieces) {
  double length = 0.0;
  for (std::size_t k = 1; k < strip.poses.size(); ++k) length += (strip.poses[k].tip - strip.poses[k - 1].tip).norm();
  if (strip.poses.size() < kFewestPoses || length < kShortestStripMm) return;
  const Turning turn = sharpest_turn(strip.poses, radial.axis_length(), options.turn_window_mm);
  if (turn.angle_rad <= options.most_turn_rad) {
    pieces.push_back(std::move(strip));
    return;
  }
  // At one pose, or where the turn begins and where it ends: what lies between would turn as sharply in any piece.
  const std::size_t begin = std::clamp<std::size_t>(turn.from_pose + 1, 1, strip.poses.size() - 2),
                    end = std::clamp<std::size_t>(turn.pose, begin, strip.poses.size() - 2);
  Strip rest = strip;
  rest.poses.erase(rest.poses.begin(), rest.poses.begin() + static_cast<std::ptrdiff_t>(end));
  strip.poses.resize(begin + 1);
  cut_at_turns(std::move(strip), radial, options, pieces);
  cut_at_turns(std::move(rest), radial, options, pieces);
}

}  // namespace

void add_strip(Strip strip, const RadialFunction& radial, const PointOptions& options, std::vector<Strip>& out) {
  std::vector<Strip> pieces;
  cut_at_turns(std::move(strip), radial, options, pieces);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    // Each other one the other way round: where one ends another one that begins would be run on without a link, round the corner.
    if (k % 2 == 1) std::reverse(pieces[k].poses.begin(), pieces[k].poses.end());
    out.push_back(std::move(pieces[k]));
  }
}

void steady(Strip& strip, const std::function<bool(std::size_t, const Pose&)>& is_free, const RadialFunction& radial,
            const PointOptions& options) {
  std::vector<Pose>& poses = strip.poses;
  if (poses.size() < kFewestPoses) return;
  for (int round = 0; round < kTurnRounds; ++round) {
    const Turning turn = sharpest_turn(poses, radial.axis_length(), options.turn_window_mm);
    if (turn.angle_rad <= options.most_turn_rad) return;
    const std::size_t from = std::max(kAround, turn.pose) - kAround + 1,
                      to = std::min(poses.size() - 1, turn.pose + kAround);
    const std::vector<Pose> before = poses;
    bool any = false;
    for (std::size_t k = from; k < to; ++k) {
      const Pose &back = before[k - 1], &on = before[k + 1];
      const double behind = (before[k].tip - back.tip).norm(), ahead = (on.tip - before[k].tip).norm();
      // Places of a pass need not be even: the axis between its neighbours' is the one by the way.
      const Vec3 between = ((ahead * back.axis + behind * on.axis) / std::max(ahead + behind, kStillMm)).normalized();
      const Pose turned{before[k].tip, (before[k].axis + between).normalized()};
      if (!is_free(k, turned)) continue;
      poses[k] = turned;
      any = true;
    }
    if (!any) return;
  }
}

void add_strips(std::vector<PoseRow> rows, const TipRoom& room, const RadialFunction& radial,
                const PointOptions& options, const std::string& kind, const std::string& face,
                std::vector<Strip>& out) {
  std::vector<std::vector<Strip>> found(rows.size());
  parallel_for(rows.size(), [&](std::size_t j) {
    if (j % 2 == 1) std::reverse(rows[j].begin(), rows[j].end());
    Strip strip{.id = 1, .kind = kind, .face = face, .poses = {}};
    rows[j].emplace_back();
    for (const std::optional<Pose>& pose : rows[j]) {
      if (pose) {
        strip.poses.push_back(*pose);
        continue;
      }
      steady(
          strip, [&](std::size_t, const Pose& turned) { return room.is_free(turned); }, radial, options);
      add_strip(strip, radial, options, found[j]);
      strip.poses.clear();
    }
  });
  for (std::vector<Strip>& row : found)
    for (Strip& strip : row) out.push_back(std::move(strip));
}

Strip thinned(const Strip& strip, double axis_length, double chord_mm) {
  const std::vector<Pose>& poses = strip.poses;
  Strip out = strip;
  if (poses.size() < kFewestPoses) return out;
  out.poses.assign(1, poses.front());
  // What is left to look at, the next piece last: where a piece is too far beside its chord it is cut at its farthest pose.
  std::vector<std::size_t> ends{poses.size() - 1};
  for (std::size_t from = 0; !ends.empty();) {
    const std::size_t to = ends.back();
    const Vec3 tip = poses[to].tip - poses[from].tip, top = poses[to].at(axis_length) - poses[from].at(axis_length);
    const double whole = tip.squaredNorm() + top.squaredNorm();
    double most = chord_mm;
    std::size_t farthest = 0;
    for (std::size_t k = from + 1; k < to; ++k) {
      const Vec3 here = poses[k].tip - poses[from].tip, above = poses[k].at(axis_length) - poses[from].at(axis_length);
      const double t = whole > 0.0 ? std::clamp((here.dot(tip) + above.dot(top)) / whole, 0.0, 1.0) : 0.0;
      const double off = std::max((here - t * tip).norm(), (above - t * top).norm());
      if (off > most) most = off, farthest = k;
    }
    if (farthest > 0) {
      ends.push_back(farthest);
      continue;
    }
    out.poses.push_back(poses[to]);
    from = to;
    ends.pop_back();
  }
  return out;
}

}  // namespace flank::internal
