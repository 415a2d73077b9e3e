/// What a face as cut is off from what was planned: from measured points to a smooth error over the face.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "flank/bspline_surface.h"
#include "flank/correct/measure/error_field.h"
#include "flank/target.h"

namespace flank::internal {

/// A small rigid move: turned about the middle of the face, then shifted.
struct RigidMove {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Vec3 middle = Vec3::Zero(), shift = Vec3::Zero();
  [[nodiscard]] Vec3 of(const Vec3& p) const { return middle + turn * (p - middle) + shift; }
  [[nodiscard]] double angle() const;  ///< radians
};

/// What each pass of the plan leaves at a point of the face, mm. Called from several threads at once.
using PlannedLeft = std::function<std::vector<double>(const Vec3&)>;

struct FaceErrorOptions {
  bool fit_datum = true;  ///< the points are moved onto the face as well as six degrees of freedom do it
  double limit_mm = 1.0;  ///< an error beyond it is taken as this large
  /// The least of it is what the plan leaves: no error of the machine. Empty: one pass that leaves nothing.
  PlannedLeft planned_mm;
  std::string file;  ///< for messages
};

struct FaceError {
  RigidMove move;                                       ///< of the points
  std::vector<MeasuredPoint> points;                    ///< those that count
  std::vector<int> outliers;                            ///< indices of points that do not, ascending
  int beside = 0;                                       ///< points that lie beside the face
  double rms_before_mm = 0.0, rms_after_mm = 0.0;       ///< of the error: as measured, after the move
  double planned_rms_mm = 0.0;                          ///< of what the plan leaves at the points that count
  double smooth_rms_mm = 0.0, smooth_largest_mm = 0.0;  ///< of the smooth error
  bool limited = false;                                 ///< the smooth error is beyond the limit somewhere
  ErrorField field;                                     ///< the smooth error
  double limit_mm = 0.0;
  /// The smooth error of a pass, mm, within the limit.
  [[nodiscard]] double of_pass(std::size_t pass, double u, double v) const;
  /// That of the cut, where the passes of the plan leave this; nothing: of one pass.
  [[nodiscard]] double at(double u, double v, const std::vector<double>& planned_mm = {}) const;
};

/// `face`: of the target, one patch. Throws InputError where the points are too few, belong to another face or another datum, or
/// leave a part of the face without any.
[[nodiscard]] FaceError face_error(const Target& target, const Face& face, const std::vector<Vec3>& points,
                                   const FaceErrorOptions& options);

/// The face, moved against its error: what has to be aimed at so that the nominal face is cut. `side`: +1 where the machined side is
/// that of Su x Sv, else -1. `planned_mm`: what the error was measured with.
[[nodiscard]] Face mirrored_face(const Face& face, const FaceError& error, int side,
                                 const PlannedLeft& planned_mm = {});

}  // namespace flank::internal
