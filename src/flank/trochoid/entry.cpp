#include "flank/trochoid/entry.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "flank/base/tolerance_budget.h"
#include "flank/trochoid/cycle_shape.h"
#include "flank/trochoid/entry/entry_slot.h"

namespace flank::internal {
namespace {

/// Rows of a move, rings of the flank and of each round end.
constexpr int kMoveRows = 34, kMoveRings = 21, kMoveVolumeRings = 21;
/// Poses that a move has in the stock: one span of a rail needs any number, several need what a half has.
int intervals_of(const RuledMotion& move) {
  constexpr int kOneSpan = 16;
  return move.tip.count() > move.tip.degree + 1 ? kHalfIntervals : kOneSpan;
}
/// Width of a plunge beside the one before, of the least radius of the flank.
constexpr double kPlungeWidth = 0.5;
/// More passes than this are no ramp: the sides are too near to each other.
constexpr int kMostPasses = 2001;
constexpr int kLookTimes = 25, kLookPlaces = 9;
/// Deeper than at the ends of the sides by this share counts as deeper.
constexpr double kDeeper = 1.1;

/// A slot that is free, and the part of it in which the tool moves above full depth.
struct OpenSlot {
  EntrySlot slot;
  double from_x = 0.0, to_x = 0.0;
  HalfShape front;     ///< of the first front
  double inset = 0.0;  ///< of `along`, at both ends
  double top_mm = 0.0, entered_mm = 0.0;
};

class EntryPlanner {
 public:
  EntryPlanner(const LayerSides& sides, const HalfGuard& guard, SweptStock& stock, const ClearPlane& clear,
               const CycleOptions& cycles)
      : sides_(sides),
        guard_(guard),
        stock_(stock),
        clear_(clear),
        allowed_(kToleranceBudget.cavity.halves * cycles.tolerance_mm),
        radius_(stock.profile().largest()),
        widening_((1.0 - std::cos(cycles.largest_rad)) * stock.radial().smallest()),
        meter_(stock),
        rings_(stock.radial(), kMoveRings, kMoveVolumeRings) {}

  [[nodiscard]] std::optional<OpenSlot> find_slot(const Progress& progress);
  [[nodiscard]] std::vector<RuledMotion> ramp(const OpenSlot& open, double slope_rad, Entry& entry) const;
  [[nodiscard]] std::vector<RuledMotion> plunges(const OpenSlot& open, Entry& entry) const;
  /// Passes to and fro at full depth that make the front of the slot, and that front.
  [[nodiscard]] FirstFront widen(const OpenSlot& open, std::vector<RuledMotion>& moves) const;
  /// Cuts by all moves.
  void take(Entry& entry);

 private:
  /// The slot, if it is free, with all but the place of its ends.
  [[nodiscard]] std::optional<OpenSlot> opened(const EntrySlot& slot);
  /// A front from there that enters nothing deeper than allowed.
  [[nodiscard]] std::optional<HalfShape> front_of(const AxisPlace& from, const AxisPlace& to, double allowed) const;
  [[nodiscard]] double allowed_at(const EntrySlot& slot) const;
  /// The least height from which on nothing is cut over the slot; none if the tool does not get out upwards.
  [[nodiscard]] std::optional<double> top_of(const EntrySlot& slot);
  [[nodiscard]] bool cuts_at(const EntrySlot& slot, double height_mm);
  /// Deepest that the tool enters a face above the slot, within the inset.
  [[nodiscard]] double entered_above(const EntrySlot& slot, double inset, double top_mm) const;
  /// At full depth from `along` to the second side, and back to the first.
  static void finish(const EntrySlot& slot, double along, std::vector<RuledMotion>& moves);

  const LayerSides& sides_;
  const HalfGuard& guard_;
  SweptStock& stock_;
  const ClearPlane& clear_;
  double allowed_, radius_;
  double widening_;  ///< by a pass at full depth, mm: in the middle of its way it engages no more than a cycle
  EngagementMeter meter_;
  RowRings rings_;
};

Pose axis_at(const AxisPlace& place) { return {place.tip, place.u}; }

std::optional<OpenSlot> EntryPlanner::find_slot(const Progress& progress) {
  constexpr double kOn = 0.1, kMost = 0.5;  // radii, and of the side
  const double middle = 0.5 * sides_.from.axis_length();
  for (double x = 0.0; x <= kMost * sides_.from.length() && !progress.stop(); x += kOn * radius_) {
    const double y = x * sides_.to.length() / sides_.from.length();
    const AxisPlace from = sides_.from.at(x), to = sides_.to.at(y);
    const double gap = (to.at(middle) - from.at(middle)).norm();
    const Vec3 forward = (from.velocity(middle) + to.velocity(middle)).normalized();
    for (const double bulge : {0.0, 0.04, 0.08, 0.15, 0.25}) {
      const EntrySlot slot{axis_at(from), axis_at(to), bulge * gap * forward, sides_.from.axis_length()};
      const std::optional<HalfShape> front = front_of(from, to.reversed(), allowed_at(slot));
      std::optional<OpenSlot> open = front ? opened(slot) : std::nullopt;
      if (!open) continue;
      open->from_x = x, open->to_x = y;
      open->front = *front;
      return open;
    }
  }
  return {};
}

double EntryPlanner::allowed_at(const EntrySlot& slot) const {
  GuardDepth ends;
  for (const Pose& pose : {slot.from, slot.to}) guard_.look(pose, kLookPlaces, ends);
  return std::max(allowed_, kDeeper * ends.deepest());
}

std::optional<HalfShape> EntryPlanner::front_of(const AxisPlace& from, const AxisPlace& to, double allowed) const {
  const double length = sides_.from.axis_length(), gap = (to.at(0.5 * length) - from.at(0.5 * length)).norm();
  for (const double scale : {1.0, 0.6, 0.3}) {
    const HalfShape shape = CycleShape{}.front.of(scale * gap, 0.0);
    if (guard_.depth(half_path(length, from, to, shape), kLookTimes, kLookPlaces).deepest() <= allowed) return shape;
  }
  return {};
}

std::optional<OpenSlot> EntryPlanner::opened(const EntrySlot& slot) {
  const double allowed = allowed_at(slot);
  OpenSlot open;
  open.slot = slot;
  open.entered_mm = guard_.depth(slot.move({0.0, 0.0}, {1.0, 0.0}), kLookTimes, kLookPlaces).deepest();
  if (open.entered_mm > allowed) return {};
  const std::optional<double> top = top_of(slot);
  if (!top) return {};
  open.top_mm = *top;
  // Where walls are hollow the tool's belly has no room beside them once it is drawn back.
  for (const double inset : {0.0, 0.03, 0.06, 0.1, 0.15, 0.2, 0.27, 0.35}) {
    const double above = entered_above(slot, inset, *top);
    if (above > allowed) continue;
    open.inset = inset;
    open.entered_mm = std::max(open.entered_mm, above);
    return open;
  }
  return {};
}

bool EntryPlanner::cuts_at(const EntrySlot& slot, double height_mm) {
  const Engagement e = meter_.measure(slot.move({0.0, height_mm}, {1.0, height_mm}), rings_, kMoveRows);
  return e.peak.angle_rad > 0.0 || e.volume_mm3 > 0.0;
}

std::optional<double> EntryPlanner::top_of(const EntrySlot& slot) {
  constexpr double kLeastRise = 0.2, kStep = 0.25;  // radii
  constexpr int kHalvings = 5;
  double high = 0.0;
  for (const Pose& pose : {slot.from, slot.to}) {
    const double rise = clear_.top.dot(pose.axis);
    if (rise < kLeastRise) return {};
    high = std::max(high, (clear_.height - clear_.top.dot(pose.tip)) / rise);
  }
  // From above, so that nothing is left over the height that is found.
  double low = high;
  while (low > 0.0 && !cuts_at(slot, low)) {
    high = low;
    low -= kStep * radius_;
  }
  low = std::max(low, 0.0);
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    (cuts_at(slot, middle) ? low : high) = middle;
  }
  return high;
}

double EntryPlanner::entered_above(const EntrySlot& slot, double inset, double top_mm) const {
  constexpr double kApart = 0.2;  // radii
  const int steps = std::max(1, static_cast<int>(std::ceil(top_mm / (kApart * radius_))));
  GuardDepth depth;
  for (int k = 0; k <= steps; ++k)
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0})
      guard_.look(slot.pose({std::lerp(inset, 1.0 - inset, share), top_mm * k / steps}), kLookPlaces, depth);
  return depth.deepest();
}

void EntryPlanner::finish(const EntrySlot& slot, double along, std::vector<RuledMotion>& moves) {
  if (along < 1.0) moves.push_back(slot.move({along, 0.0}, {1.0, 0.0}));
  moves.push_back(slot.move({1.0, 0.0}, {0.0, 0.0}));
}

std::vector<RuledMotion> EntryPlanner::ramp(const OpenSlot& open, double slope_rad, Entry& entry) const {
  const double way = (1.0 - 2.0 * open.inset) * open.slot.least_way(open.top_mm);
  const double passes = std::max(1.0, std::ceil(open.top_mm / (std::tan(slope_rad) * way)));
  if (!(passes < kMostPasses)) return {};
  // An odd number: the last one ends beside the second side.
  const int count = static_cast<int>(passes) | 1;
  const double sink = open.top_mm / count;
  entry.slope_rad = std::atan2(sink, way);
  entry.depth_mm = sink;
  const auto place = [&](int k) {
    return SlotPlace{k % 2 == 0 ? open.inset : 1.0 - open.inset, open.top_mm * (count - k) / count};
  };
  std::vector<RuledMotion> moves;
  for (int k = 0; k < count; ++k) moves.push_back(open.slot.move(place(k), place(k + 1)));
  finish(open.slot, 1.0 - open.inset, moves);
  return moves;
}

std::vector<RuledMotion> EntryPlanner::plunges(const OpenSlot& open, Entry& entry) const {
  const EntrySlot& slot = open.slot;
  const double length = slot.axis_length, top = open.top_mm, inner = 1.0 - 2.0 * open.inset;
  double way = 4.0 * slot.bulge.norm();
  for (const double s : {0.0, length, length + top})
    way = std::max(way, (slot.to.at(s) - slot.from.at(s)).norm() + 4.0 * slot.bulge.norm());
  const int steps = std::max(1, static_cast<int>(std::ceil(inner * way / (kPlungeWidth * stock_.radial().smallest()))));
  entry.depth_mm = top;
  entry.width_mm = inner * way / steps;
  std::vector<RuledMotion> moves;
  for (int k = 0; k <= steps; ++k) {
    const double along = open.inset + inner * k / steps;
    if (k > 0) {
      const double before = open.inset + inner * (k - 1) / steps;
      moves.push_back(slot.move({before, 0.0}, {before, top}));
      moves.push_back(slot.move({before, top}, {along, top}));
    }
    moves.push_back(slot.move({along, top}, {along, 0.0}));
  }
  finish(slot, 1.0 - open.inset, moves);
  return moves;
}

FirstFront EntryPlanner::widen(const OpenSlot& open, std::vector<RuledMotion>& moves) const {
  const AxisPlace from = sides_.from.at(open.from_x), to = sides_.to.at(open.to_x).reversed();
  const double length = sides_.from.axis_length();
  FirstFront front{open.from_x, open.to_x, half_path(length, from, to, open.front)};
  const int passes = std::max(1, static_cast<int>(std::ceil(reach_ahead(front.motion, from, to) / widening_)));
  for (int k = 1; k <= passes; ++k) {
    const double share = static_cast<double>(k) / passes;
    const RuledMotion pass = k < passes ? half_path_across(length, from, to, open.front, share, share) : front.motion;
    moves.push_back(pass);
    moves.push_back(SidePath(pass, true).motion());
  }
  // Once more, for what the tool's bending left, and to where the first back begins.
  moves.push_back(front.motion);
  return front;
}

void EntryPlanner::take(Entry& entry) {
  for (const RuledMotion& move : entry.moves) {
    const Engagement e = meter_.measure(move, rings_, kMoveRows);
    entry.largest_rad = std::max(entry.largest_rad, e.peak.angle_rad);
    entry.volume_mm3 += e.volume_mm3;
    entry.way_mm += way_of_middle(move);
    if (e.volume_mm3 > 0.0) stock_.add(Sweep::of(move, intervals_of(move)));
  }
}

}  // namespace

std::optional<Entry> plan_entry(const LayerSides& sides, const HalfGuard& guard, SweptStock& stock,
                                const ClearPlane& clear, const EntryOptions& options, const CycleOptions& cycles,
                                const Progress& progress) {
  EntryPlanner planner(sides, guard, stock, clear, cycles);
  const std::optional<OpenSlot> open = planner.find_slot(progress);
  if (!open) return {};
  Entry entry;
  entry.method = options.method == EntryMethod::kPlunge ? EntryMethod::kPlunge : EntryMethod::kRamp;
  entry.moves = entry.method == EntryMethod::kPlunge ? planner.plunges(*open, entry)
                                                     : planner.ramp(*open, options.slope_rad, entry);
  if (entry.moves.empty()) return {};
  entry.front = planner.widen(*open, entry.moves);
  entry.entered_mm = open->entered_mm;
  planner.take(entry);
  return entry;
}

}  // namespace flank::internal
