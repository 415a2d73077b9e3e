#include "flank/example/example_rotor37_table.h"

#include <cmath>
#include <iterator>

namespace flank::internal {
namespace {

constexpr double kMmPerCm = 10.0;

struct Row {
  int section, station;
  double z_cm, radius_cm, theta_1_rad, theta_2_rad;
};
struct HubRow {
  double z_cm, radius_cm;
};

// Made by cmake/rotor37_table.cmake from share/examples.
constexpr Row kRows[] = {
#include <rotor37_blade.inc>
};
constexpr HubRow kHubRows[] = {
#include <rotor37_hub.inc>
};
static_assert(std::size(kRows) == std::size_t{kRotor37Sections} * kRotor37Stations);

}  // namespace

Vec3 Rotor37Station::point(int side) const {
  const double theta = theta_rad[static_cast<std::size_t>(side)];
  return {z_mm, radius_mm * std::cos(theta), radius_mm * std::sin(theta)};
}

Rotor37Section rotor37_section(int section) {
  Rotor37Section stations;
  for (const Row& row : kRows)
    if (row.section == section + 1)
      stations.push_back({kMmPerCm * row.z_cm, kMmPerCm * row.radius_cm, {row.theta_1_rad, row.theta_2_rad}});
  return stations;
}

std::vector<Vec2> rotor37_hub() {
  std::vector<Vec2> points;
  for (const HubRow& row : kHubRows) points.emplace_back(kMmPerCm * row.z_cm, kMmPerCm * row.radius_cm);
  return points;
}

}  // namespace flank::internal
