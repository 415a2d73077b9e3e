/// The real envelope of a tool under a motion (MATH section 3).
#pragma once

#include <functional>
#include <vector>

#include "flank/radial_function.h"
#include "flank/ruled_motion.h"

namespace flank {

/// Contact of the sphere of s at time t with the envelope. Where there is none (|c| >= 1) `exists` is false and point
/// and normal are those of c cut to +-1, so that they stay finite and continuous; where the axis point moves along u or
/// rests, c is infinite (or 0, if r' = 0) and only the cut exists.
struct ContactPoint {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::Zero();  ///< nu: unit, from the axis point to the contact point
  double c = 0.0;              ///< regularity: a contact exists iff |c| < 1
  bool exists = false;
};
/// side = +1 or -1 chooses the sign of the term along e2 = u x e1.
[[nodiscard]] ContactPoint contact_point(const RuledMotion& motion, const RadialFunction& radial, double s, double t,
                                         int side);
/// The same with everything at hand already.
[[nodiscard]] ContactPoint contact_point(const AxisJet& axis, const RadialJet& radial, double s, int side);
/// The side of the contact whose normal nu looks most like `towards` at the middle of the motion and of the axis.
[[nodiscard]] int contact_side(const RuledMotion& motion, const RadialFunction& radial, const Vec3& towards);

/// Characteristic of time t: the contact points of the tool in one pose, at `count_s` (>= 2) equal steps of s over [0,
/// L].
[[nodiscard]] std::vector<ContactPoint> characteristic(const RuledMotion& motion, const RadialFunction& radial,
                                                       double t, int side, int count_s);

/// Largest |c| over a grid: >= 1 means the tool plunges and the envelope has an edge of regression or does not exist.
struct Regularity {
  double largest_c = 0.0;
  double s = 0.0, t = 0.0;  ///< where
  int failures = 0;         ///< grid points with |c| >= 1
};
[[nodiscard]] Regularity regularity(const RuledMotion& motion, const RadialFunction& radial, int count_t, int count_s);

/// Contact points on a grid: index i * count_s + j, t_i and s_j equally spaced over [0, 1] and [0, L].
[[nodiscard]] std::vector<ContactPoint> sample_envelope(const RuledMotion& motion, const RadialFunction& radial,
                                                        int side, int count_t, int count_s);

/// Signed distance of a point to what the envelope should be, positive where material is left. NaN: the point does not
/// count (e.g. its footpoint is not on the face). Called from several threads at once.
using SignedDistance = std::function<double(const Vec3&)>;

/// Deviation of an envelope, over a grid of contact points as in sample_envelope.
struct EnvelopeDeviation {
  double largest_mm = 0.0;   ///< most positive (or least negative)
  double smallest_mm = 0.0;  ///< most negative
  double rms_mm = 0.0;
  double largest_s = 0.0, largest_t = 0.0, smallest_s = 0.0, smallest_t = 0.0;  ///< where
  int counted = 0;      ///< grid points with a contact and a distance
  int missing = 0;      ///< grid points without a contact (|c| >= 1)
  int not_counted = 0;  ///< grid points whose distance is NaN
  [[nodiscard]] double largest_magnitude_mm() const { return largest_mm > -smallest_mm ? largest_mm : -smallest_mm; }
};
[[nodiscard]] EnvelopeDeviation envelope_deviation(const RuledMotion& motion, const RadialFunction& radial, int side,
                                                   int count_t, int count_s, const SignedDistance& distance);

}  // namespace flank
