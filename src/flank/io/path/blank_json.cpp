#include "flank/io/path/blank_json.h"

#include <fmt/format.h>

#include <cmath>

#include "flank/io/text/json_input.h"

namespace flank::internal {
namespace {

constexpr std::string_view kSchema = "openflank/blank/1";
constexpr double kUnit = 1e-9;

}  // namespace

std::string blank_to_json(const std::vector<HalfSpace>& blank) {
  std::string text = fmt::format("{{\n  \"schema\": \"{}\",\n  \"units\": \"mm\",\n  \"planes\": [", kSchema);
  for (std::size_t k = 0; k < blank.size(); ++k) {
    const HalfSpace& h = blank[k];
    text += fmt::format("{}\n    [{}, {}, {}, {}]", k == 0 ? "" : ",", exact_number(h.normal.x()),
                        exact_number(h.normal.y()), exact_number(h.normal.z()), exact_number(h.offset));
  }
  return text + "\n  ]\n}\n";
}

std::vector<HalfSpace> blank_from_json(std::string_view text, const std::string& file) {
  const JsonInput in(file, text);
  in.require_schema(kSchema);
  in.allow_keys({"schema", "units", "planes"});
  const JsonInput planes = in.member("planes");
  std::vector<HalfSpace> blank;
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const std::vector<double> v = planes.element(k).numbers(4);
    blank.push_back({{v[0], v[1], v[2]}, v[3]});
    const double length = blank.back().normal.norm();
    if (!(std::abs(length - 1.0) <= kUnit))
      planes.element(k).refuse(fmt::format("the normal of a plane has length {}; must be 1", length));
  }
  return blank;
}

}  // namespace flank::internal
