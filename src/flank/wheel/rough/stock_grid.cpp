#include "flank/wheel/rough/stock_grid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/base/parallel.h"

namespace flank::internal {
namespace {

constexpr double kFarCells = 2.0;
constexpr double kStepShare = 0.25;  ///< of the tip's radius, between poses that are cut
constexpr int kSteps = 20;           ///< of half of a circle
constexpr double kStillMm = 1e-9;

}  // namespace

StockGrid::StockGrid(const Box3& box, double cell_mm, const std::function<double(const Vec3&)>& depth)
    : cell_(cell_mm), far_(kFarCells * cell_mm), low_(box.low) {
  for (int k = 0; k < 3; ++k)
    count_[static_cast<std::size_t>(k)] = 2 + static_cast<int>(std::ceil((box.high[k] - box.low[k]) / cell_));
  depths_.resize(static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) *
                 static_cast<std::size_t>(count_[2]));
  parallel_for(static_cast<std::size_t>(count_[0]), [&](std::size_t x) {
    for (int y = 0; y < count_[1]; ++y)
      for (int z = 0; z < count_[2]; ++z) {
        const Vec3 p = low_ + cell_ * Vec3(static_cast<double>(x), y, z);
        depths_[index(static_cast<int>(x), y, z)] = static_cast<float>(std::clamp(depth(p), -far_, far_));
      }
  });
}

double StockGrid::depth(const Vec3& p) const {
  const Vec3 q = (p - low_) / cell_;
  std::array<int, 3> at{};
  Vec3 t;
  for (int k = 0; k < 3; ++k) {
    const double floor = std::floor(q[k]);
    if (!(floor >= 0.0 && floor < count_[static_cast<std::size_t>(k)] - 1)) return -far_;
    at[static_cast<std::size_t>(k)] = static_cast<int>(floor), t[k] = q[k] - floor;
  }
  const auto row = [&](int dx, int dy) {
    const std::size_t n = index(at[0] + dx, at[1] + dy, at[2]);
    return std::lerp(static_cast<double>(depths_[n]), static_cast<double>(depths_[n + 1]), t.z());
  };
  return std::lerp(std::lerp(row(0, 0), row(0, 1), t.y()), std::lerp(row(1, 0), row(1, 1), t.y()), t.x());
}

void StockGrid::cut(const Cutter& cutter, const Pose& from, const Pose& to) {
  const double way = std::max((to.tip - from.tip).norm(), (to.at(cutter.length()) - from.at(cutter.length())).norm());
  const int steps = std::max(1, static_cast<int>(std::ceil(way / (kStepShare * cutter.tip()))));
  for (int k = 1; k <= steps; ++k) {
    const double t = static_cast<double>(k) / steps;
    cut(cutter, {from.tip + t * (to.tip - from.tip), (from.axis + t * (to.axis - from.axis)).normalized()});
  }
}

void StockGrid::cut(const Cutter& cutter, const Pose& pose) {
  int main = 0;
  pose.axis.cwiseAbs().maxCoeff(&main);
  const double along = pose.axis[main];
  const double tilt = std::sqrt(std::max(0.0, 1.0 - along * along)) / std::abs(along);
  const int one = (main + 1) % 3, two = (main + 2) % 3;
  const double a = pose.tip[main], b = a + cutter.length() * along;
  const auto clip = [&](double x, int k) {
    return static_cast<int>(std::clamp(x, 0.0, count_[static_cast<std::size_t>(k)] - 1.0));
  };
  const auto cell = [&](double mm, int k) { return (mm - low_[k]) / cell_; };
  const double beyond = cutter.largest() + far_;
  for (int i = clip(std::ceil(cell(std::min(a, b) - beyond, main)), main),
           end = clip(std::floor(cell(std::max(a, b) + beyond, main)), main);
       i <= end; ++i) {
    const double height = low_[main] + cell_ * i;
    const double s = (height - a) / along;
    const Vec3 middle = pose.at(s);
    // Across the main direction a tool that leans is longer than wide, and thicker where it goes on above.
    const double reach = (cutter.largest_near(s, cutter.largest() * tilt) + far_) / std::abs(along);
    std::array<int, 3> at{};
    at[static_cast<std::size_t>(main)] = i;
    for (int j = clip(std::ceil(cell(middle[one] - reach, one)), one),
             j_end = clip(std::floor(cell(middle[one] + reach, one)), one);
         j <= j_end; ++j)
      for (int k = clip(std::ceil(cell(middle[two] - reach, two)), two),
               k_end = clip(std::floor(cell(middle[two] + reach, two)), two);
           k <= k_end; ++k) {
        at[static_cast<std::size_t>(one)] = j, at[static_cast<std::size_t>(two)] = k;
        float& here = depths_[index(at[0], at[1], at[2])];
        if (here <= static_cast<float>(-far_)) continue;
        const Vec3 off = low_ + cell_ * Vec3(at[0], at[1], at[2]) - pose.tip;
        const double z = off.dot(pose.axis), across = std::sqrt(std::max(0.0, off.squaredNorm() - z * z));
        here = std::min(here, static_cast<float>(std::max(-far_, cutter.distance(z, across))));
      }
  }
}

bool StockGrid::meets(const Cutter& cutter, const Pose& pose) const {
  constexpr int kRound = 8;
  constexpr double kLeastCells = 0.2;
  const Vec3 x = pose.axis.unitOrthogonal(), y = pose.axis.cross(x);
  const auto meets = [&](const Vec3& p) { return depth(p) > kLeastCells * cell_; };
  if (meets(pose.at(-cutter.tip()))) return true;
  for (int k = 0; k < kRound; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kRound;
    const Vec3 out = std::cos(angle) * x + std::sin(angle) * y;
    if (meets(pose.tip + std::numbers::sqrt2 / 2.0 * cutter.tip() * (out - pose.axis))) return true;
    for (const Cutter::Circle& circle : cutter.circles())
      if (meets(pose.at(circle.middle) + circle.radius * out)) return true;
  }
  return false;
}

double StockGrid::engagement(const Cutter& cutter, const Pose& from, const Pose& to) const {
  double most = 0.0;
  for (const Cutter::Circle& circle : cutter.circles()) {
    Vec3 ahead = to.at(circle.s) - from.at(circle.s);
    ahead -= ahead.dot(to.axis) * to.axis;
    if (ahead.norm() < kStillMm) continue;
    ahead.normalize();
    const Vec3 middle = to.at(circle.middle), aside = to.axis.cross(ahead);
    const double step = std::numbers::pi / kSteps;
    double in = 0.0, last = 0.0;
    for (int k = 0; k <= kSteps; ++k) {
      const double angle = k * step - 0.5 * std::numbers::pi;
      const double here = depth(middle + circle.radius * (std::cos(angle) * ahead + std::sin(angle) * aside));
      if (k > 0 && (last > 0.0 || here > 0.0))
        in += last > 0.0 && here > 0.0 ? step
                                       : step * std::max(last, here) / (std::max(last, here) - std::min(last, here));
      last = here;
    }
    most = std::max(most, in);
  }
  return most;
}

}  // namespace flank::internal
