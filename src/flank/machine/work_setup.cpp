#include "flank/machine/work_setup.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>
#include <vector>

#include "flank/error.h"

namespace flank::internal {
namespace {

constexpr double kFarMm = 1e6, kFarDegrees = 1e4;  // what is beyond is a slip of the keyboard

/// One message for all that can be wrong: the whole form is short enough to be shown.
[[noreturn]] void refuse(const std::string& text) {
  throw UsageError("setup", text,
                   "expected x,y,z,a,b,c: where the part's origin sits on the table, mm, and how it is turned about X, "
                   "then Y, then Z, degrees");
}

/// Numbers between commas, blanks allowed. By from_chars, which reads the same in every locale, and never "nan" as a
/// place.
std::vector<double> read_numbers(const std::string& text) {
  std::vector<double> values;
  const char *at = text.data(), *end = text.data() + text.size();
  while (true) {
    while (at != end && *at == ' ') ++at;
    double value = 0.0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || !std::isfinite(value)) refuse(text);
    values.push_back(value);
    at = next;
    while (at != end && *at == ' ') ++at;
    if (at == end) return values;
    if (*at++ != ',') refuse(text);
  }
}

}  // namespace

Eigen::Matrix3d WorkSetup::rotation() const {
  constexpr double kRadians = std::numbers::pi / 180.0;
  return (Eigen::AngleAxisd(angles_deg[2] * kRadians, Vec3::UnitZ()) *
          Eigen::AngleAxisd(angles_deg[1] * kRadians, Vec3::UnitY()) *
          Eigen::AngleAxisd(angles_deg[0] * kRadians, Vec3::UnitX()))
      .toRotationMatrix();
}

Pose WorkSetup::to_work(const Pose& part) const {
  const Eigen::Matrix3d r = rotation();
  return {r * part.tip + translation, r * part.axis};
}

Pose WorkSetup::to_part(const Pose& work) const {
  const Eigen::Matrix3d r = rotation();
  return {r.transpose() * (work.tip - translation), r.transpose() * work.axis};
}

WorkSetup parse_setup(const std::string& text) {
  // Three numbers leave the part as it is turned in its file.
  const std::vector<double> values = read_numbers(text);
  if (values.size() != 3 && values.size() != 6) refuse(text);
  WorkSetup setup;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (std::abs(values[k]) > (k < 3 ? kFarMm : kFarDegrees)) refuse(text);
    if (k < 3)
      setup.translation(static_cast<int>(k)) = values[k];
    else
      setup.angles_deg[k - 3] = values[k];
  }
  return setup;
}

std::string setup_text(const WorkSetup& setup) {
  const Vec3& t = setup.translation;
  const auto& a = setup.angles_deg;
  return fmt::format("{},{},{},{},{},{}", t.x(), t.y(), t.z(), a[0], a[1], a[2]);
}

}  // namespace flank::internal
