#include "flank/wheel/point/flank_joints.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {

std::optional<FlankJoints::Shift> FlankJoints::joint_at(std::size_t line, double place, const Left& left) const {
  constexpr double kAlike = 0.9;  // the least cosine between normals of faces that go on smoothly into each other
  const std::optional<FaceLines::Place> here = lines_.at(line, place);
  if (!here) return {};
  const std::optional<SurfaceLeft> found = left(here->point);
  if (!found || found->normal.dot(here->normal) < kAlike) return {};
  return Shift{(tip_mm_ + found->height_mm) * found->normal - lift_mm_ * here->normal,
               std::max(0.0, -found->height_mm)};
}

/// Where the flank ends, the pass comes back to its own face little by little: a step along it would be a kink.
FlankJoints::Border FlankJoints::border_of(std::size_t line, const Left& left) const {
  constexpr std::ptrdiff_t kFade = 32;
  const std::size_t count = (lines_.places() - 1) * kSteps + 1;
  const auto place = [](std::size_t k) { return static_cast<double>(k) / static_cast<double>(kSteps); };
  std::vector<std::optional<Shift>> joints(count);
  for (std::size_t k = 0; k < count; ++k) joints[k] = joint_at(line, place(k), left);
  const auto faded = [&](std::size_t k) -> std::optional<Shift> {
    for (std::ptrdiff_t far = 0; far < kFade; ++far)
      for (const std::ptrdiff_t sign : {1, -1}) {
        const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(k) + sign * far;
        if (at < 0 || at >= static_cast<std::ptrdiff_t>(count)) continue;
        const double share = 1.0 - static_cast<double>(far) / static_cast<double>(kFade);
        if (const auto& found = joints[static_cast<std::size_t>(at)])
          return Shift{share * found->moved, share * found->deeper_mm};
      }
    return {};
  };
  Border out(count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::optional<Shift> shift = faded(k);
    const std::optional<FaceLines::Place> here = lines_.at(line, place(k));
    if (!shift) continue;
    out[k].shift = *shift;
    if (here) out[k].place = here->point, out[k].off_mm = (lift_mm_ * here->normal + shift->moved).norm();
  }
  return out;
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

bool FlankJoints::joins(std::size_t line, std::size_t place) const {
  const auto flank_is_near = [&](const Border& border) {
    return place * kSteps < border.size() && border[place * kSteps].off_mm > 0.0;
  };
  return (line == 0 && flank_is_near(borders_[0])) || (line + 1 == moves_.size() && flank_is_near(borders_[1]));
}

FlankJoints::Shift FlankJoints::on_border(const Border& border, double place) const {
  const double step = std::clamp(place * static_cast<double>(kSteps), 0.0, static_cast<double>(border.size()) - 1.0);
  const auto k = static_cast<std::size_t>(step);
  const double t = step - static_cast<double>(k);
  const Shift &a = border[k].shift, &b = border[std::min(k + 1, border.size() - 1)].shift;
  return {(1.0 - t) * a.moved + t * b.moved, (1.0 - t) * a.deeper_mm + t * b.deeper_mm};
}

/// So far along its normal the sphere keeps off the border's places as the passes there do, and `more_mm` farther.
double FlankJoints::up_to_clear(double place, const FaceLines::Place& here, double more_mm) const {
  const Vec3 center = here.point + lift_mm_ * here.normal;
  const auto middle = static_cast<std::ptrdiff_t>(std::lround(place * static_cast<double>(kSteps)));
  double up = 0.0;
  for (const Border& border : borders_)
    for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(0, middle - kBeside);
         k <= std::min(middle + kBeside, static_cast<std::ptrdiff_t>(border.size()) - 1); ++k) {
      const Step& step = border[static_cast<std::size_t>(k)];
      if (step.off_mm == 0.0) continue;
      const Vec3 off = center - step.place;
      const double along = off.dot(here.normal), least = step.off_mm + more_mm,
                   inside = along * along - off.squaredNorm() + least * least;
      if (inside > 0.0) up = std::max(up, std::sqrt(inside) - along);
    }
  return up;
}

FlankJoints::Shift FlankJoints::at(std::size_t line, double place, const FaceLines::Place& here) const {
  if (moves_[line] == 0) return {};
  if (line == 0) return on_border(borders_[0], place);
  if (line + 1 == moves_.size()) return on_border(borders_[1], place);
  return {up_to_clear(place, here, kMarginMm) * here.normal, 0.0};
}

}  // namespace flank::internal
