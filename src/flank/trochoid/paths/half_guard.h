/// How deep a half path goes into the sides, the floor and whatever else must not be entered.
#pragma once

#include <algorithm>
#include <vector>

#include "flank/obstacle_field.h"
#include "flank/radial_function.h"
#include "flank/ruled_motion.h"
#include "flank/target.h"

namespace flank::internal {

/// Not owned; they outlive the guard.
struct GuardedFaces {
  std::vector<const Target*> sides;
  std::vector<const ObstacleField*> others;  ///< may hold null
};

/// Depths at sampled places of a motion, mm.
struct GuardDepth {
  double sides = 0.0;   ///< deepest in a side, >= 0
  double others = 0.0;  ///< in another face
  double tip = 0.0;     ///< of those, what the lower half of the axis enters: lifting the tool helps
  [[nodiscard]] double deepest() const { return std::max(sides, others); }
  void add(const GuardDepth& more) {
    sides = std::max(sides, more.sides);
    others = std::max(others, more.others);
    tip = std::max(tip, more.tip);
  }
};

class HalfGuard {
 public:
  HalfGuard(GuardedFaces faces, const RadialFunction& radial);
  /// The same, which sees no sides, and only what the lower half of the axis enters.
  [[nodiscard]] HalfGuard of_tips() const {
    HalfGuard out({{}, faces_.others}, radial_);
    out.tips_alone_ = true;
    return out;
  }
  /// Whether there is anything that it could see.
  [[nodiscard]] bool has_faces() const;
  /// At `times` x `places` samples, the times densest at both ends, and closer around those that are deeper than their
  /// neighbours, be they in a face or only near one; at more places where their balls would leave an edge between them unseen.
  /// A place that projects onto a side's border counts by its distance alone.
  [[nodiscard]] GuardDepth depth(const RuledMotion& motion, int times, int places) const;
  /// Adds what one pose enters.
  void look(const Pose& pose, int places, GuardDepth& out) const;

 private:
  struct Sample {
    GuardDepth depth;      ///< with its sign as far as `rise_mm` off a face
    double rise_mm = 0.0;  ///< no deeper than by this more lie the places up to half way to the next samples
  };
  [[nodiscard]] std::vector<Sample> samples(const RuledMotion& motion, int times, int places) const;
  /// Adds what is entered between the samples before and after one.
  void look_closer(const RuledMotion& motion, int times, int at, int places, GuardDepth& out) const;
  /// With depths below zero, as far as the flank sees.
  void look(const Pose& pose, int places, double sight_mm, GuardDepth& out) const;
  GuardedFaces faces_;
  RadialFunction radial_;
  int least_places_ = 2;
  bool tips_alone_ = false;
};

}  // namespace flank::internal
