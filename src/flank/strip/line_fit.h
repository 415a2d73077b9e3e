/// REFINE (MATH section 8): the line near a given one along which the tool touches the target best, in the sense of the
/// largest error.
#pragma once

#include <span>
#include <vector>

#include "flank/radial_function.h"
#include "flank/target.h"
#include "flank/vec.h"

namespace flank::internal {

struct LineFitOptions {
  double tolerance_mm = 0.01;
  int samples = 17;  ///< axis points s_j = L j / (samples - 1)
  int steps = 8;     ///< of Gauss-Newton; each has the footpoints of all samples once or twice
  /// Moving an end by a quarter of the axis weighs like an error of this share of the tolerance everywhere: it decides
  /// what the target leaves open (the slide of a cylinder) and hardly moves what it does not.
  double stay_share = 0.1;
};

/// What a correction may not change, and what it is to stay near.
struct LineHold {
  Vec3 travel = Vec3::Zero();  ///< the middle of the axis does not move this way; zero: free
  double slide_share = 0.0;    ///< as stay_share, for the slide along the axis alone; 0: stay_share
  double stay_share = 0.0;     ///< instead of the options'; 0: the options'
};

/// A line and how well the tool touches there: e_j = d(l(s_j)) - r(s_j), mm, positive where material is left.
struct LineFit {
  Pose pose;
  double largest_mm = 1e300;  ///< |e_j| over the samples whose footpoint is inside the target; 1e300: there is none
  double inside_share = 0.0;  ///< of the samples
  [[nodiscard]] bool touches() const { return inside_share > 0.0; }
};

using Vec5 = Eigen::Matrix<double, 5, 1>;

/// Coordinates of a small motion of the axis, all in mm at its ends: shift along e1, e2 and the axis u, turn by e1, e2.
struct LineFrame {
  Vec3 e1 = Vec3::UnitX(), e2 = Vec3::UnitY(), u = Vec3::UnitZ();
};
/// The frame of a pose, e1 along the part of `travel` across the axis (any, where there is none).
[[nodiscard]] LineFrame line_frame(const Pose& pose, const Vec3& travel);
/// The pose moved by coordinates of the frame.
[[nodiscard]] Pose moved_line(const Pose& pose, double axis_length, const LineFrame& frame, const Vec5& x);
/// dd/dx of the distance of the axis point s at x = 0; `normal` is its footpoint's, rho = 2 s / L - 1.
[[nodiscard]] Vec5 distance_row(const LineFrame& frame, const Vec3& normal, double rho);

/// Fits lines one after another; holds the scratch memory, so one per thread.
class LineFitter {
 public:
  LineFitter(const Target& target, const RadialFunction& radial, const LineFitOptions& options);

  /// Forgets the footpoints: the next call starts cold.
  void forget();
  /// Takes the footpoints of a line near by as hints.
  void set_feet(std::span<const Footpoint> feet);
  [[nodiscard]] std::span<const Footpoint> feet() const { return feet_; }

  /// Errors of a line; its footpoints are in feet() afterwards.
  [[nodiscard]] LineFit measure(const Pose& pose);
  /// Gauss-Newton on the five coordinates of a line; each step solves the linearised minimax problem by Lawson's
  /// weights where the errors come near the tolerance, else least squares. Never worse than `start`. Footpoints of the
  /// result are in feet().
  [[nodiscard]] LineFit refine(const Pose& start, const LineHold& hold = {});
  /// Largest r(s_j) - d of the line last measured, d the distance of the trimmed target itself: also of samples past its
  /// border, which errors on its extension say nothing about. `least_mm` if nothing is deeper: the greater, the faster.
  [[nodiscard]] double overcut(const Pose& pose, double least_mm = -1e300) const;

  /// The same over the samples inside the target alone: cheap.
  [[nodiscard]] double inside_overcut() const;
  /// Points of the trimmed target that the line last measured enters by more than `depth_mm`, one a sample, appended.
  void deep_points(const Pose& pose, double depth_mm, std::vector<Vec3>& points) const;

  /// Shifts of the tip and of the holder end that would take the line last measured out of the trimmed target where it is
  /// deeper than `depth_mm`. Each deep sample lifts the end that it is nearer to; the other end is its hinge.
  struct Lift {
    Vec3 tip = Vec3::Zero(), holder = Vec3::Zero();
  };
  [[nodiscard]] Lift lift(const Pose& pose, double depth_mm) const;

  [[nodiscard]] const Target& target() const { return target_; }
  [[nodiscard]] double axis_length() const { return length_; }
  [[nodiscard]] const LineFitOptions& options() const { return options_; }

 private:
  /// On the trimmed target; patch -1 where the sample is less deep than that.
  [[nodiscard]] Footpoint trimmed_foot(const Pose& pose, std::size_t j, double depth_mm) const;
  [[nodiscard]] double depth(const Footpoint& foot, std::size_t j) const;
  void linearise(const LineFrame& frame);
  [[nodiscard]] Vec5 solve(const Vec5& stay, const Vec5& offset, double damping) const;
  [[nodiscard]] Vec5 best_step(const Vec5& stay, const Vec5& offset, double damping);
  [[nodiscard]] Vec5 limited_step(const Vec5& stay, const Vec5& offset);
  void load_weights();

  const Target& target_;
  double length_;
  LineFitOptions options_;
  std::vector<double> s_, radius_;
  std::vector<Footpoint> feet_, best_feet_;
  std::vector<Vec5> rows_;
  std::vector<double> errors_, weights_, base_weights_;
};

}  // namespace flank::internal
