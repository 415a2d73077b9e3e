#include "flank/strip/grow.h"

#include <algorithm>
#include <cmath>

#include "flank/seed/movability.h"

namespace flank::internal {
namespace {

/// Turn of the axis, times half its length, that one step may add, as a share of the step: a branch jump turns more.
constexpr double kJump = 4.0;
constexpr double kOffMean = 0.5;  ///< farthest that the middle of a step lies from the mean of its ends, in steps
/// Stay of the corrector (LineFitOptions::stay_share): the predictor goes on smoothly, and within the tolerance that is
/// worth more than the least error.
constexpr double kStay = 0.5;
/// Least mean advance of the footpoints, as a share of the step. On a convex target of radius R they move by R / (R +
/// r) of what the axis does: a tenth is an edge rounded by r / 9. A line whose footpoints move less turns on the spot.
constexpr double kAdvance = 0.1;
/// LineHold::slide_share of the corrector: with a guide the slide is held as by an error of one tolerance, so that the
/// strip follows the edge; after a slide out of another face by four, or the corrector would slide back in.
constexpr double kGuidedSlide = 1.0, kClearedSlide = 4.0;
/// Shares of the step: most slide towards the guide in one step, so that edges are followed without kinks; and farthest
/// slide out of another face, beyond which a strip had better end.
constexpr double kGuideReach = 0.5, kClearReach = 2.0;
/// Steps grow by this after each that is accepted, and are halved otherwise: after a halving two good steps make up for
/// it.
constexpr double kStepGrowth = 1.5;
/// Overlap of the neighbour's segments, as a share of each: at a joint that bends, a pose may project onto neither.
constexpr double kJointOverlap = 0.01;
/// mm^2: keeps a segment that lies along the axis from dividing by zero.
constexpr double kLeastSegment = 1e-12;

Pose half_way(const Pose& a, const Pose& b) { return {0.5 * (a.tip + b.tip), (a.axis + b.axis).normalized()}; }

class Grower {
 public:
  Grower(LineFitter& fitter, const PoseGuard& guard, const GrowGuide& guide, const GrowOptions& options)
      : fitter_(fitter),
        guard_(guard),
        guide_(guide),
        options_(options),
        length_(fitter.axis_length()),
        size_(fitter.target().diagonal()) {}

  GrowEnd run(const LineFit& line, const Vec3& heading, std::vector<Pose>& poses);

 private:
  bool step(double h, const AxisVelocity& v, LineFit& middle, LineFit& next);
  bool between(double h, const Vec3& travel, const LineFit& next, LineFit& middle);
  bool within(const LineFit& fit) const;
  bool advanced(double h, const Vec3& direction) const;
  void overrun(const AxisVelocity& last, std::vector<Pose>& poses);

  LineFitter& fitter_;
  const PoseGuard& guard_;
  const GrowGuide& guide_;
  const GrowOptions& options_;
  double length_, size_;
  Pose pose_;
  std::vector<Footpoint> feet_;
  bool blocked_ = false;  ///< the last refusal was for another face
};

bool Grower::within(const LineFit& fit) const {
  const double tolerance = fitter_.options().tolerance_mm;
  // A tool that has left the target still must not cut its border.
  return (!fit.touches() || fit.largest_mm <= tolerance) && fitter_.overcut(fit.pose, tolerance) <= tolerance;
}

/// Whether the footpoints moved on along the target. A line can travel while its footpoints stay, round a sharp edge.
bool Grower::advanced(double h, const Vec3& direction) const {
  const auto now = fitter_.feet();
  double sum = 0.0;
  int count = 0;
  for (std::size_t j = 0; j < feet_.size(); ++j) {
    if (feet_[j].location != Location::kInside || now[j].location != Location::kInside) continue;
    sum += (now[j].point - feet_[j].point).dot(direction);
    ++count;
  }
  return count == 0 || sum >= kAdvance * h * count;
}

bool Grower::step(double h, const AxisVelocity& v, LineFit& middle, LineFit& next) {
  blocked_ = false;
  fitter_.set_feet(feet_);
  Pose predicted = moved(pose_, v, length_, h);
  LineHold hold{v.middle, 0.0, kStay};
  if (guide_.neighbour) {
    const double slide = guide_slide(guide_, predicted, length_);
    predicted.tip += std::clamp(slide, -kGuideReach * h, kGuideReach * h) * predicted.axis;
    hold.slide_share = kGuidedSlide;
  }
  next = fitter_.refine(predicted, hold);
  if (!guard_.clear(next.pose)) {
    hold.slide_share = kClearedSlide;
    next = fitter_.refine(slid_clear(guard_, next.pose, kClearReach * h), hold);
    blocked_ = !guard_.clear(next.pose);
    if (blocked_) return false;
  }
  // A line may leave the target by a short step only: past the border its path follows an extrapolation.
  if (!next.touches() && h > options_.first_step_share * size_) return false;
  if (!within(next) || !advanced(h, v.middle.normalized())) return false;
  if (farther_end(pose_, next.pose, length_) > kJump * h) return false;
  return between(h, v.middle, next, middle);
}

/// Certificate at the middle of a step. The mean of two poses is off a curved path by h^2 / 8 times its curvature, more
/// than a fine tolerance allows. So the middle is refined if the mean fails, and has to lie near the mean all the same.
bool Grower::between(double h, const Vec3& travel, const LineFit& next, LineFit& middle) {
  const std::vector<Footpoint> feet(fitter_.feet().begin(), fitter_.feet().end());
  const Pose mean = half_way(pose_, next.pose);
  middle = fitter_.measure(mean);
  if (!within(middle)) middle = fitter_.refine(mean, {travel, 0.0, kStay});
  const bool held = farther_end(mean, middle.pose, length_) < kOffMean * h && within(middle);
  blocked_ = held && !guard_.clear(middle.pose);
  fitter_.set_feet(feet);  // of `next` again: they are what the walk goes on from
  return held && !blocked_;
}

/// Past the border the last motion goes on as it is, as far as it is clear.
void Grower::overrun(const AxisVelocity& last, std::vector<Pose>& poses) {
  const Pose next = moved(poses.back(), last, length_, options_.overrun_share * size_);
  if (within(fitter_.measure(next)) && guard_.clear(next)) poses.push_back(next);
}

GrowEnd Grower::run(const LineFit& line, const Vec3& heading, std::vector<Pose>& poses) {
  pose_ = line.pose;
  feet_.assign(fitter_.feet().begin(), fitter_.feet().end());
  AxisVelocity last{heading, Vec3::Zero()};
  double h = options_.first_step_share * size_, travel = 0.0;
  while (travel < options_.longest_travel_share * size_) {
    const Movability at = next_velocity(feet_, pose_, length_, last);
    if (!at.valid()) return GrowEnd::kTolerance;
    LineFit middle, next;
    bool done = false;
    for (; !done && h >= options_.shortest_step_share * size_; h *= done ? 1.0 : 0.5)
      done = step(h, at.velocity, middle, next);
    if (!done) return blocked_ ? GrowEnd::kCheck : GrowEnd::kTolerance;
    // The velocity that was, not the one predicted: it is what the next step is to continue smoothly.
    last = mean_velocity(pose_, next.pose, length_, h);
    pose_ = next.pose;
    feet_.assign(fitter_.feet().begin(), fitter_.feet().end());
    poses.push_back(middle.pose);
    poses.push_back(pose_);
    travel += h;
    h = std::min(kStepGrowth * h, options_.longest_step_share * size_);
    if (!next.touches()) {
      overrun(last, poses);
      return GrowEnd::kBorder;
    }
  }
  return GrowEnd::kTravel;
}

}  // namespace

double guide_slide(const GrowGuide& guide, const Pose& pose, double axis_length) {
  const std::vector<Pose>& poses = *guide.neighbour;
  const Vec3 end = pose.at(guide.beyond_tip ? axis_length : 0.0);
  const auto edge = [&](std::size_t i) { return poses[i].at(guide.beyond_tip ? 0.0 : axis_length); };
  double least = 1e300, slide = 0.0;
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    const Vec3 a = edge(i), b = edge(i + 1);
    // Nearest across the axis: the slide is what is wanted.
    const auto across = [&](const Vec3& v) { return Vec3(v - v.dot(pose.axis) * pose.axis); };
    const Vec3 ab = across(b - a), to = across(end - a);
    const double f = to.dot(ab) / std::max(kLeastSegment, ab.squaredNorm());
    if (f < -kJointOverlap || f > 1.0 + kJointOverlap) continue;
    const Vec3 q = a + f * (b - a);
    const double distance = (q - end).norm();
    if (distance >= least) continue;
    least = distance;
    slide = (q - end).dot(pose.axis) + (guide.beyond_tip ? guide.overlap_mm : -guide.overlap_mm);
  }
  return slide;
}

GrownStrip grow(LineFitter& fitter, const PoseGuard& guard, const LineFit& line, const GrowGuide& guide,
                const GrowOptions& options) {
  const std::vector<Footpoint> feet(fitter.feet().begin(), fitter.feet().end());
  const Movability start = movability(feet, line.pose, fitter.axis_length());
  GrownStrip strip;
  if (!start.valid()) return strip;
  const auto side = [&](double sign, std::vector<Pose>& poses) {
    fitter.set_feet(feet);
    return Grower(fitter, guard, guide, options).run(line, sign * start.velocity.middle, poses);
  };
  strip.first = side(-1.0, strip.poses);
  std::reverse(strip.poses.begin(), strip.poses.end());
  strip.poses.push_back(line.pose);
  strip.last = side(1.0, strip.poses);
  return strip;
}

}  // namespace flank::internal
