#include "flank/fit/orbit/orbit_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flank/base/tolerance_budget.h"
#include "flank/fit/orbit/orbit_model.h"

namespace flank::internal {
namespace {

constexpr int kOrbits = 160;  ///< of the section: a strip among six still has two dozen

/// The middles of equal parts of the section, on the target itself: the chart is good for starts alone.
std::vector<OrbitPlace> places_of(const OrbitSection& section, const OrbitStart& start) {
  std::vector<OrbitPlace> places;
  double all = 0.0;
  for (int k = 0; k < kOrbits; ++k) {
    const double length = section.width() * (k + 0.5) / kOrbits;
    const OrbitSection::Span span = section.span_at(length);
    const double time = 0.5 * (span.first + span.last);
    const Footpoint foot = start.target->closest(section.motion().moved(section.at(length).point, time));
    OrbitPlace place;
    place.point = section.motion().moved(foot.point, -time);
    place.share = (span.last - span.first) * section.motion().velocity(place.point).norm();
    place.touch = start.reachable({foot.point, foot.normal, 0.0, foot.u, foot.v, foot.patch});
    all += place.share;
    places.push_back(place);
  }
  // What can be reached ends between two places: up to the next one it is to be touched, too.
  std::vector<bool> reached;
  for (const OrbitPlace& place : places) reached.push_back(place.touch);
  for (std::size_t k = 0; k < places.size(); ++k)
    places[k].touch = reached[k] || (k > 0 && reached[k - 1]) || (k + 1 < places.size() && reached[k + 1]);
  for (OrbitPlace& place : places) place.share /= all;
  return places;
}

/// The lines of a start, moved to where the section is.
std::vector<Pose> lines_of(const OrbitSection& section, const OrbitStart& start) {
  std::vector<Pose> lines;
  for (const RuledMotion& motion : start.motions) {
    const Pose pose = motion.pose(0.5);
    const double time = section.crossing_of(pose.at(0.5 * motion.axis_length)).time;
    lines.push_back({section.motion().moved(pose.tip, -time), section.motion().turned(pose.axis, -time)});
  }
  return lines;
}

/// A free tool's radii: how far the lines are from the target, in the mean. One line alone is exact with these.
RadialFunction first_tool(const OrbitSection& section, const OrbitStart& start, const std::vector<Pose>& lines,
                          const RadiusBounds& bounds) {
  constexpr int kSamples = 49;
  if (start.tool.family() != ToolFamily::kSpline || start.free_parameters.empty()) return start.tool;
  const OrbitSection::Span span = section.span();
  const double time = 0.5 * (span.first + span.last), length = start.tool.axis_length();
  std::vector<Vec2> radii;
  for (int j = 0; j < kSamples; ++j) {
    const double s = length * j / (kSamples - 1.0);
    double sum = 0.0;
    int count = 0;
    for (const Pose& line : lines) {
      const Footpoint foot = start.target->closest(section.motion().moved(line.at(s), time));
      if (foot.location != Location::kInside || foot.distance <= 0.0) continue;
      sum += foot.distance;
      ++count;
    }
    if (count > 0) radii.emplace_back(s, std::clamp(sum / count, bounds.smallest, bounds.largest));
  }
  const int coefficients = start.tool.parameter_count();
  return static_cast<int>(radii.size()) < 2 * coefficients
             ? start.tool
             : RadialFunction::spline_through(length, radii, coefficients);
}

/// Share of the section that is within the tolerance, less a price for what is cut deeper.
double score_of(const OrbitModel& model, const OrbitState& state, double tolerance_mm) {
  constexpr double kPrice = 0.1;  // as CoverageEstimate::score
  double covered = 0.0, all = 0.0, overcut = 0.0;
  for (std::size_t k = 0; k < model.places().size(); ++k) {
    const OrbitPlace& place = model.places()[k];
    const double f = state.contacts[k].f;
    overcut = std::max(overcut, -f);
    if (!place.touch) continue;
    all += place.share;
    if (std::abs(f) <= kToleranceBudget.fit.sure_orbit * tolerance_mm) covered += place.share;
  }
  return (all > 0.0 ? covered / all : 0.0) - kPrice * std::max(0.0, overcut / tolerance_mm - 1.0);
}

/// From wide to narrow: first everything pulls, then what is far is given up and what is too deep taken back
/// (partial_polish.h does the same with motions).
std::vector<OrbitPass> passes_for(double tolerance_mm, double axis_length) {
  constexpr double kFirst = 16.0, kFirstShare = 0.03, kLast = 2.0, kRatio = 0.4;
  std::vector<OrbitPass> passes;
  double overcut = 1.0;
  for (double scale = std::max(kFirst * tolerance_mm, kFirstShare * axis_length); scale > kLast * tolerance_mm;
       scale *= kRatio) {
    passes.push_back({.robust_scale_mm = scale, .overcut_weight = overcut, .iterations = 15});
    overcut = std::min(2.0 * overcut, 4.0);
  }
  const double scale = kLast * tolerance_mm, zone = kToleranceBudget.fit.dead_zone_orbit * tolerance_mm;
  passes.push_back({scale, 0.5 * zone, 4.0, 20});
  passes.push_back({scale, zone, 4.0, 20});
  // One that loses sight of more than the tolerance goes no further than its start: so it comes between two others.
  passes.push_back({tolerance_mm, zone, 4.0, 20});
  passes.push_back({scale, zone, 16.0, 20});
  return passes;
}

/// The best state that any pass left.
OrbitState best_state(const OrbitModel& model, OrbitState state, double tolerance_mm) {
  OrbitState best;
  double score = -std::numeric_limits<double>::infinity();
  for (const OrbitPass& pass : passes_for(tolerance_mm, state.tool.axis_length())) {
    state = minimised(model, std::move(state), pass);
    const double now = score_of(model, state, tolerance_mm);
    if (!(now > score)) continue;
    score = now;
    best = state;
  }
  return best;
}

/// The motion of one line over what it touches within four tolerances: over all, if that is nothing.
RuledMotion motion_of(const OrbitSection& section, const OrbitState& state, int line, double tolerance_mm) {
  constexpr int kControlPoints = 24, kPoses = 8 * kControlPoints;
  constexpr double kNear = 4.0, kPastEnd = 0.03;  // tolerances; of the way
  constexpr double kNone = std::numeric_limits<double>::infinity();
  OrbitSection::Span span{kNone, -kNone};
  for (std::size_t k = 0; k < state.contacts.size(); ++k) {
    const OrbitContact& contact = state.contacts[k];
    if (contact.line != line || std::abs(contact.f) > kNear * tolerance_mm) continue;
    // At time T the line touches what was at the place's time `contact.time`, T later.
    const OrbitSection::Span on = section.span_at(section.width() * (static_cast<double>(k) + 0.5) / kOrbits);
    span = {std::min(span.first, on.first - contact.time), std::max(span.last, on.last - contact.time)};
  }
  if (span.last < span.first) span = section.span();
  const double past = kPastEnd * (span.last - span.first);
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int i = 0; i <= kPoses; ++i) {
    t.push_back(static_cast<double>(i) / kPoses);
    const double time = span.first - past + t.back() * (span.last - span.first + 2.0 * past);
    const Pose& at = state.lines[static_cast<std::size_t>(line)];
    poses.push_back({section.motion().moved(at.tip, time), section.motion().turned(at.axis, time)});
  }
  return fit_motion(poses, t, state.tool.axis_length(), kControlPoints);
}

}  // namespace

bool is_exact(const OrbitSection& section, double tolerance_mm) {
  constexpr double kShare = 0.25;
  const OrbitSection::Span span = section.span();
  const Vec3 middle = section.at(0.5 * section.width()).point;
  const double half_way = 0.5 * (span.last - span.first) * section.motion().velocity(middle).norm();
  return section.motion().sine * half_way <= kShare * tolerance_mm;
}

OrbitFit orbit_fit(const OrbitSection& section, const OrbitStart& start, const FlankFitOptions& options) {
  const OrbitSection::Span span = section.span();
  const double quarter = 0.25 * (span.last - span.first), middle = 0.5 * (span.first + span.last);
  const OrbitTool of_tool{start.free_parameters, options.bounds, start.tool.axis_length(),
                          start.tool.axis_length() + start.tool.largest()};
  const OrbitModel model(section.motion(), places_of(section, start), of_tool, start.obstacles,
                         {middle - quarter, middle, middle + quarter});
  const std::vector<Pose> lines = lines_of(section, start);
  const RadialFunction tool = first_tool(section, start, lines, options.bounds);
  const OrbitState best = best_state(model, {lines, tool, {}}, options.tolerance_mm);
  OrbitFit fit;
  fit.tool = best.tool;
  fit.score = score_of(model, best, options.tolerance_mm);
  for (std::size_t i = 0; i < best.lines.size(); ++i)
    fit.motions.push_back(motion_of(section, best, static_cast<int>(i), options.tolerance_mm));
  return fit;
}

}  // namespace flank::internal
