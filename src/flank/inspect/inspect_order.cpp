#include "flank/inspect/inspect_order.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "flank/error.h"

namespace flank::internal {
namespace {

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k)
    text += (k == 0 ? "" : k + 1 == words.size() ? " or " : ", ") + words[k];
  return text;
}

void keep_type(const std::string& type, std::vector<InspectRow>& rows) {
  std::set<std::string> types;
  for (const InspectRow& row : rows) types.insert(row.type);
  std::erase_if(rows, [&](const InspectRow& row) { return lower(row.type) != lower(type); });
  if (rows.empty()) throw UsageError("type", type, "must be " + listed({types.begin(), types.end()}));
}

}  // namespace

const std::vector<std::string>& sorts() {
  static const std::vector<std::string> kSorts{"face", "area", "radius", "type"};
  return kSorts;
}

void arrange(const InspectOrder& order, std::vector<InspectRow>& rows) {
  if (!order.type.empty()) keep_type(order.type, rows);
  const auto by = [&](const auto& before) { std::stable_sort(rows.begin(), rows.end(), before); };
  if (order.sort == "area")
    by([](const InspectRow& a, const InspectRow& b) { return a.area_mm2 > b.area_mm2; });
  else if (order.sort == "radius")
    by([](const InspectRow& a, const InspectRow& b) {
      return a.smallest_concave_radius_mm < b.smallest_concave_radius_mm;
    });
  else if (order.sort == "type")
    by([](const InspectRow& a, const InspectRow& b) { return a.type < b.type; });
  else if (!order.sort.empty() && order.sort != "face")
    throw UsageError("sort", order.sort, "must be " + listed(sorts()));
}

}  // namespace flank::internal
