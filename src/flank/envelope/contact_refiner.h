/// Contacts of a swept tool, exact: from a place near one to the place itself.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "flank/radial_function.h"
#include "flank/ruled_motion.h"

namespace flank::internal {

/// The place at which a swept tool comes nearest to a point.
struct SweptContact {
  int motion = -1;               ///< index; -1: none known
  double t = 0.0, s = 0.0;       ///< time in [0, 1]; along the axis, mm
  double f = 0.0;                ///< |x - R(s,t)| - r(s), mm: > 0 material left at x, < 0 overcut
  Vec3 to_axis = Vec3::UnitZ();  ///< unit direction from x to the axis point: df/dR
};

/// Immutable after construction, for many threads at once. Rails and profile are kept as the polynomials that they are between their
/// knots: a place costs a few of them, and fits ask for millions.
class ContactRefiner {
 public:
  ContactRefiner(const std::vector<RuledMotion>& motions, const RadialFunction& radial);

  /// The contact at the local minimum over t near place.t (within `window` > 0 of it) and over s: exact to about 1e-9 mm if that
  /// minimum is smooth in t. place.motion and place.t are read. A radial function that is no tool (|r'| >= 1) gives some
  /// stationary place; f is infinite where the motion has no value.
  [[nodiscard]] SweptContact refine(const Vec3& x, const SweptContact& place, double window) const;

 private:
  /// A cubic between two knots, in powers of the place between them, 0 to 1.
  template <class Value>
  struct Cubic {
    std::array<Value, 4> c;
  };
  /// A motion's rails; its own curves where these are not cubics with even knots.
  struct Rails {
    std::vector<Cubic<Vec3>> tip, direction;
    std::optional<RuledMotion> other;
  };
  /// Tip and unit direction of the axis at a time, and their derivatives by it.
  struct AxisJet2 {
    std::array<Vec3, 3> tip, u;
  };
  /// A sphere of the tool: where on the axis, and its radius.
  struct Sphere {
    double s = 0.0, r = 0.0;
  };

  [[nodiscard]] static Rails rails_of(const RuledMotion& motion);
  [[nodiscard]] AxisJet2 axis(const Rails& rails, double t) const;
  [[nodiscard]] Pose pose(const Rails& rails, double t) const;
  [[nodiscard]] RadialJet radius(double s) const;
  [[nodiscard]] Sphere stationary(double z, double rho2, double s) const;
  [[nodiscard]] Sphere nearer_end(double z, double rho2, const Sphere& sphere) const;
  [[nodiscard]] SweptContact at(const Rails& rails, const Vec3& x, double t, double s) const;
  [[nodiscard]] std::optional<SweptContact> by_newton(const Rails& rails, const Vec3& x, const SweptContact& first,
                                                      double window) const;
  [[nodiscard]] SweptContact by_brackets(const Rails& rails, const Vec3& x, const SweptContact& first,
                                         double window) const;

  std::vector<Rails> rails_;
  RadialFunction radial_;
  std::vector<Cubic<double>> profile_;  ///< of a spline; empty: another family
  double length_, low_, high_;          ///< of the axis; radii at its ends, which every contact is compared with
};

}  // namespace flank::internal
