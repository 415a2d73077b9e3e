#include "flank/results/verify_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "flank/io/text/json_dump.h"
#include "flank/results/acceptance.h"
#include "flank/results/cavity/stock_json.h"
#include "flank/results/verify_json.h"
#include "flank/run.h"
#include "flank/setup/machined_side.h"

namespace flank::internal {
namespace {

const char* role_words(ObstacleRole role) {
  return role == ObstacleRole::kTarget ? "the machined face" : role == ObstacleRole::kPart ? "other faces" : "fixtures";
}

}  // namespace

std::string allowance_text(const VerifyReport& report) {
  if (!(report.allowance_mm > 0.0)) return "";
  return fmt::format("{:g} mm left on purpose: gouge and excess are measured from the faces moved out by that",
                     report.allowance_mm);
}

std::string reach_text(const VerifyReport& report) {
  std::string text = fmt::format(
      "accessible  {:.2f} % of the machined face (to a ball of radius {:.4g} mm); {:.2f} % of that is finished",
      100.0 * report.reachable_share, report.reach_radius_mm, 100.0 * report.coverage_reachable);
  if (report.coverage_reachable_bound) {
    // Rounded down: what is printed is proved, too.
    constexpr double kDigits = 1e4;
    text += fmt::format(", {:.2f} % proved", std::floor(kDigits * *report.coverage_reachable_bound) * 100.0 / kDigits);
  }
  return text;
}

std::string depth_text(const VerifyReport& report) {
  const bool others =
      std::any_of(report.faces.begin(), report.faces.end(), [](const FaceVerdict& face) { return !face.target; });
  if (report.depth == DepthProof::kSampled)
    return fmt::format("not proved: between the samples the machined face may be cut {:.4f} mm deep",
                       report.overcut_bound_mm) +
           (others ? fmt::format(", other faces {:.4f} mm", report.gouge_bound_mm) : "");
  return fmt::format("proved: the machined face is nowhere cut deeper than {:.4f} mm", report.overcut_bound_mm) +
         (others ? fmt::format(", other faces nowhere deeper than {:.4f} mm", report.gouge_bound_mm) : "");
}

std::string sheet_side_text(const VerifyReport& report) {
  std::string text;
  for (const SheetSide& side : report.sheet_sides)
    if (side.asked) text += fmt::format("  side        {}: {}\n", side.faces, side_text(side));
  return text;
}

std::string clearance_text(const ClearanceReport& report) {
  std::string text;
  for (const ClearanceFigure& f : report.figures) {
    const bool enters = f.clearance_mm < 0.0;
    const std::string size = enters ? fmt::format("collides with {} by {:.4f} mm", role_words(f.role), -f.clearance_mm)
                                    : fmt::format("clearance {:.3f} mm to {}", f.clearance_mm, role_words(f.role));
    text +=
        fmt::format("  {:<11} {} (+-{:.3f} mm): {} at ({:.3f}, {:.3f}, {:.3f}), pass {}, CL point {:.1f}, z {:.2f}{}\n",
                    body_name(f.body), size, f.bound_mm, f.obstacle, f.point.x(), f.point.y(), f.point.z(), f.strip + 1,
                    f.t, f.z_mm,
                    f.kept   ? ""
                    : enters ? "  COLLISION"
                             : "  TOO CLOSE");
  }
  return text;
}

}  // namespace flank::internal

namespace flank {
using namespace internal;

namespace {

/// A table for each operation, then the verdict on all of them.
std::string operations_text(const Verification& outcome) {
  std::string text;
  for (std::size_t k = 0; k < outcome.operations.size(); ++k)
    text += outcome.operation_names[k] + "\n" + verify_text(outcome.operations[k]) + "\n";
  text += fmt::format("{} operations: {}\n", outcome.operations.size(),
                      outcome.acceptance.pass() ? "meet the request" : "do NOT meet the request");
  return text + reason_lines(outcome.acceptance);
}

/// Each operation as verify.json has a path.
std::string operations_json(const Verification& outcome) {
  using Json = nlohmann::ordered_json;
  const auto texts_of = [](const std::vector<Shortfall>& shortfalls) {
    Json list = Json::array();
    for (const Shortfall& one : shortfalls) list.push_back({{"figure", one.figure}, {"text", one.text}});
    return list;
  };
  Json json = {{"schema", "openflank/verify-operations/1"},
               {"pass", outcome.acceptance.pass()},
               {"reasons", texts_of(outcome.acceptance.reasons)},
               {"cautions", texts_of(outcome.acceptance.cautions)},
               {"operations", Json::array()}};
  for (std::size_t k = 0; k < outcome.operations.size(); ++k)
    json["operations"].push_back(
        {{"name", outcome.operation_names[k]}, {"verify", Json::parse(verify_json(outcome.operations[k]))}});
  return dumped(json, 2);
}

}  // namespace

std::string verify_text(const Verification& outcome) {
  if (!outcome.operations.empty()) return operations_text(outcome);
  const VerifyReport& v = outcome.report;
  std::string text = fmt::format("{:<8} {:>8} {:>11} {:>9} {:>9} {:>11} {:>11} {:>11} {:>11}\n", "face", "role",
                                 "area mm2", "finished", "at least", "gouge mm", "at most mm", "excess mm", "rms mm");
  for (const FaceVerdict& f : v.faces) {
    if (f.target)
      text += fmt::format("{:<8} {:>8} {:>11.2f} {:>8.2f}% {:>8.2f}% {:>11.4f} {:>11.4f} {:>11.4f} {:>11.4f}\n", f.face,
                          "machined", f.area_mm2, 100.0 * f.coverage, 100.0 * f.coverage_bound, f.overcut_mm,
                          f.overcut_bound_mm, f.undercut_covered_mm, f.rms_mm);
    else
      text += fmt::format("{:<8} {:>8} {:>11.2f} {:>9} {:>9} {:>11.4f} {:>11.4f}\n", f.face, "check", f.area_mm2, "",
                          "", f.overcut_mm, f.overcut_bound_mm);
  }
  for (const WorstPlace& w : v.worst)
    text += fmt::format("worst: {} at ({:.3f}, {:.3f}, {:.3f}) error {:.4f} mm, pass {}, CL point {:.1f}, s {:.2f}\n",
                        w.face, w.point.x(), w.point.y(), w.point.z(), w.f, w.strip + 1, w.t, w.s);
  text += sheet_side_text(v) + clearance_text(v.clearance);
  if (v.stock) text += stock_text(*v.stock);
  for (const std::string& note : outcome.notes) text += "note: " + note + "\n";
  if (const std::string left = allowance_text(v); !left.empty()) text += left + "\n";
  text += reach_text(v) + "\n";
  text += depth_text(v) + "\n";
  text += fmt::format("finished {:.2f} % of the whole face within {} mm, gouge {:.4f} mm: {}\n", 100.0 * v.coverage,
                      v.tolerance_mm, v.overcut_mm,
                      outcome.acceptance.pass() ? "meets the request" : "does NOT meet the request");
  text += reason_lines(outcome.acceptance);
  return text;
}

std::string verify_json(const Verification& outcome) {
  if (!outcome.operations.empty()) return operations_json(outcome);
  return verify_to_json(outcome.report, outcome.acceptance);
}

}  // namespace flank
