#include "flank/wheel/plan_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "flank/base/atomic_file.h"
#include "flank/error.h"
#include "flank/io/text/json_dump.h"
#include "flank/io/text/json_input.h"
#include "flank/wheel/sector.h"

namespace flank::internal {
namespace {

constexpr const char* kSchema = "openflank/plan/1";

std::vector<double> list_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

nlohmann::ordered_json operation_json(const WheelOperation& o, int copies) {
  nlohmann::ordered_json json{{"id", o.id},
                              {"kind", o.kind},
                              {"tool", o.tool},
                              {"folder", o.folder},
                              {"copies", o.copies > 0 ? o.copies : copies},
                              {"faces", o.faces},
                              {"done", o.done},
                              {"pass", o.pass},
                              {"key", o.key}};
  if (!o.problem.empty()) json["problem"] = o.problem;
  return json;
}

/// Those that an operation uses, in their order.
nlohmann::ordered_json tools_json(const WheelResult& result) {
  std::set<std::string> ids{"T1"};
  for (const WheelOperation& operation : result.operations) ids.insert(operation.tool);
  auto list = nlohmann::ordered_json::array();
  for (const std::string& id : ids) list.push_back({{"id", id}, {"file", "tools/" + id + ".json"}});
  return list;
}

nlohmann::ordered_json figures_json(const std::vector<RoleFigures>& figures) {
  auto list = nlohmann::ordered_json::array();
  for (const RoleFigures& f : figures)
    list.push_back({{"role", f.role},
                    {"area_mm2", f.area_mm2},
                    {"open_mm2", f.open_mm2},
                    {"within_mm2", f.within_mm2},
                    {"deepest_cut_mm", f.cut_mm},
                    {"most_left_mm", f.left_mm}});
  return list;
}

nlohmann::ordered_json rest_json(const std::vector<RestPlace>& rest) {
  auto list = nlohmann::ordered_json::array();
  for (const RestPlace& place : rest)
    list.push_back({{"face", place.face},
                    {"point_mm", list_of(place.point)},
                    {"area_mm2", place.area_mm2},
                    {"depth_mm", place.depth_mm},
                    {"reason", place.reason}});
  return list;
}

nlohmann::ordered_json roughing_json(const JudgedRoughing& roughing) {
  const StockReport& stock = roughing.stock;
  nlohmann::ordered_json json{{"deepest_cut_mm", roughing.cuts.gouge_mm},
                              {"cut_bound_mm", roughing.cuts.gouge_bound_mm},
                              {"left_mm", {roughing.left.median_mm, roughing.left.nine_tenths_mm}},
                              {"free_mm", roughing.free_mm}};
  for (const StockKind& kind : stock.kinds)
    json.update({{"engagement_deg", kind.engagement_deg},
                 {"resolution_deg", stock.resolution_deg},
                 {"strip", kind.strip + 1},
                 {"pose", kind.pose},
                 {"way_mm", kind.way_mm},
                 {"removed_mm3", kind.volume_mm3},
                 {"blank_mm3", stock.before_mm3},
                 {"strip_engagement_deg", stock.strip_deg}});
  return json;
}

std::string rest_text(const std::vector<RestPlace>& rest) {
  constexpr std::size_t kShown = 12;
  std::string text;
  for (std::size_t k = 0; k < std::min(kShown, rest.size()); ++k)
    text += fmt::format("  excess  {} at ({:.2f}, {:.2f}, {:.2f}): {:.1f} mm2, up to {:.3f} mm: {}\n", rest[k].face,
                        rest[k].point.x(), rest[k].point.y(), rest[k].point.z(), rest[k].area_mm2, rest[k].depth_mm,
                        rest[k].reason);
  if (rest.size() > kShown)
    text += fmt::format("  excess  and {} smaller places, in plan.json\n", rest.size() - kShown);
  return text;
}

nlohmann::ordered_json lacking_json(const std::vector<MissingBlade>& lacking) {
  auto list = nlohmann::ordered_json::array();
  for (const MissingBlade& one : lacking) list.push_back({{"faces", one.blade.all()}, {"turns", one.turns}});
  return list;
}

nlohmann::ordered_json reasons_json(const Acceptance& acceptance) {
  auto list = nlohmann::ordered_json::array();
  for (const Shortfall& reason : acceptance.reasons) list.push_back({{"figure", reason.figure}, {"text", reason.text}});
  return list;
}

WheelOperation operation_from(const nlohmann::json& json) {
  WheelOperation out;
  out.id = json.at("id"), out.kind = json.at("kind"), out.folder = json.at("folder"), out.tool = json.at("tool");
  out.faces = json.at("faces").get<std::vector<std::string>>();
  out.key = json.at("key");
  out.done = json.at("done"), out.pass = json.at("pass");
  out.copies = json.value("copies", 0);
  out.problem = json.value("problem", "");
  return out;
}

}  // namespace

std::map<std::string, WheelOperation> finished_operations(const std::string& file) {
  std::map<std::string, WheelOperation> out;
  if (!std::filesystem::exists(file)) return out;
  const nlohmann::json json = nlohmann::json::parse(read_file(file), nullptr, false);
  try {
    if (json.is_discarded() || json.at("schema") != kSchema) return out;
    for (const char* list : {"operations", "earlier"})
      for (const auto& entry : json.value(list, nlohmann::json::array())) {
        WheelOperation operation = operation_from(entry);
        if (operation.done) out.emplace(operation.id, std::move(operation));
      }
  } catch (const nlohmann::json::exception&) {
    // A damaged plan finishes nothing: everything is done again.
    out.clear();
  }
  return out;
}

PlanKeeper::PlanKeeper(std::string file, WheelResult& result) : file_(std::move(file)), result_(result) {
  result_.earlier.clear();
  for (auto& [id, operation] : finished_operations(file_)) result_.earlier.push_back(std::move(operation));
}

void PlanKeeper::begin(const std::string& id) {
  const std::size_t before = result_.earlier.size();
  drop(id);
  if (result_.earlier.size() != before) write();
}

void PlanKeeper::add(WheelOperation operation) {
  drop(operation.id);
  result_.operations.push_back(std::move(operation));
  std::stable_sort(result_.operations.begin(), result_.operations.end(),
                   [](const auto& a, const auto& b) { return a.id < b.id; });
  write();
}

void PlanKeeper::end() {
  result_.earlier.clear();
  write();
}

void PlanKeeper::drop(const std::string& id) {
  std::erase_if(result_.earlier, [&](const WheelOperation& one) { return one.id == id; });
}

void PlanKeeper::write() const { write_file(file_, plan_json(result_)); }

std::string plan_json(const WheelResult& result) {
  nlohmann::ordered_json json;
  json["schema"] = kSchema;
  json["axis"] = {{"point_mm", list_of(result.roles.axis.point)}, {"direction", list_of(result.roles.axis.direction)}};
  json["up"] = list_of(result.up);
  json["copies"] = result.copies;
  json["sectors"] = std::max(1, result.roles.count);
  json["whole"] = result.roles.whole;
  if (result.hub_sectors > 0.0) json["hub_sectors"] = result.hub_sectors;
  if (result.roles.count > 0) json["pitch_deg"] = 360.0 / result.roles.count;
  json["most_engagement_deg"] = result.most_engagement_deg;
  if (result.most_free_mm > 0.0) json["most_free_mm"] = result.most_free_mm;
  if (!result.blank.empty()) json["blank"] = {{"file", "blank.stl"}, {"from", result.blank}};
  if (!result.lacking.empty()) json["lacking"] = lacking_json(result.lacking);
  if (!result.roles.debris.empty()) json["left_out"] = result.roles.debris;
  json["tools"] = tools_json(result);
  json["operations"] = nlohmann::ordered_json::array();
  for (const WheelOperation& operation : result.operations)
    json["operations"].push_back(operation_json(operation, result.copies));
  for (const WheelOperation& operation : result.earlier)
    json["earlier"].push_back(operation_json(operation, result.copies));
  if (result.whole) {
    const Acceptance acceptance = result.acceptance();
    json["pass"] = acceptance.pass();
    json["reasons"] = reasons_json(acceptance);
    json["surface"] = figures_json(result.figures);
    if (result.roughing) json["roughing"] = roughing_json(*result.roughing);
    json["rest"] = rest_json(result.rest);
  }
  return dumped(json, 2) + "\n";
}

std::string wheel_text(const WheelResult& result) {
  std::string text = fmt::format("{}: {} sectors, {}\n", result.roles.file, result.roles.count,
                                 result.copies > 1 ? fmt::format("planned once, for {} equal sectors", result.copies)
                                                   : std::string("each planned separately"));
  for (const std::string& note : result.notes) text += "  note    " + note + "\n";
  for (const WheelOperation& o : result.operations)
    text += fmt::format(
        "  {:<3} {:<6} {:<14} {:7.1f} s  {}{}\n", o.id, o.kind, face_list(o.faces), o.seconds,
        o.done ? (o.pass ? "done" : "done, below the request") : "NOT DONE",
        (o.kept ? ", kept from an earlier run" : "") + (o.problem.empty() ? std::string() : ": " + o.problem));
  for (const RoleFigures& f : result.figures)
    text += f.open_mm2 > 0.0
                ? fmt::format(
                      "  {:<7} {:6.2f} % of {:.1f} accessible mm2 within tolerance (whole {:.1f} mm2), deepest gouge "
                      "{:.4f} mm, excess material {:.3f} mm\n",
                      f.role, 100.0 * f.within_mm2 / f.open_mm2, f.open_mm2, f.area_mm2, f.cut_mm, f.left_mm)
                : fmt::format("  {:<7} not machined; deepest gouge {:.4f} mm\n", f.role, f.cut_mm);
  if (result.roughing) text += "  " + roughing_text(*result.roughing) + "\n";
  text += rest_text(result.rest);
  const Acceptance acceptance = result.acceptance();
  text += fmt::format("  verdict {}\n", acceptance.pass() ? "meets the request" : "does NOT meet the request");
  for (const Shortfall& reason : acceptance.reasons) text += "    " + reason.text + "\n";
  for (const Shortfall& caution : acceptance.cautions) text += "    CAUTION " + caution.text + "\n";
  return text;
}

}  // namespace flank::internal
