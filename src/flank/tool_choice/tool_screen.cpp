#include "flank/tool_choice/tool_screen.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "flank/base/parallel.h"
#include "flank/seed/direction/direction_filter.h"

namespace flank::internal {
namespace {

/// mm: radius of a hollow where there is none.
constexpr double kAnyRoom = 1e300;

/// What a place says of a tool.
struct PlaceScreen {
  bool reachable = false, fits = false, accepted = false, open = false;
  double error_mm = kMostErrorMm;
};

/// Radial function at the middles of equal pieces of the axis, and its smallest radius.
struct Spheres {
  std::vector<double> s;
  std::vector<RadialJet> jets;
  double thinnest = 0.0;
  DirectionFilterOptions filter;
};

/// What of a tool the screen asks at every place; computed once for all of them.
Spheres spheres_of(const RadialFunction& radial, const ScreenPlaces& places, const ScreenOptions& options) {
  Spheres out;
  const double length = radial.axis_length();
  for (int j = 0; j < options.spheres; ++j) {
    out.s.push_back((j + 0.5) / options.spheres * length);
    out.jets.push_back(radial.at(out.s.back()));
  }
  out.thinnest = radial.smallest();
  out.filter = {options.tolerance_mm, std::min(length, places.diagonal_mm), options.slack};
  return out;
}

/// The filter's error along any direction of the tangent plane, as candidate_directions has it for the best: by how
/// much the second derivative of d is off there.
double direction_error(const AdmissibleDirections& at, const RadialJet& jet, double excess_mm, double theta,
                       double length) {
  const double c = std::cos(theta), lambda = at.lambda1 * c * c + at.lambda2 * (1.0 - c * c);
  return excess_mm + (1.0 - jet.d1 * jet.d1) * std::abs(at.mu - lambda) * length * length / kParabolaShare;
}

/// Is the tool free along one of the directions that the filter accepts? The admissible ones first, then a grid: a tool
/// that is off in all of them may turn as far as the tolerance lets it.
bool is_open(const Footpoint& foot, const Spheres& spheres, std::size_t j, const CandidateDirections& found,
             const PoseGuard& guard, const ScreenOptions& options) {
  const RadialJet& jet = spheres.jets[j];
  for (const Vec3& direction : found.all())
    if (guard.clear(contact_axis(foot, jet.r, spheres.s[j], direction))) return true;
  // A sphere too large for the hollow is judged as one that just fits (direction_filter.h): within the focal band by
  // two of its widths, so that its directions have second derivatives.
  RadialJet fitted = jet;
  if (foot.k2 * jet.r > 1.0 - kFocalBand) fitted.r = (1.0 - 2.0 * kFocalBand) / foot.k2;
  const AdmissibleDirections at = admissible_directions(foot, fitted);
  const double most = options.slack * options.tolerance_mm;
  for (int k = 0; k < 2 * options.directions; ++k) {
    const double theta = std::numbers::pi * k / options.directions;
    if (direction_error(at, jet, jet.r - fitted.r, theta, spheres.filter.contact_length_mm) > most) continue;
    if (guard.clear(contact_axis(foot, jet.r, spheres.s[j], axis_direction(foot, jet, theta)))) return true;
  }
  return false;
}

/// The questions in the order of their price: a ball, the hollow, directions, and only then whole poses. Without a
/// guard (`screen_meridian`) nothing is in the way.
PlaceScreen screen_place(const Footpoint& foot, const Spheres& spheres, const PoseGuard* guard,
                         const ScreenOptions& options) {
  PlaceScreen place;
  place.reachable = !guard || guard->ball_is_clear(foot.point + guard->ball_radius() * foot.normal);
  if (!place.reachable) return place;
  const double room = foot.k2 > 0.0 ? 1.0 / foot.k2 : kAnyRoom;
  place.fits = spheres.thinnest - room <= options.slack * options.tolerance_mm;
  for (std::size_t j = 0; j < spheres.s.size() && place.fits; ++j) {
    const CandidateDirections found = candidate_directions(foot, spheres.jets[j], spheres.filter);
    place.error_mm = std::min(place.error_mm, found.error_mm);
    if (found.candidate == Candidate::kRejected) continue;
    place.accepted = true;
    place.open = place.open || !guard || is_open(foot, spheres, j, found, *guard, options);
    if (place.open && place.error_mm == 0.0) break;  // no other sphere can do better
  }
  return place;
}

/// The first of the shares that is zero says why the tool cannot work; none: it may.
std::string reason_of(const ToolScreen& screen, const ScreenPlaces& places, const Spheres& spheres,
                      const RadialFunction& radial, const ScreenOptions& options) {
  if (screen.reachable == 0.0)
    return fmt::format(
        "too thick: a ball of its smallest radius, {:.3g} mm, touches the face nowhere without gouging another face",
        spheres.thinnest);
  double widest = 0.0;
  for (const Footpoint& foot : places.feet) widest = std::max(widest, foot.k2 > 0.0 ? 1.0 / foot.k2 : 0.0);
  if (screen.fits == 0.0)
    return fmt::format(
        "the face is concave and needs a tool radius below {:.3g} mm; the smallest of this tool is {:.3g} mm", widest,
        spheres.thinnest);
  if (screen.accepted == 0.0)
    return fmt::format(
        "its profile curvature does not match the face: along its {:.3g} mm the error is at least {:.3g} mm; tools "
        "with an error of up to {:.3g} mm are tried",
        radial.axis_length(), screen.least_error_mm, options.slack * options.tolerance_mm);
  if (screen.open == 0.0)
    return fmt::format(
        "where its profile matches the face ({:.3g} % of the face), flank, shank or holder would collide with the part",
        100.0 * screen.accepted);
  return "";
}

ToolScreen screen(const ScreenPlaces& places, const RadialFunction& radial, const PoseGuard* guard,
                  const ScreenOptions& options) {
  ToolScreen out;
  const Spheres spheres = spheres_of(radial, places, options);
  // Sums run in the places' order below, whatever the threads did.
  std::vector<PlaceScreen> found(places.feet.size());
  parallel_for(found.size(), [&](std::size_t k) { found[k] = screen_place(places.feet[k], spheres, guard, options); });
  double area = 0.0, errors = 0.0;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const PlaceScreen& place = found[k];
    const double a = places.area[k];
    area += a;
    if (!place.reachable) continue;
    out.reachable += a;
    out.fits += place.fits ? a : 0.0;
    out.accepted += place.accepted ? a : 0.0;
    out.open += place.open ? a : 0.0;
    errors += a * place.error_mm;
    out.least_error_mm = std::min(out.least_error_mm, place.error_mm);
  }
  if (out.reachable > 0.0) out.mean_error_mm = errors / out.reachable;
  // Of the whole target, reachable or not: shares of different tools then compare.
  for (double* share : {&out.reachable, &out.fits, &out.accepted, &out.open}) *share /= area;
  out.reason = reason_of(out, places, spheres, radial, options);
  return out;
}

}  // namespace

ScreenPlaces screen_places(const Target& target, int places) {
  ScreenPlaces out;
  out.diagonal_mm = target.diagonal();
  Vec3 mean = Vec3::Zero();
  for (const SurfaceSample& sample : target.samples(std::sqrt(target.area() / places))) {
    out.feet.push_back(target.closest(sample.point));
    out.area.push_back(sample.area);
    mean += sample.point;
  }
  mean /= static_cast<double>(out.feet.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Footpoint& foot : out.feet) spread += (foot.point - mean) * (foot.point - mean).transpose();
  // Eigenvalues ascend: column 0 is about the normal, 2 the longest extent, 1 the width.
  const Vec3 across = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(1);
  double low = 1e300, high = -1e300;
  for (const Footpoint& foot : out.feet) {
    low = std::min(low, across.dot(foot.point));
    high = std::max(high, across.dot(foot.point));
  }
  out.width_mm = high - low;
  return out;
}

ToolScreen screen_tool(const ScreenPlaces& places, const Tool& tool, const Obstacles& obstacles,
                       const ScreenOptions& options) {
  // A line that is refined moves by about what the filter lets it be off.
  const PoseGuard guard(tool, obstacles, -options.slack * options.tolerance_mm);
  return screen(places, tool.radial, &guard, options);
}

ToolScreen screen_meridian(const ScreenPlaces& places, const RadialFunction& radial, const ScreenOptions& options) {
  return screen(places, radial, nullptr, options);
}

}  // namespace flank::internal
