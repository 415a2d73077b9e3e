#include "flank/io/text/read_unit.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "flank/error.h"

namespace flank::internal {
namespace {

constexpr std::array<std::pair<const char*, double>, 9> kUnits = {{{"mm", 1.0},
                                                                   {"cm", 10.0},
                                                                   {"m", 1000.0},
                                                                   {"in", 25.4},
                                                                   {"ft", 304.8},
                                                                   {"um", 1e-3},
                                                                   {"km", 1e6},
                                                                   {"dm", 100.0},
                                                                   {"mil", 0.0254}}};
constexpr std::size_t kAcceptedUnits = 4;  ///< the first of kUnits may be asked for by name

}  // namespace

double millimetres_per(const std::string& unit) {
  for (std::size_t i = 0; i < kAcceptedUnits; ++i)
    if (unit == kUnits[i].first) return kUnits[i].second;
  throw UsageError("unit", unit, "expected mm, cm, m or in");
}

std::string unit_of(double millimetres) {
  for (const auto& [name, size] : kUnits)
    if (std::abs(millimetres - size) <= 1e-6 * size) return name;
  return fmt::format("{:g} mm", millimetres);
}

}  // namespace flank::internal
