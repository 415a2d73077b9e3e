/// What is asked of a given tool at a point of a face, and what is known around one point of its axis.
#pragma once

#include "flank/radial_function.h"
#include "flank/target.h"

namespace flank::internal {

/// A tool against a face, within the tolerance that was asked for. Both must live longer.
struct ContactQuestion {
  ContactQuestion(const Target& face, const RadialFunction& tool, double asked_mm);

  const Target* target;
  const RadialFunction* radial;
  double tolerance_mm;       ///< with what footpoints and sums may be off by rounding
  double length_mm;          ///< of the axis
  double thin_mm, thick_mm;  ///< smallest and largest radius
  double steepest;           ///< largest |r'|
  double bend;               ///< an upper bound of |r''|, 1/mm
  [[nodiscard]] bool cylinder() const { return steepest == 0.0; }
};

/// A point of the face where the tool is to touch.
struct ContactSite {
  ContactSite(const ContactQuestion& question, const Vec3& near);

  Vec3 point, normal;  ///< unit, towards the machining side
  Vec3 across, along;  ///< unit tangents
  double
      roof_mm;  ///< radius of a ball that touches at the point and is free of the face; above thick_mm, or 0: none known
  double slope_max;  ///< steeper axes touch over less than `least_mm`
  double least_mm;   ///< contact shorter than this is not looked at
};

/// The distance to the face around an axis point p: never more than to the footpoint, never less than a free ball says.
struct AxisProbe {
  Vec3 normal;           ///< unit, from the footpoint to p
  double distance_mm;    ///< from the nearest point of the face, at most the horizon that was asked for
  double roof_mm = 0.0;  ///< radius of the ball whose centre lies on the same normal; 0: none
  double lack_mm = 0.0;  ///< by how much that ball is not free
  bool far = false;      ///< farther than the horizon; then only that is known
};

/// Looks at p, as far as horizon_mm. `roof_mm`: radius of the largest ball that is tried.
[[nodiscard]] AxisProbe probe_axis(const ContactQuestion& question, const Vec3& p, double horizon_mm, double roof_mm);

}  // namespace flank::internal
