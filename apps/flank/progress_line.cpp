#include "progress_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace flank::cli {
namespace {

/// What a pace needs: less may be a step that was finished at once.
constexpr double kLeastSeconds = 2.0, kLeastShare = 0.05;
constexpr int kLeastMoments = 3;
/// Of a new moment in the mean: the last five or so count.
constexpr double kFollow = 0.3;
/// Of the time that is left: moments that differ by more do not agree.
constexpr double kAgree = 0.5;

}  // namespace

void TimeLeft::report(double seconds, double share) {
  if (share_ < 0.0 || share < share_) {
    *this = {};
    begin_seconds_ = at_seconds_ = seconds;
    begin_share_ = share_ = share;
    return;
  }
  at_seconds_ = seconds;
  if (share == share_) return;  // another stage begins: nothing is known of the pace
  share_ = share;
  const double moment = seconds + (1.0 - share) * (seconds - begin_seconds_) / (share - begin_share_);
  const double weight = moments_ == 0 ? 1.0 : kFollow;
  spread_ += weight * (std::abs(moment - (moments_ == 0 ? moment : done_at_)) - spread_);
  done_at_ += weight * (moment - done_at_);
  ++moments_;
}

std::optional<double> TimeLeft::seconds(double seconds) const {
  if (moments_ < kLeastMoments || share_ - begin_share_ < kLeastShare) return {};
  if (at_seconds_ - begin_seconds_ < kLeastSeconds) return {};
  const double left = done_at_ - seconds;
  if (left <= 0.0 || spread_ > kAgree * (done_at_ - at_seconds_)) return {};
  return left;
}

std::string time_left_text(double seconds) {
  constexpr double kMinute = 60.0, kHour = 3600.0;
  if (seconds < 10.0) return "a few seconds left";
  // In steps of which an estimate can be right.
  if (seconds < 1.5 * kMinute) return fmt::format("about {:.0f} s left", 5.0 * std::round(seconds / 5.0));
  if (seconds < 1.5 * kHour) return fmt::format("about {:.0f} min left", std::round(seconds / kMinute));
  return fmt::format("about {:.1f} h left", seconds / kHour);
}

void ProgressLine::found(const BestSoFar& found) {
  const auto goes_before = [](const BestSoFar& a, const BestSoFar& b) {
    if (a.clean == b.clean) return a.coverage > b.coverage;
    return a.clean ? a.coverage >= 0.5 * b.coverage : b.coverage < 0.5 * a.coverage;
  };
  if (!best_ || goes_before(found, *best_)) best_ = found;
}

std::string ProgressLine::line(std::string_view stage, double share, double seconds) {
  left_.report(seconds, share);
  std::string line = fmt::format("{} {:3.0f} %", stage, 100.0 * share);
  if (best_) line += fmt::format(", best {:.1f} %", 100.0 * best_->coverage);
  if (best_ && !best_->clean) line += fmt::format(", gouging by {:.3g} mm", best_->deepest_mm);
  if (const std::optional<double> left = left_.seconds(seconds)) line += ", " + time_left_text(*left);
  return line;
}

std::string ProgressLine::json(std::string_view stage, double share, double seconds) {
  left_.report(seconds, share);
  most_ = std::clamp(share, most_, 1.0);
  const auto rounded = [](double value, double step) { return std::round(value / step) * step; };
  nlohmann::ordered_json json = {{"stage", stage}, {"share", std::round(most_ * 1e4) / 1e4}, {"eta_s", nullptr}};
  if (const std::optional<double> left = left_.seconds(seconds)) json["eta_s"] = rounded(*left, 1.0);
  json["best"] = nullptr;
  if (best_)
    json["best"] = {{"coverage", std::round(best_->coverage * 1e5) / 1e5},
                    {"deepest_mm", std::isfinite(best_->deepest_mm) ? nlohmann::ordered_json(best_->deepest_mm)
                                                                    : nlohmann::ordered_json()},
                    {"clean", best_->clean}};
  return json.dump();
}

}  // namespace flank::cli
