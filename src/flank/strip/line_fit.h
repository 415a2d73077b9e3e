/// REFINE (MATH section 8): the line near a given one along which the tool touches the target best, in the sense of the
/// largest error.
///
/// A line is a pose of the axis. Its errors e_j = d(l(s_j)) - r(s_j) are sampled at equal steps of s; to first order
/// they are linear in five coordinates (a rigid axis has no more: turning about itself changes nothing), so each step
/// is a linear minimax problem in five unknowns.
#pragma once

#include <span>
#include <vector>

#include "flank/radial_function.h"
#include "flank/target.h"
#include "flank/vec.h"

namespace flank::internal {

struct LineFitOptions {
  /// > 0. What errors are weighed against: where least squares is good enough, how firmly the line is held, when to
  /// stop.
  double tolerance_mm = 0.01;
  /// Axis points s_j = L j / (samples - 1), >= 2. 17 see what a line needs while it is searched; certificates take 81,
  /// as surfaces may ripple at their borders. The time is proportional to it.
  int samples = 17;
  int steps = 8;  ///< most steps of Gauss-Newton, >= 0; each asks for the footpoints of all samples once
  /// Moving an end by a quarter of the axis weighs like an error of this share of the tolerance everywhere: it decides
  /// what the target leaves open (the slide of a cylinder) and hardly moves what it does not. > 0, or a cylinder on a
  /// plane has no unique line; towards 1 the line is held rather than fitted.
  double stay_share = 0.1;
};

/// What a correction may not change, and what it is to stay near.
struct LineHold {
  Vec3 travel = Vec3::Zero();  ///< direction in which the middle of the axis must not move, any length; zero: free
  double slide_share = 0.0;    ///< as stay_share, for the slide along the axis alone, >= 0; 0: as the others
  double stay_share = 0.0;     ///< instead of the options', >= 0; 0: the options'
};

/// A line and how well the tool touches there: e_j = d(l(s_j)) - r(s_j), mm, positive if material is left.
struct LineFit {
  Pose pose;
  double largest_mm = 1e300;  ///< |e_j| over the samples whose footpoint is inside the target; 1e300: there is none
  double inside_share = 0.0;  ///< share of the samples whose footpoint is inside, in [0, 1]
  [[nodiscard]] bool touches() const { return inside_share > 0.0; }
};

using Vec5 = Eigen::Matrix<double, 5, 1>;

/// Coordinates of a small motion of the axis, all in mm at its ends: shift along e1, e2 and the axis u, turn by e1, e2.
struct LineFrame {
  Vec3 e1 = Vec3::UnitX(), e2 = Vec3::UnitY(), u = Vec3::UnitZ();
};
/// The frame of a pose, right-handed, e1 along the part of `travel` across the axis (any direction if there is none).
[[nodiscard]] LineFrame line_frame(const Pose& pose, const Vec3& travel);
/// The pose moved by coordinates of the frame: shifts x[0..2] of the middle, turns x[3..4] about it, as mm at the ends.
/// The axis keeps its unit length; the error of a turn is of third order in x / L.
[[nodiscard]] Pose moved_line(const Pose& pose, double axis_length, const LineFrame& frame, const Vec5& x);
/// dd/dx of the distance of the axis point s at x = 0; `normal` is its footpoint's, rho = 2 s / L - 1.
[[nodiscard]] Vec5 distance_row(const LineFrame& frame, const Vec3& normal, double rho);

/// Fits lines one after another. Not thread-safe: one per thread. `target` and `radial` are those of the constructor,
/// of which `target` must outlive it.
///
/// The fitter has one piece of state, the *current line*: the footpoints and errors of the line measured last. The
/// contract:
/// - measure(pose) and refine(start) set it: afterwards it is the pose of the LineFit that they return.
/// - They start from the footpoints of the line before, as hints. A hint from far away may lead to another branch of
///   the target, so call forget() before a line that is not near the last one; set_feet() puts saved hints back.
/// - overcut, inside_overcut, deep_points and lift read the current line. Those that take a pose take *its* pose: the
///   fitter does not store it, and another pose gives nonsense without a warning.
/// - forget() and set_feet() leave no current line: measure before you ask.
class LineFitter {
 public:
  LineFitter(const Target& target, const RadialFunction& radial, const LineFitOptions& options);

  /// Drops the footpoints: the next call searches for them over the whole target.
  void forget();
  /// Uses the footpoints of a nearby line as starting hints. Exactly options().samples of them.
  void set_feet(std::span<const Footpoint> feet);
  /// Footpoints of the current line, one per sample; may be of the extension. Valid until the next call that sets them.
  [[nodiscard]] std::span<const Footpoint> feet() const { return feet_; }

  /// Errors of a line, which becomes the current one. Footpoints are local: on the branch of the hints.
  [[nodiscard]] LineFit measure(const Pose& pose);
  /// Gauss-Newton on the five coordinates of a line; each step solves the linearised minimax problem by Lawson's
  /// weights if the errors come near the tolerance, else least squares. The result is the current line. Its largest
  /// error is smaller than that of `start`, with one exception: the first step is taken even if it is worse, up to
  /// twice the error and a tolerance, because the error counts only samples inside, and a step that brings more of the
  /// axis over the target may look worse. Returns `start` if no sample of it lies over the inside of the target.
  [[nodiscard]] LineFit refine(const Pose& start, const LineHold& hold = {});
  /// Largest r(s_j) - d of the current line, mm, d the distance to the trimmed target itself: past its border too,
  /// where errors on the extension say nothing about it. Returns `least_mm` if nothing is deeper: the greater that is,
  /// the faster.
  [[nodiscard]] double overcut(const Pose& pose, double least_mm = -1e300) const;

  /// Largest r(s_j) - d of the current line over the samples inside the target alone: cheap. -1e300 if there is none.
  [[nodiscard]] double inside_overcut() const;
  /// Appends, for each sample of the current line that is deeper than `depth_mm` in the trimmed target, its footpoint.
  void deep_points(const Pose& pose, double depth_mm, std::vector<Vec3>& points) const;

  /// Shifts of the tip and of the holder end, mm, that would take the current line out of the trimmed target where it
  /// is deeper than `depth_mm`; zero if it is not. Each deep sample lifts the end that it is nearer to; the other end
  /// is its hinge.
  struct Lift {
    Vec3 tip = Vec3::Zero(), holder = Vec3::Zero();
  };
  [[nodiscard]] Lift lift(const Pose& pose, double depth_mm) const;

  [[nodiscard]] const Target& target() const { return target_; }
  [[nodiscard]] double axis_length() const { return length_; }
  [[nodiscard]] const LineFitOptions& options() const { return options_; }

 private:
  /// Footpoint of sample j on the trimmed target; patch -1 if the sample is less deep than depth_mm.
  [[nodiscard]] Footpoint trimmed_foot(const Pose& pose, std::size_t j, double depth_mm) const;
  [[nodiscard]] double depth(const Footpoint& foot, std::size_t j) const;  ///< r(s_j) - d, mm
  void linearise(const LineFrame& frame);
  [[nodiscard]] Vec5 solve(const Vec5& stay, const Vec5& offset, double damping) const;
  [[nodiscard]] Vec5 best_step(const Vec5& stay, const Vec5& offset, double damping);
  [[nodiscard]] Vec5 limited_step(const Vec5& stay, const Vec5& offset);
  void load_weights();

  const Target& target_;
  double length_;
  LineFitOptions options_;
  std::vector<double> s_, radius_;           // s_j and r(s_j)
  std::vector<Footpoint> feet_, best_feet_;  // of the current line; of the best line of a refinement
  std::vector<Vec5> rows_;                   // de_j/dx
  std::vector<double> errors_, weights_, base_weights_;
};

}  // namespace flank::internal
