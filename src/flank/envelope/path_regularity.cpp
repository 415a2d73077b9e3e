#include "flank/envelope/path_regularity.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "flank/envelope.h"

namespace flank::internal {
namespace {

constexpr int kSamples = 24;  ///< steps along the axis

}  // namespace

double largest_c(const Pose& from, const Pose& to, const RadialFunction& radial, const Touches& touches, double known) {
  AxisJet axis;
  axis.tip = 0.5 * (from.tip + to.tip);
  axis.u = (from.axis + to.axis).normalized();
  axis.tip_d1 = to.tip - from.tip;
  axis.u_d1 = to.axis - from.axis;
  axis.u_d1 -= axis.u_d1.dot(axis.u) * axis.u;
  struct Place {
    double c = 0.0, s = 0.0, r = 0.0;
  };
  std::array<Place, kSamples + 1> places;
  for (int j = 0; j <= kSamples; ++j) {
    const double s = radial.axis_length() * j / kSamples;
    const RadialJet r = radial.at(s);
    places[static_cast<std::size_t>(j)] = {std::abs(contact_point(axis, r, s, +1).c), s, r.r};
  }
  // The largest first: whether a ball touches costs far more than its c.
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.c > b.c; });
  for (const Place& p : places) {
    if (!(p.c > known)) break;
    if (!touches || touches(axis.tip + p.s * axis.u, p.r)) return p.c;
  }
  return known;
}

double largest_c(const Path& path, const RadialFunction& radial, const Touches& touches) {
  double largest = 0.0;
  for (const Strip& strip : path.strips)
    for (std::size_t i = 0; i + 1 < strip.poses.size(); ++i)
      largest = largest_c(strip.poses[i], strip.poses[i + 1], radial, touches, largest);
  return largest;
}

}  // namespace flank::internal
