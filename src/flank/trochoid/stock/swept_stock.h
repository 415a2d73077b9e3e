/// The material of a cavity while it is cleared: a blank, less what the tool has swept so far (MATH section 10).
///
/// A sweep is kept as the poses of its motion and their velocities, between which it is interpolated by cubics: for rails
/// that are cubic splines whose knots are among the poses, exactly.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "flank/path.h"
#include "flank/path/half_space.h"
#include "flank/ruled_motion.h"
#include "flank/trochoid/stock/tool_profile.h"

namespace flank::internal {

/// Axis of one time: tip, direction (not unit) and their derivatives by the place in the sweep (an interval is 1).
struct SweepPose {
  Vec3 tip, direction;
  Vec3 tip_d1, direction_d1;
};

/// The poses of one motion in the order of time.
struct Sweep {
  std::vector<SweepPose> poses;
  std::vector<Pose> axes;  ///< the same with unit axes, for quick looks
  /// The same, each coordinate in an array of its own: x, y, z of the tips, then of the axes; the last pose is repeated up to
  /// a multiple of kChunk.
  std::array<std::vector<double>, 6> lanes;
  [[nodiscard]] std::array<const double*, 6> lanes_at(std::size_t pose) const;
  /// The same of every kRough-th pose, for a first look.
  std::array<std::vector<double>, 6> rough_lanes;
  static constexpr std::size_t kRough = 4;
  /// Of kChunk intervals each: middle of the axes, and how far any middle is from it, mm.
  struct Chunk {
    Vec3 middle;
    double reach = 0.0;
    Pose pose = {};
    double spread = 0.0;  ///< how far any end of its axes is from that of this pose, mm
  };
  static constexpr int kChunk = 8;
  std::vector<Chunk> chunks;
  Chunk whole;        ///< of all of them
  double turn = 0.0;  ///< most that any axis differs from the first
  double axis_length = 0.0;

  /// The motion over [0, 1] at `intervals` (>= 1) equal steps. A multiple of the rails' knot spans is exact.
  [[nodiscard]] static Sweep of(const RuledMotion& motion, int intervals);
  /// Poses joined straight (path.h).
  [[nodiscard]] static Sweep of(const std::vector<Pose>& poses, double axis_length);
  [[nodiscard]] double last() const { return static_cast<double>(poses.size()) - 1.0; }
  /// The pose at a place in [0, last()].
  [[nodiscard]] SweepPose at(double place) const;

 private:
  void make_chunks();
  void make_lanes();
};

/// What is left of a blank. Sweeps are added in the order of machining; reading is for many threads at once.
class SweptStock {
 public:
  /// Material is what lies in all half spaces: the ends and the top of the blank. None: everywhere.
  SweptStock(const RadialFunction& radial, std::vector<HalfSpace> blank);

  void add(Sweep sweep) { sweeps_.push_back(std::move(sweep)); }
  void remove_last() { sweeps_.pop_back(); }

  [[nodiscard]] const std::vector<Sweep>& sweeps() const { return sweeps_; }
  [[nodiscard]] const std::vector<HalfSpace>& blank() const { return blank_; }
  [[nodiscard]] const ToolProfile& profile() const { return profile_; }
  [[nodiscard]] const RadialFunction& radial() const { return radial_; }

  /// phi: least, over all sweeps and their times, of the distance of x to the axis less the tool's radius at that height.
  /// Positive: no sweep has taken x. By dense search and Newton's method: slow, for tests and single questions.
  [[nodiscard]] double gap(const Vec3& x) const;
  /// In the blank and not yet swept.
  [[nodiscard]] bool is_material(const Vec3& x) const;

 private:
  RadialFunction radial_;
  ToolProfile profile_;
  std::vector<HalfSpace> blank_;
  std::vector<Sweep> sweeps_;
};

/// Distance of x to the axis less the tool's radius at its height, above and below the flank to the sphere of the round end, and the
/// derivatives by x and by the place in the sweep.
struct GapJet {
  double gap = std::numeric_limits<double>::infinity();
  double dt = 0.0;
  Vec3 gradient = Vec3::Zero();
};
[[nodiscard]] GapJet gap_at(const ToolProfile& profile, const SweepPose& pose, const Vec3& x);

/// The axis of a pose with its unit direction, for one that is asked several times.
struct SweepAxis {
  explicit SweepAxis(const SweepPose& pose);
  Vec3 tip, u;
  Vec3 tip_d1, u_d1;
};
[[nodiscard]] GapJet gap_at(const ToolProfile& profile, const SweepAxis& axis, const Vec3& x);

}  // namespace flank::internal
