/// The gaps of a ring's front, and what is cut off them: by an interval, or by a tool that leans against the ring.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "flank/trochoid/engagement/near_poses.h"
#include "flank/trochoid/engagement/pose_filter.h"
#include "flank/trochoid/engagement/ring_group.h"

namespace flank::internal {

/// What ends a gap: one of the candidates, or else the blank or the front's own end.
struct GapBound {
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::size_t candidate = kNone;
  double shift = 0.0;  ///< of intervals, from its pose
  [[nodiscard]] bool is_pose() const { return candidate != kNone; }
};

/// A stretch of a ring's front that no pose seen so far covers. It goes a little beyond where the front or the blank ends: what a
/// sweep covers between two poses may begin there.
struct FrontGap {
  double low, high;  ///< radians from the direction of motion
  GapBound at_low, at_high;
  Vec2 from, to;    ///< unit vectors of low and high
  Arc limits = {};  ///< of the front in the blank
  [[nodiscard]] Arc within() const { return {std::max(low, limits.low), std::min(high, limits.high)}; }
  [[nodiscard]] bool is_some() const { return within().high > within().low; }
};

/// Takes an interval out of gaps, also a turn farther; whether that changed any. `scratch` is the caller's memory.
[[nodiscard]] bool cut_gaps(std::vector<FrontGap>& gaps, std::vector<FrontGap>& scratch, double low, double high,
                            const GapBound& bound);

/// Gaps that end where the front or the blank does go on a little beyond.
void go_beyond(std::vector<FrontGap>& gaps);

/// The gaps of a ring on its circle, in the frame of its row, into `out`. `motion`: the direction that they are measured from.
void open_arcs(const std::vector<FrontGap>& gaps, double radius, const Vec2& motion, std::vector<OpenArc>& out);

/// A disc in the plane of a ring: its centre from the direction of motion, and its radius; not > 0: it is none.
struct RingDisc {
  Vec2 centre;
  double radius;
};

/// A tool that leans against the axis of a ring, in the plane of the ring. What it covers there is not quite a circle, and near
/// its round ends not at all one.
struct LeaningTool {
  const ToolProfile& profile;
  double ring;      ///< radius, mm
  Vec2 foot, lean;  ///< where its axis meets the plane, and the part of its direction in the plane
  double height;    ///< its own, there
  double reach2;    ///< nothing is covered farther from the foot, mm^2
  [[nodiscard]] bool covers(double angle) const {
    const Vec2 from = Vec2(ring * std::cos(angle), ring * std::sin(angle)) - foot;
    if (from.squaredNorm() > reach2) return false;
    const double along = lean.dot(from);
    ToolProfile::Place place;
    return profile.at(height + along, place) && from.squaredNorm() - along * along <= place.radius * place.radius;
  }
  /// Half of the least arc about the foot's direction that holds all that may be covered; negative: nothing is.
  [[nodiscard]] double window() const {
    const double middle = height - lean.dot(foot), swing = ring * lean.norm();
    if (middle + swing < profile.low() || middle - swing > profile.high()) return -1.0;
    const double d = foot.norm(), reach = std::sqrt(reach2);
    if (d >= ring + reach || ring >= reach + d) return -1.0;
    return reach >= ring + d ? std::numbers::pi : std::acos((ring * ring + d * d - reach * reach) / (2.0 * ring * d));
  }
  /// Angles at which it is looked at, about `at`: so what is covered does not hang on what was asked for.
  struct Looks {
    double at, window;
    int count;
    [[nodiscard]] double step() const { return 2.0 * window / count; }
    [[nodiscard]] double angle(int k) const { return at + (k * step() - window); }
  };
  /// Calls visit(low, high) for what is covered of the window as far as it lies between two angles, or a look farther.
  template <class Visit>
  void visit_covered(const Looks& looks, double low, double high, const Visit& visit) const {
    const double from = low - looks.at + looks.window, to = high - looks.at + looks.window;
    if (to <= 0.0 || from >= 2.0 * looks.window) return;
    const int first = std::max(0, static_cast<int>(from / looks.step()));
    const int last = std::min(looks.count, static_cast<int>(to / looks.step()) + 1);
    double begin = looks.angle(first);
    bool before = covers(begin);
    for (int k = first + 1; k <= last; ++k) {
      const bool now = covers(looks.angle(k));
      if (now && !before) begin = edge(looks.angle(k), looks.angle(k - 1));
      if (!now && before) visit(begin, edge(looks.angle(k - 1), looks.angle(k)));
      before = now;
    }
    if (before) visit(begin, looks.angle(last));
  }
  /// Between an angle that is covered and one that is not: how far it is.
  [[nodiscard]] double edge(double inside, double outside) const {
    constexpr int kHalvings = 3;  // the ends of arcs are found exactly afterwards
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (inside + outside);
      (covers(middle) ? inside : outside) = middle;
    }
    return inside;
  }
};

}  // namespace flank::internal
