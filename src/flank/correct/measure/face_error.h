/// What a face as cut is off from what was planned: from measured points to a smooth error over the face.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "flank/bspline_surface.h"
#include "flank/target.h"

namespace flank::internal {

/// A small rigid move: turned about the middle of the face, then shifted.
struct RigidMove {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Vec3 middle = Vec3::Zero(), shift = Vec3::Zero();
  [[nodiscard]] Vec3 of(const Vec3& p) const { return middle + turn * (p - middle) + shift; }
  [[nodiscard]] double angle() const;  ///< radians
};

struct FaceErrorOptions {
  bool fit_datum = true;  ///< the points are moved onto the face as well as six degrees of freedom do it
  double limit_mm = 1.0;  ///< an error beyond it is taken as this large
  /// What the plan leaves at a point of the face, mm: no error of the machine. Called from several threads at once. Empty: nothing.
  std::function<double(const Vec3&)> planned_mm;
  std::string file;  ///< for messages
};

/// A measured point on the face.
struct MeasuredPoint {
  int index = 0;            ///< of the point in the file
  Vec3 point;               ///< where it is taken to be
  double u = 0.0, v = 0.0;  ///< of its nearest point, from 0 to 1 over the face's domain
  double error_mm = 0.0;    ///< along the normal, beyond what the plan leaves; positive: material is left
};

struct FaceError {
  RigidMove move;                                       ///< of the points
  std::vector<MeasuredPoint> points;                    ///< those that count
  std::vector<int> outliers;                            ///< indices of points that do not, ascending
  int beside = 0;                                       ///< points that lie beside the face
  double rms_before_mm = 0.0, rms_after_mm = 0.0;       ///< of the error: as measured, after the move
  double planned_rms_mm = 0.0;                          ///< of what the plan leaves at the points that count
  double noise_mm = 0.0;                                ///< of the points, standard deviation, estimated
  double smooth_rms_mm = 0.0, smooth_largest_mm = 0.0;  ///< of the smooth error
  bool limited = false;                                 ///< the smooth error is beyond the limit somewhere
  BSplineSurface field;                                 ///< the smooth error as x over [0, 1]^2, mm
  double limit_mm = 0.0;
  /// The smooth error, mm, within the limit.
  [[nodiscard]] double at(double u, double v) const;
};

/// `face`: of the target, one patch. Throws InputError where the points are too few, belong to another face or another datum, or
/// leave a part of the face without any.
[[nodiscard]] FaceError face_error(const Target& target, const Face& face, const std::vector<Vec3>& points,
                                   const FaceErrorOptions& options);

/// The face, moved against its error: what has to be aimed at so that the nominal face is cut. `side`: +1 where the machined side is
/// that of Su x Sv, else -1.
[[nodiscard]] Face mirrored_face(const Face& face, const FaceError& error, int side);

}  // namespace flank::internal
