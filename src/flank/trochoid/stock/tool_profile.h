/// The solid tool as the stock sees it: its radius at every height, and the rings at which its engagement is measured.
#pragma once

#include <optional>
#include <vector>

#include "flank/radial_function.h"

namespace flank::internal {

/// Radius of the flank and its round ends over the height z along the axis, z = 0 at s = 0 (MATH section 1). Immutable.
class ToolProfile {
 public:
  /// The tool must be legitimate (check_legitimacy): heights of the meridian rise with s.
  explicit ToolProfile(const RadialFunction& radial);

  struct Place {
    double radius = 0.0, slope = 0.0;  ///< mm, and its derivative by z
  };
  /// Nothing below low() and above high(). Accurate to about 1e-9 of the length.
  [[nodiscard]] bool at(double z, Place& place) const;
  [[nodiscard]] double low() const { return low_; }
  [[nodiscard]] double high() const { return high_; }
  /// Heights between which it is the flank, not a round end.
  [[nodiscard]] double flank_low() const { return first_; }
  [[nodiscard]] double flank_high() const { return last_; }
  [[nodiscard]] double largest() const { return largest_; }
  /// The sphere of a round end: the height of its centre and its radius, mm.
  struct RoundEnd {
    double centre, radius;
  };
  /// Of the end that a height is nearer to.
  [[nodiscard]] RoundEnd round_end(double z) const {
    return z < 0.5 * length_ ? RoundEnd{0.0, tip_radius_} : RoundEnd{length_, end_radius_};
  }

 private:
  double low_ = 0.0, high_ = 0.0;               ///< of the round ends
  double first_ = 0.0, last_ = 0.0;             ///< of the meridian
  double tip_radius_ = 0.0, end_radius_ = 0.0;  ///< of the spheres of the ends
  double length_ = 0.0, per_mm_ = 0.0, largest_ = 0.0;
  std::vector<double> radius_, slope_;  ///< at equal steps of z from first_ to last_
};

/// A circle of the tool, perpendicular to the axis. Unit normal of the tool on it: sine * u + cosine * (radial direction).
struct ToolRing {
  double s = 0.0;       ///< of the sphere whose contact circle it is, mm: its velocity decides what is the front
  double z = 0.0;       ///< height of the circle, mm
  double radius = 0.0;  ///< of the circle, mm
  double sine = 0.0, cosine = 1.0;
  /// mm^2 per radian: the part of the tool's surface that the ring stands for in an integral over it.
  double area = 0.0;
  bool flank = true;  ///< else of a round end, which counts for volumes, not for engagement
  bool asked = true;  ///< for the engagement, if it is of the flank; else for the volume alone
  /// Asked only where a rough look says that it may engage more than the others of its row.
  bool between = false;
};

/// `count` (>= 2) rings at equal steps of s, the axis' ends included, with the areas of the trapezoidal rule, and `caps` more in
/// the middles of equal steps on each round end.
[[nodiscard]] std::vector<ToolRing> tool_rings(const RadialFunction& radial, int count, int caps);

/// How many rings of the flank are no farther apart than so many of the largest radii: at least `least`, at most `most`.
[[nodiscard]] int ring_count(const RadialFunction& radial, double radii_apart, int least, int most);

/// The ring of a round end at a share of its quarter of a meridian, 0 where the flank ends and 1 at the pole, with the area of the
/// whole end if it were all as there.
[[nodiscard]] ToolRing round_end_ring(const RadialFunction& radial, bool tip, double share);

/// The surface element of the flank at s, mm^2 per radian and mm of s.
[[nodiscard]] double flank_element(const RadialFunction& radial, double s);

/// The ring of one s, without area.
[[nodiscard]] ToolRing ring_at(const RadialFunction& radial, double s);

}  // namespace flank::internal
