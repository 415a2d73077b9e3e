#include "flank/bound/contact/contact_box.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace flank::internal {
namespace {

constexpr double kRatio = 1.35;  ///< of the distances of two stations from the site
/// Stations of the closer looks, to the length that is of interest, and how far above that length a closer look can decide.
constexpr std::array<double, 2> kFiner = {24.0, 110.0}, kWorth = {1.6, 1.12};
constexpr double kKept = 14.0;  ///< stations whose limits are kept for all beyond them, likewise
constexpr double kWide =
    0.4;  ///< share of the tolerance by which the widths of a box blur it, so that no closer look is worth it
constexpr std::array<double, 3> kInner = {0.98, 0.93,
                                          0.8};  ///< shares of the longest contact for which poses are proposed
constexpr double kRoofShare = 4.0;               ///< of free balls along the axis, to the thickest radius

}  // namespace

BoxSearch::BoxSearch(const ContactQuestion& question, const ContactSite& site, const ContactBox& box)
    : question_(question), site_(site), box_(box) {
  const RadialJet r = question.radial->at(box.station);
  tangent_ = std::cos(box.angle) * site.across + std::sin(box.angle) * site.along;
  side_ = site.normal.cross(tangent_);
  lean_ = r.d1;
  level_ = std::sqrt(1.0 - lean_ * lean_);
  axis_ = level_ * tangent_ + lean_ * site.normal;
  origin_ = site.point + r.r * site.normal;
  lay_stations(back_, box.station + box.half_station, -1.0);
  lay_stations(ahead_, question.length_mm - box.station + box.half_station, 1.0);
  fit_cancelling();
}

Pose BoxSearch::pose(const ContactQuestion& question, const ContactSite& site, const ContactBox& box,
                     const Vec2& move) {
  const RadialJet r = question.radial->at(box.station);
  const double lean = std::clamp(r.d1 + move.y(), -1.0, 1.0);
  const Vec3 tangent = std::cos(box.angle) * site.across + std::sin(box.angle) * site.along;
  const Vec3 axis = std::sqrt(1.0 - lean * lean) * tangent + lean * site.normal;
  return {site.point + (r.r + move.x()) * site.normal - box.station * axis, axis};
}

void BoxSearch::lay_stations(Row& row, double end, double sign) const {
  row.stations.emplace_back();
  for (double d = site_.least_mm; d < 0.98 * end; d *= kRatio) row.stations.emplace_back().sigma = sign * d;
  row.stations.emplace_back().sigma = sign * std::max(end, 0.0);
}

/// More stations where any can be touched, no more than a step apart.
void BoxSearch::add_stations(Row& row, double step) const {
  const std::size_t reached = std::min(row.moves.size(), row.stations.size() - 1);
  std::vector<Station> finer;
  for (std::size_t k = 0; k < row.stations.size(); ++k) {
    if (k > 0 && k <= reached) {
      const double from = row.stations[k - 1].sigma, to = row.stations[k].sigma;
      const int parts = static_cast<int>(std::ceil(std::abs(to - from) / step));
      for (int i = 1; i < parts; ++i) finer.emplace_back().sigma = from + (to - from) * i / parts;
    }
    finer.push_back(row.stations[k]);
  }
  row.stations = std::move(finer);
}

void BoxSearch::look(Station& station) const {
  if (station.ready) return;
  station.ready = true;
  const double s = box_.station + station.sigma;
  const double inside = std::clamp(s, 0.0, question_.length_mm);
  station.clamped = inside != s;
  station.radial = question_.radial->at(inside);
  const double reach = std::abs(station.sigma) * (1.1 * box_.half_angle + site_.slope_max) + 0.1 * question_.thick_mm;
  const double horizon = question_.thick_mm + question_.tolerance_mm + reach;
  station.probe = probe_axis(question_, origin_ + station.sigma * axis_, horizon, kRoofShare * question_.thick_mm);
  station.far = station.probe.far;
  if (station.far) return;
  const Vec3& n = station.probe.normal;
  station.across = n.dot(site_.normal);
  station.side = n.dot(side_);
  station.along = n.dot(tangent_);
  station.turn = station.sigma * level_ * station.side;
}

/// A turn of the axis, and another station at the site, are mostly a rise and a slope, which are free anyway: what is left counts.
void BoxSearch::fit_cancelling() {
  if (!(box_.ahead > box_.back)) return;
  std::array<Station, 3> at;
  for (std::size_t k = 0; k < 3; ++k) {
    at[k].sigma = box_.back + 0.5 * static_cast<double>(k) * (box_.ahead - box_.back);
    look(at[k]);
    if (at[k].far || at[k].clamped || std::abs(at[k].across) < 0.2) return;
  }
  // Of a parabola the chord, half as deep as its middle lies.
  const auto chord = [&](double a, double middle, double b) {
    const double slope = (b - a) / (at[2].sigma - at[0].sigma);
    const double depth = middle - 0.5 * (a + b);
    return Vec2(a - slope * at[0].sigma + 0.5 * depth, slope);
  };
  const auto turn = [&](std::size_t k) { return at[k].turn / at[k].across; };
  const auto slide = [&](std::size_t k) { return at[k].radial.d1 / at[k].across; };
  turn_ = chord(turn(0), turn(1), turn(2));
  slide_ = chord(slide(0), slide(1), slide(2));
}

/// How far the widths of the box move the axis point along the normal in ways that no rise and slope cancel, mm. `perpendicular`: the most
/// that anything moves it along the face, but for `along`, which a rise adds.
double BoxSearch::spread(const Station& station, double& perpendicular, double& along) const {
  const double s = std::abs(station.sigma), h = box_.half_angle;
  const double line = turn_.x() + turn_.y() * station.sigma, slip = slide_.x() + slide_.y() * station.sigma;
  const double angle = std::abs(station.turn / station.across - line) * h;
  const double slide = station.radial.d1 / station.across;
  const double radius = station.clamped ? std::abs(slide) + std::abs(slip) : std::abs(slide - slip);
  perpendicular = s * h;
  along = std::sqrt(std::max(0.0, 1.0 - station.across * station.across));
  // The cosine and the sine of the turn, beyond their first terms.
  const double curved =
      h * h * (0.5 * s * std::abs(station.along) + std::abs(station.turn) * h / 6.0) / std::abs(station.across);
  const double bend = 0.5 * question_.bend * box_.half_station * box_.half_station / std::abs(station.across);
  return angle + radius * box_.half_station + curved + bend;
}

/// Keeps the moves with which some axis of the box touches at this station.
void BoxSearch::cut(Station& station, PosePlane& moves) const {
  look(station);
  const double s = station.sigma, e = question_.tolerance_mm;
  const double cancelled =
      std::abs(turn_.x() + turn_.y() * s) * box_.half_angle + std::abs(slide_.x() + slide_.y() * s) * box_.half_station;
  const double rise = moves.most_rise(s) + cancelled;
  const double slope =
      moves.most_slope() + std::abs(turn_.y()) * box_.half_angle + std::abs(slide_.y()) * box_.half_station;
  // What a change of the lean takes from the axis along the tangent plane.
  const double lean = std::abs(lean_), steep = std::min(1.0, lean + slope);
  const double shorter = slope * (lean + steep) / (level_ + std::sqrt(1.0 - steep * steep));
  if (station.far) {
    const double moved = rise + std::abs(s) * (box_.half_angle + shorter);
    if (station.probe.distance_mm - moved > question_.thick_mm + e) moves = PosePlane();
    return;
  }
  if (std::abs(station.across) < 0.2) return;
  double perpendicular = 0.0, along = 0.0;
  double slack = spread(station, perpendicular, along);
  slack += std::abs(s) * shorter * (std::abs(station.along) + box_.half_angle * std::abs(station.side)) /
           std::abs(station.across);
  perpendicular += along * rise + std::abs(s) * shorter;
  const double to_normal = std::abs(station.across) * (rise + slack), square = 0.5 * perpendicular * perpendicular;
  const AxisProbe& probe = station.probe;
  const double r = station.radial.r;
  double low = -std::numeric_limits<double>::infinity(), high = -low;
  if (probe.distance_mm > to_normal) low = r - e - probe.distance_mm - square / (probe.distance_mm - to_normal);
  const double room = probe.roof_mm - probe.distance_mm - to_normal;
  if (room > 0.0) high = r + e - probe.distance_mm + probe.lack_mm + square / room;
  low /= station.across;
  high /= station.across;
  if (station.across < 0.0) std::swap(low, high);
  moves.cut(s, low - slack, high + slack);
}

/// The moves of one side, station by station, until nothing is left.
void BoxSearch::follow(Row& row) const {
  row.moves.clear();
  const double turn = box_.half_angle, slide = box_.half_station;
  const double rise =
      question_.tolerance_mm + slide * question_.steepest + std::abs(turn_.x()) * turn + std::abs(slide_.x()) * slide;
  const double slope =
      site_.slope_max + slide * question_.bend + std::abs(turn_.y()) * turn + std::abs(slide_.y()) * slide;
  PosePlane kept(1.001 * rise, 1.001 * slope);
  double last = 0.0;
  for (std::size_t k = 0; k + 1 < row.stations.size(); ++k) {
    PosePlane moves = kept;
    cut(row.stations[k], moves);
    if (moves.empty()) return;
    row.moves.push_back(moves);
    // What lies between says hardly more, and would only add corners.
    const double sigma = std::abs(row.stations[k].sigma);
    if (k > 0 && sigma - last < kept_step_) continue;
    kept = moves;
    last = sigma;
  }
}

/// The more of the axis touches behind the site, the less can touch ahead of it.
BoxSearch::Reach BoxSearch::march() {
  follow(back_);
  follow(ahead_);
  Reach best;
  if (ahead_.moves.empty()) return best;
  std::size_t a = ahead_.moves.size() - 1;
  for (std::size_t b = 0; b < back_.moves.size(); ++b) {
    PosePlane both = back_.moves[b];
    both.cut(ahead_.moves[a]);
    while (both.empty() && a > 0) {
      both = back_.moves[b];
      both.cut(ahead_.moves[--a]);
    }
    if (both.empty()) break;
    const double length = ahead_.stations[a + 1].sigma - back_.stations[b + 1].sigma;
    if (length > best.length) best = {b, a, length, both};
  }
  return best;
}

BoxBound BoxSearch::run(double enough_mm) {
  Reach reach = march();
  BoxBound bound = bound_of(reach);
  for (std::size_t k = 0; k < kFiner.size(); ++k) {
    if (reach.length <= enough_mm || bound.by_angle + bound.by_station > kWide * question_.tolerance_mm) break;
    if (reach.length > kWorth[k] * enough_mm && k > 0) break;
    kept_step_ = std::max(enough_mm, site_.least_mm) / kKept;
    add_stations(back_, std::max(enough_mm, site_.least_mm) / kFiner[k]);
    add_stations(ahead_, std::max(enough_mm, site_.least_mm) / kFiner[k]);
    reach = march();
    bound = bound_of(reach);
  }
  return bound;
}

/// The moves with which a little less touches: those with which all does are at the edge of what is possible.
PosePlane BoxSearch::inner_moves(const Reach& reach, double share) const {
  const auto inner = [share](const Row& row, std::size_t last) {
    const double most = share * std::abs(row.stations[last].sigma);
    while (last > 0 && std::abs(row.stations[last].sigma) > most) --last;
    return row.moves[last];
  };
  PosePlane moves = inner(back_, reach.back);
  moves.cut(inner(ahead_, reach.ahead));
  return moves.empty() ? reach.moves : moves;
}

BoxBound BoxSearch::bound_of(const Reach& reach) const {
  BoxBound bound;
  if (reach.length < 0.0) return bound;
  bound.most_mm = std::min(reach.length, question_.length_mm);
  const Station& from = back_.stations[reach.back];
  const Station& to = ahead_.stations[reach.ahead];
  bound.back = from.sigma;
  bound.ahead = to.sigma;
  for (std::size_t k = 0; k < kInner.size(); ++k) bound.moves[k] = inner_moves(reach, kInner[k]).middle();
  for (const Station* end : {&from, &to}) {
    if (end->far || std::abs(end->across) < 0.2) continue;
    const double line = turn_.x() + turn_.y() * end->sigma, slip = slide_.x() + slide_.y() * end->sigma;
    const double moved = end->sigma * box_.half_angle;
    bound.by_angle = std::max(bound.by_angle, std::abs(end->turn / end->across - line) * box_.half_angle +
                                                  0.5 * moved * moved / end->probe.distance_mm);
    bound.by_station = std::max(bound.by_station, std::abs(end->radial.d1 / end->across - slip) * box_.half_station +
                                                      0.5 * question_.bend * box_.half_station * box_.half_station);
  }
  return bound;
}

}  // namespace flank::internal
