/// The envelope of a motion as one spline surface that reaches past all borders of the face that it takes the place of.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "flank/bspline_surface.h"
#include "flank/radial_function.h"
#include "flank/ruled_motion.h"
#include "flank/target.h"

namespace flank::internal {

/// Places of a face that an end of the motion or of the tool is nearest to: there a pose leaves what it is, and no envelope.
struct PlacesAtEnds {
  int of_motion = 0, at_tip = 0, at_top = 0;  ///< first or last pose; ends of the axis, apart from these
  [[nodiscard]] int count() const { return of_motion + at_tip + at_top; }
  void add(const PlacesAtEnds& more) {
    of_motion += more.of_motion;
    at_tip += more.at_tip;
    at_top += more.at_top;
  }
};

struct MillableSurface {
  BSplineSurface surface;
  bool reversed = false;           ///< as Face::reversed, so that its normal points to the tool
  std::unique_ptr<Target> target;  ///< of the whole surface, from the tool's side
  double deviation_mm = 0.0;       ///< of the spline from the exact envelope where the face is, at most, by samples
  double largest_c = 0.0;          ///< regularity where the face is (envelope.h), < 1 needed
  PlacesAtEnds at_ends;
  double used_from_s = 0.0, used_to_s = 0.0;  ///< stretch of the axis that the face needs, mm; the tool ends at 0 and L
  double used_from_t = 0.0, used_to_t = 1.0;  ///< and of the motion
  /// Parameters of the point nearest to p; none: p lies beyond the surface.
  [[nodiscard]] std::optional<Vec2> nearest(const Vec3& p) const;
  /// Height of the surface over p, a point of the face: > 0 it lies on the tool's side.
  [[nodiscard]] double over(const Vec3& p) const;
};

/// `aim_mm`: how near the spline is to the exact envelope. None, with the reason in `why`: the envelope ends before the borders of the
/// face, or is none there.
[[nodiscard]] std::optional<MillableSurface> millable_surface(const RuledMotion& motion, const RadialFunction& radial,
                                                              const Target& face, double aim_mm, std::string& why);

}  // namespace flank::internal
