/// Of a strip, the stretch whose envelope is what the strip leaves: not where the tool plunges, nor where another pose of the strip
/// takes it away.
#pragma once

#include <functional>

#include "flank/envelope.h"
#include "flank/envelope/swept_estimate.h"
#include "flank/radial_function.h"
#include "flank/ruled_motion.h"

namespace flank::internal {

/// The part of a motion that became a strip.
struct StripMotion {
  int strip = 1;  ///< its id
  RuledMotion motion;
  double from_t = 0.0, to_t = 1.0;  ///< of its first and last pose
  int side = +1;                    ///< of the contact points that machine the target (envelope.h)
};

/// Shares of a strip, 0 to 1: u of its time, v of the axis from s = 0 to s = L.
struct Stretch {
  double from_u = 0.0, to_u = 1.0, from_v = 0.0, to_v = 1.0;
  [[nodiscard]] double area() const { return (to_u - from_u) * (to_v - from_v); }
  [[nodiscard]] double u(double share) const { return from_u + (to_u - from_u) * share; }
  [[nodiscard]] double v(double share) const { return from_v + (to_v - from_v) * share; }
};

/// A strip's exact envelope, by shares of the strip. Keeps nothing of what it is made of but the radial function.
class ExactStrip {
 public:
  ExactStrip(const StripMotion& strip, const RadialFunction& radial);

  [[nodiscard]] AxisJet jet(double u) const { return motion_.jet(u); }
  [[nodiscard]] ContactPoint contact(double u, double v) const;
  /// Is there a contact, and does no pose of the strip cut deeper than this below it, mm?
  [[nodiscard]] bool is_left(double u, double v, double limit_mm) const;
  /// The motion from the first pose to the last, over [0, 1].
  [[nodiscard]] const RuledMotion& motion() const { return motion_; }
  [[nodiscard]] const RadialFunction& radial() const { return radial_; }

 private:
  RuledMotion motion_;
  const RadialFunction& radial_;
  int side_;
  SweptEstimate swept_;
};

/// The largest part of a stretch, by its area, at whose places on a grid `holds` is true; of no area where there is none. Asked by
/// several threads at once.
[[nodiscard]] Stretch largest_stretch(const Stretch& within, const std::function<bool(double u, double v)>& holds);

}  // namespace flank::internal
