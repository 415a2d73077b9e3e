/// How long can a tool touch at a point, of all axes in a box? The step of the branch and bound (docs/algorithms/bound.md).
#pragma once

#include <array>
#include <vector>

#include "flank/bound/contact/pose_plane.h"
#include "flank/bound/contact/question.h"

namespace flank::internal {

/// Axes that touch a site: the station of the tool that touches, mm from the tip, and the direction in the tangent plane, each with half of its
/// width. How far the axis is off the site and how much it leans is no part of the box: that is settled exactly.
struct ContactBox {
  double station = 0.0, half_station = 0.0;
  double angle = 0.0, half_angle = 0.0;
  /// Where the contact of the box that this one is a part of was longest, mm along the axis from the site: where the moves that
  /// cancel the width of the box are fitted.
  double back = 0.0, ahead = 0.0;
};

struct BoxBound {
  double most_mm = 0.0;            ///< no axis of the box touches over more
  double back = 0.0, ahead = 0.0;  ///< where that is, along the middle axis from the site; back <= 0 <= ahead
  /// Rises and slopes that may touch about that long.
  std::array<Vec2, 3> moves = {Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
  double by_angle = 0.0, by_station = 0.0;  ///< how much of the slack, mm, each width makes
};

/// Everything that is known of the axes of one box; asks the target for as little as is needed.
class BoxSearch {
 public:
  BoxSearch(const ContactQuestion& question, const ContactSite& site, const ContactBox& box);

  /// Looks more closely until the bound is at most enough_mm, or cannot fall any more by looking more closely.
  [[nodiscard]] BoxBound run(double enough_mm);

  /// The middle axis, moved.
  [[nodiscard]] static Pose pose(const ContactQuestion& question, const ContactSite& site, const ContactBox& box,
                                 const Vec2& move);

 private:
  /// A point of the middle axis, sigma from the site.
  struct Station {
    double sigma = 0.0;
    bool ready = false, far = false, clamped = false;
    double across = 0.0;             ///< share of a rise that goes along the probe's normal
    double turn = 0.0;               ///< rise by the angle, mm per radian
    double side = 0.0, along = 0.0;  ///< shares of the probe's normal along the two tangents of the middle axis
    RadialJet radial;
    AxisProbe probe;
  };
  /// Where a box's contact may run to: the last stations that it may touch.
  struct Reach {
    std::size_t back = 0, ahead = 0;
    double length = -1.0;
    PosePlane moves;
  };

  /// One side of the site: stations by distance, and the moves with which all up to each of them may touch.
  struct Row {
    std::vector<Station> stations;  ///< the first is the site; the last is an end, never touched
    std::vector<PosePlane> moves;   ///< of the stations up to the first that cannot be touched
  };

  void lay_stations(Row& row, double end, double sign) const;
  void add_stations(Row& row, double step) const;
  void look(Station& station) const;
  void fit_cancelling();
  void cut(Station& station, PosePlane& moves) const;
  void follow(Row& row) const;
  [[nodiscard]] Reach march();
  [[nodiscard]] PosePlane inner_moves(const Reach& reach, double share) const;
  [[nodiscard]] BoxBound bound_of(const Reach& reach) const;
  [[nodiscard]] double spread(const Station& station, double& perpendicular, double& along) const;

  const ContactQuestion& question_;
  const ContactSite& site_;
  const ContactBox& box_;
  Vec3 tangent_, side_, axis_, origin_;
  double lean_, level_;  ///< sine and cosine of the angle between axis and tangent plane
  Vec2 turn_ = Vec2::Zero(),
       slide_ = Vec2::Zero();  ///< (rise, slope) per radian and per mm of station that are cancelled
  Row back_, ahead_;
  double kept_step_ = 0.0;  ///< stations closer than this to the last one that is kept only count for themselves
};

}  // namespace flank::internal
