#include "flank/trochoid/cycle_guard.h"

#include <algorithm>

#include "flank/base/tolerance_budget.h"

namespace flank::internal {
namespace {

/// Where it is asked how deep a half enters faces: deepest are places just off the ends, where it leaves a side that runs on
/// past its face.
constexpr int kGuardTimes = 25, kGuardPlaces = 9;
/// Where it is asked how deep tips enter, again and again.
constexpr int kLiftTimes = 17, kLiftPlaces = 5;
/// Deeper than at the ends of a half by this share counts as deeper.
constexpr double kSpare = 1.1;

}  // namespace

const GuardDepth& CycleGuard::depth(Trial& trial) const {
  if (trial.depth) return *trial.depth;
  trial.depth = guard_.depth(trial.front, kGuardTimes, kGuardPlaces);
  if (trial.back) trial.depth->add(guard_.depth(*trial.back, kGuardTimes, kGuardPlaces));
  return *trial.depth;
}

GuardDepth CycleGuard::at_ends(const HalfGuard& guard, const Trial& trial, int places) const {
  GuardDepth out;
  for (const double t : {0.0, 1.0}) guard.look(trial.front.pose(t), places, out);
  return out;
}

bool CycleGuard::enters_anything(Trial& trial) const {
  // What the side paths enter of one kind of face allows nothing in another. Looked at as closely as a half is.
  const double allowed = kToleranceBudget.cavity.halves * tolerance_mm_;
  const GuardDepth &half = depth(trial), ends = at_ends(guard_, trial, 2 * kGuardPlaces - 1);
  return half.sides > std::max(allowed, ends.sides) || half.others > std::max(allowed, ends.others);
}

bool CycleGuard::enters_with_back(const Trial& trial) const {
  if (!trial.back) return false;
  GuardDepth ends = at_ends(guard_, trial, 2 * kGuardPlaces - 1);
  guard_.look(trial.back->pose(0.0), 2 * kGuardPlaces - 1, ends);
  const double allowed = kToleranceBudget.cavity.halves * tolerance_mm_;
  const GuardDepth back = guard_.depth(*trial.back, kGuardTimes, kGuardPlaces);
  return back.sides > std::max(allowed, ends.sides) || back.others > std::max(allowed, ends.others);
}

double CycleGuard::tips(const Trial& trial, int times, int places) const {
  if (!others_.has_faces()) return 0.0;
  const double front = others_.depth(trial.front, times, places).tip;
  return trial.back ? std::max(front, others_.depth(*trial.back, times, places).tip) : front;
}

double CycleGuard::depth_of_tips(const Trial& trial) const { return tips(trial, kGuardTimes, kGuardPlaces); }

double CycleGuard::allowed_at_tips(const Trial& trial) const {
  return std::max(kToleranceBudget.cavity.halves * tolerance_mm_, at_ends(others_, trial, 2 * kGuardPlaces - 1).tip);
}

double CycleGuard::coarse_depth_of_tips(const Trial& trial) const { return tips(trial, kLiftTimes, kLiftPlaces); }

double CycleGuard::aim_at_tips(const Trial& trial) const {
  return std::max(kToleranceBudget.cavity.aim * tolerance_mm_, kSpare * at_ends(others_, trial, kLiftPlaces).tip);
}

}  // namespace flank::internal
