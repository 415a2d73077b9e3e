#include "flank/wheel/rough/cycles.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "flank/base/parallel.h"

namespace flank::internal {
namespace {

constexpr double kBendShare = 1.5;  ///< of the tip's radius, that a front half bends by at its ends at least
constexpr double kOverShare = 4.0;  ///< of it, by which a layer goes on where it is open
constexpr double kJumpShare = 2.0;  ///< of it, from loop to loop, beyond which another strip begins
constexpr double kBackShare = 0.4;  ///< of that, by which the back half bows behind
constexpr double kStillMm = 1e-9;
constexpr int kFewest = 8;                       ///< poses of a half
constexpr double kLonger = 1.3, kShorter = 0.7;  ///< than the last one a step is tried
constexpr double kNarrowShare = 0.1;             ///< of the tip's radius, by which a loop gives way to one side
constexpr double kWidenShare = 0.25;     ///< of a step, by which the next loop is wider: at its ends it bends sharply
constexpr double kNarrowestShare = 0.3;  ///< of the channel's width
constexpr double kIdleShare = 1.0;  ///< of the tip's radius, from the last loop that cut to the next one of a strip

/// Closed: a front half that cuts, then a back half.
struct Loop {
  bool cuts = false;
  std::vector<Pose> poses;
  std::vector<double> shares;  ///< of each pose, across the channel
};

class Clearing {
 public:
  Clearing(const ChannelLayer& layer, const Cutter& cutter, const CycleLimits& limits, bool forward, StockGrid& stock)
      : layer_(layer),
        cutter_(cutter),
        limits_(limits),
        stock_(stock),
        forward_(forward),
        from_first_(layer.climbs_from_first() == forward) {}

  /// Whether all loops went from side to side.
  bool run(Strip strip, std::vector<Strip>& out) {
    const double r = cutter_.tip(), most = limits_.most_step_share * r;
    double step = most, idle = 0.0;
    bool all = true;
    for (double place = 0.0; place < layer_.length();) {
      step = std::min(most, kLonger * step);
      const std::optional<Loop> loop = fitting(place, strip, step);
      all = all && loop && low_ == 0.0 && high_ == 1.0;
      if (!loop) low_ = 0.0, high_ = 1.0;
      place += loop ? step : most, idle += loop ? step : kIdleShare * r;
      if (loop && loop->cuts)
        add(loop->poses, strip, out), idle = 0.0;
      else if (idle >= kIdleShare * r)
        end(strip, out);
      widen(place, step);
    }
    end(strip, out);
    return all;
  }

 private:
  static void end(Strip& strip, std::vector<Strip>& out) {
    if (!strip.poses.empty()) out.push_back(strip);
    strip.poses.clear();
  }
  [[nodiscard]] bool cuts(const Loop& loop) const {
    return std::any_of(loop.poses.begin(), loop.poses.end(), [&](const Pose& p) { return stock_.meets(cutter_, p); });
  }
  /// How far a place of the tool moves, mm, at most.
  [[nodiscard]] double moved(const Pose& from, const Pose& to) const {
    const Vec3 tip = to.tip - from.tip, axis = to.axis - from.axis;
    return std::max(tip.norm(), (tip + cutter_.length() * axis).norm());
  }
  /// From the end of the last loop, where that is near: in steps as those of a loop.
  void go_on(const Strip& strip, Loop& loop) const {
    if (strip.poses.empty()) return;
    const Pose from = strip.poses.back(), to = loop.poses.front();
    const double far = moved(from, to);
    if (far > kJumpShare * cutter_.tip()) return;
    const int steps = std::max(1, static_cast<int>(std::ceil(far / (limits_.apart_share * cutter_.tip()))));
    std::vector<Pose> way;
    for (int k = 0; k < steps; ++k) way.push_back(pose_between(from, to, static_cast<double>(k) / steps));
    loop.shares.insert(loop.shares.begin(), way.size(), loop.shares.front());
    loop.poses.insert(loop.poses.begin(), way.begin(), way.end());
  }
  void add(const std::vector<Pose>& loop, Strip& strip, std::vector<Strip>& out) {
    stock_.cut(cutter_, loop);
    if (!strip.poses.empty() && moved(strip.poses.back(), loop.front()) > kStillMm) end(strip, out);
    strip.poses.insert(strip.poses.end(), loop.begin() + (strip.poses.empty() ? 0 : 1), loop.end());
  }
  /// The next loop, with as long a step as its engagement allows; where none is short enough it is not as wide. None where a narrow one
  /// engages too much, too.
  [[nodiscard]] std::optional<Loop> fitting(double place, const Strip& strip, double& step) {
    const double least = limits_.least_step_share * cutter_.tip();
    while (high_ - low_ > kNarrowestShare) {
      Loop loop = loop_at(place + step);
      go_on(strip, loop);
      const auto [in, most] = engagement(loop);
      const bool engages = in > limits_.planned_share * limits_.most_engagement_rad;
      loop.cuts = !engages && cuts(loop);
      const std::optional<double> blocked = loop.cuts ? blocked_at(loop) : std::nullopt;
      if (!engages && !blocked) return loop;
      const double at = blocked.value_or(most);
      if (engages && step > least)
        step = std::max(least, kShorter * step);
      else if (at < 0.5 * (low_ + high_))
        low_ += kNarrowShare * share_of(place);
      else
        high_ -= kNarrowShare * share_of(place);
    }
    return {};
  }
  void widen(double place, double step) {
    const double more = kWidenShare * step / cutter_.tip() * share_of(place);
    low_ = std::max(0.0, low_ - more), high_ = std::min(1.0, high_ + more);
  }
  /// Of the tip's radius, across the channel.
  [[nodiscard]] double share_of(double place) const { return cutter_.tip() / layer_.width(on(place)); }
  /// A way that counts from where it begins.
  [[nodiscard]] double on(double place) const { return forward_ ? place : layer_.length() - place; }
  /// Its front half is ahead by `place` from where the stretch begins, at most.
  [[nodiscard]] Loop loop_at(double place) const {
    const double r = cutter_.tip(), width = (high_ - low_) * layer_.width(on(place)),
                 deep = std::min(0.5 * width, std::sqrt(0.5 * width * kBendShare * r)), back = kBackShare * deep;
    const int count = std::max(kFewest, static_cast<int>(std::ceil((width + deep) / (limits_.apart_share * r))));
    Loop out;
    for (const bool front : {true, false})
      for (int k = front ? 0 : 1; k <= count - (front ? 0 : 1); ++k) {
        const double angle = std::numbers::pi * k / count,
                     ahead = place - deep + (front ? deep : -back) * std::sin(angle);
        const double over = 0.5 * (1.0 - std::cos(angle));
        out.shares.push_back(std::lerp(low_, high_, front == from_first_ ? over : 1.0 - over));
        out.poses.push_back(layer_.at(on(ahead), out.shares.back()));
      }
    return out;
  }
  /// Radians, the most of it, and at which share across.
  [[nodiscard]] std::pair<double, double> engagement(const Loop& loop) const {
    std::vector<double> all(loop.poses.size(), 0.0);
    parallel_for(all.size() - 1,
                 [&](std::size_t k) { all[k + 1] = stock_.engagement(cutter_, loop.poses[k], loop.poses[k + 1]); });
    const auto most = std::max_element(all.begin(), all.end());
    return {*most, loop.shares[static_cast<std::size_t>(most - all.begin())]};
  }

  /// At which share across, first, the tool may not go on.
  [[nodiscard]] std::optional<double> blocked_at(const Loop& loop) const {
    std::vector<char> free(loop.poses.size(), 1);
    parallel_for(free.size() - 1,
                 [&](std::size_t k) { free[k + 1] = limits_.is_free(loop.poses[k], loop.poses[k + 1]) ? 1 : 0; });
    const auto first = std::find(free.begin(), free.end(), 0);
    if (first == free.end()) return {};
    return loop.shares[static_cast<std::size_t>(first - free.begin())];
  }

  const ChannelLayer& layer_;
  const Cutter& cutter_;
  const CycleLimits& limits_;
  StockGrid& stock_;
  bool forward_, from_first_;
  double low_ = 0.0, high_ = 1.0;  ///< shares across between which the next loop goes
};

}  // namespace

std::vector<Strip> layer_cycles(const ChannelLayer& layer, const Cutter& cutter, const CycleLimits& limits,
                                const std::string& face, StockGrid& stock) {
  std::vector<Strip> out;
  const Strip strip{.id = 1, .kind = "rough", .face = face, .poses = {}};
  const bool forward = layer.open_before() || !layer.open_behind();
  // What the one way leaves, material with no way in, the other one may come at.
  for (const bool way : {forward, !forward})
    if (Clearing(layer, cutter, limits, way, stock).run(strip, out)) break;
  return out;
}

double loop_length(const Cutter& cutter) { return 2.0 * kOverShare * cutter.tip(); }

}  // namespace flank::internal
