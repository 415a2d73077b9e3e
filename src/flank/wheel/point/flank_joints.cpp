#include "flank/wheel/point/flank_joints.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {

namespace {

constexpr double kTurnRad = 1e-3;    ///< that what the flank has left may turn from stop to stop of a border
constexpr double kFinest = 1e-3;     ///< places between stops, at least: half a micrometre
constexpr double kSlope = 0.07;      ///< of a pass to its own line, over a stop, from which nearer ones may double it
constexpr double kFadePlaces = 4.0;  ///< beyond the flank's end, in which a pass comes back to its own face

}  // namespace

std::optional<FlankJoints::Joint> FlankJoints::joint_at(std::size_t line, double place, const Left& left) const {
  constexpr double kAlike = 0.9;  // the least cosine between normals of faces that go on smoothly into each other
  const std::optional<FaceLines::Place> here = lines_.at(line, place);
  if (!here) return {};
  const std::optional<SurfaceLeft> found = left(here->point);
  if (!found || found->normal.dot(here->normal) < kAlike) return {};
  return Joint{
      {(tip_mm_ + found->height_mm) * found->normal - lift_mm_ * here->normal, std::max(0.0, -found->height_mm)},
      found->normal};
}

/// The stops between two, as near as the flank's surface turns, and as where it ends.
void FlankJoints::refine(std::size_t line, const Stop& from, const Stop& to, const Left& left, Border& out) const {
  if (to.at - from.at < 2.0 * kFinest || (!from.joint && !to.joint)) return;
  if (from.joint && to.joint && (from.joint->normal - to.joint->normal).norm() <= kTurnRad) return;
  if (from.joint && to.joint) {
    // Where the flank's surface has an edge, the sphere would have to jump along it: nearer stops would make a corner of that.
    const auto a = lines_.at(line, from.at), b = lines_.at(line, to.at);
    if (!a || !b || (from.joint->shift.moved - to.joint->shift.moved).norm() > kSlope * (a->point - b->point).norm())
      return;
  }
  const double at = 0.5 * (from.at + to.at);
  const Stop middle{.at = at, .joint = joint_at(line, at, left)};
  refine(line, from, middle, left, out);
  out.push_back(middle);
  refine(line, middle, to, left, out);
}

/// Where the flank ends, the pass comes back to its own face little by little: a step along it would be a kink.
FlankJoints::Border FlankJoints::border_of(std::size_t line, const Left& left) const {
  Border out;
  for (std::size_t k = 0; k < (lines_.places() - 1) * kSteps + 1; ++k) {
    const double at = static_cast<double>(k) / static_cast<double>(kSteps);
    const Stop stop{.at = at, .joint = joint_at(line, at, left)};
    if (k > 0) refine(line, Stop(out.back()), stop, left, out);
    out.push_back(stop);
  }
  for (std::size_t k = 0; k < out.size(); ++k) {
    const Stop* near = nearest_joint(out, k);
    const std::optional<FaceLines::Place> here = lines_.at(line, out[k].at);
    if (near == nullptr) continue;
    const double share = 1.0 - std::abs(near->at - out[k].at) / kFadePlaces;
    out[k].shift = {share * near->joint->shift.moved, share * near->joint->shift.deeper_mm};
    if (here) out[k].place = here->point, out[k].off_mm = (lift_mm_ * here->normal + out[k].shift.moved).norm();
  }
  return out;
}

/// The nearest stop before or after one, itself too, where the flank has left something; null: none is near.
const FlankJoints::Stop* FlankJoints::nearest_joint(const Border& border, std::size_t k) {
  const Stop* near = nullptr;
  double least = kFadePlaces;
  for (std::size_t i = k + 1; i-- > 0 && near == nullptr && border[k].at - border[i].at < least;)
    if (border[i].joint) near = &border[i], least = border[k].at - border[i].at;
  for (std::size_t i = k; i < border.size() && border[i].at - border[k].at < least; ++i)
    if (border[i].joint) return &border[i];
  return near;
}

FlankJoints::FlankJoints(const FaceLines& lines, const TipRoom& room, const Left& left)
    : lines_(lines), tip_mm_(room.tip_mm()), lift_mm_(room.lift_mm()), moves_(lines.lines(), 0) {
  if (!left || lines.lines() == 0) return;
  borders_ = {border_of(0, left), border_of(lines.lines() - 1, left)};
  moves_.front() = moves_.back() = 1;
  for (std::size_t n = 1; n + 1 < moves_.size(); ++n)
    for (std::size_t k = 0; k < lines.places() && moves_[n] == 0; ++k)
      if (const auto here = lines.at(n, static_cast<double>(k)))
        moves_[n] = up_to_clear(static_cast<double>(k), *here, kNearMm) > 0.0 ? 1 : 0;
}

const FlankJoints::Border* FlankJoints::border(std::size_t line) const {
  if (moves_[line] == 0) return nullptr;
  return line == 0 ? &borders_[0] : line + 1 == moves_.size() ? &borders_[1] : nullptr;
}

FlankJoints::Border::const_iterator FlankJoints::first_from(const Border& border, double place) {
  return std::lower_bound(border.begin(), border.end(), place,
                          [](const Stop& stop, double at) { return stop.at < at; });
}

bool FlankJoints::joins(std::size_t line, std::size_t place) const {
  const Border* own = border(line);
  if (own == nullptr) return false;
  const auto stop = first_from(*own, static_cast<double>(place));
  return stop != own->end() && stop->off_mm > 0.0;
}

std::vector<double> FlankJoints::stops(std::size_t line) const {
  std::vector<double> out;
  if (const Border* own = border(line)) {
    for (const Stop& stop : *own) out.push_back(stop.at);
    return out;
  }
  const std::size_t steps = moves_[line] != 0 ? kSteps : 1;
  for (std::size_t k = 0; k < (lines_.places() - 1) * steps + 1; ++k)
    out.push_back(static_cast<double>(k) / static_cast<double>(steps));
  return out;
}

FlankJoints::Shift FlankJoints::on_border(const Border& border, double place) {
  const auto after = first_from(border, place);
  if (after == border.begin()) return border.front().shift;
  if (after == border.end()) return border.back().shift;
  const Stop &a = *(after - 1), &b = *after;
  const double t = (place - a.at) / (b.at - a.at);
  return {(1.0 - t) * a.shift.moved + t * b.shift.moved, (1.0 - t) * a.shift.deeper_mm + t * b.shift.deeper_mm};
}

/// So far along its normal the sphere keeps off the border's places as the passes there do, and `more_mm` farther.
double FlankJoints::up_to_clear(double place, const FaceLines::Place& here, double more_mm) const {
  const Vec3 center = here.point + lift_mm_ * here.normal;
  double up = 0.0;
  for (const Border& border : borders_)
    for (auto stop = first_from(border, place - kBeside); stop != border.end() && stop->at <= place + kBeside; ++stop) {
      if (stop->off_mm == 0.0) continue;
      const Vec3 off = center - stop->place;
      const double along = off.dot(here.normal), least = stop->off_mm + more_mm,
                   inside = along * along - off.squaredNorm() + least * least;
      if (inside > 0.0) up = std::max(up, std::sqrt(inside) - along);
    }
  return up;
}

FlankJoints::Shift FlankJoints::at(std::size_t line, double place, const FaceLines::Place& here) const {
  if (moves_[line] == 0) return {};
  if (const Border* own = border(line)) return on_border(*own, place);
  return {up_to_clear(place, here, kMarginMm) * here.normal, 0.0};
}

}  // namespace flank::internal
