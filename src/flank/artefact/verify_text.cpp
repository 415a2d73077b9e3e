#include "flank/artefact/verify_text.h"

#include <fmt/format.h>

#include <cmath>

#include "flank/artefact/acceptance.h"
#include "flank/artefact/cavity/stock_json.h"
#include "flank/artefact/verify_json.h"
#include "flank/run.h"
#include "flank/setup/machined_side.h"

namespace flank::internal {
namespace {

const char* role_words(ObstacleRole role) {
  return role == ObstacleRole::kTarget ? "the target" : role == ObstacleRole::kPart ? "other faces" : "fixtures";
}

}  // namespace

std::string reach_text(const VerifyReport& report) {
  std::string text =
      fmt::format("reachable   {:.2f} % of the target (ball of radius {:.4g} mm), of which {:.2f} % is covered",
                  100.0 * report.reachable_share, report.reach_radius_mm, 100.0 * report.coverage_reachable);
  if (report.coverage_reachable_bound) {
    // Rounded down: what is printed is proved, too.
    constexpr double kDigits = 1e4;
    text += fmt::format(", {:.2f} % proved", std::floor(kDigits * *report.coverage_reachable_bound) * 100.0 / kDigits);
  }
  return text;
}

std::string depth_text(const VerifyReport& report) {
  if (report.depth == DepthProof::kSampled)
    return fmt::format(
        "sampled: only the samples were looked at; between them the target may be cut {:.4f} mm deep, other faces "
        "{:.4f} mm",
        report.overcut_bound_mm, report.gouge_bound_mm);
  return fmt::format("proved: no place of the target is cut deeper than {:.4f} mm, none of other faces {:.4f} mm",
                     report.overcut_bound_mm, report.gouge_bound_mm);
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
    const std::string size = enters ? fmt::format("enters {} by {:.4f} mm", role_words(f.role), -f.clearance_mm)
                                    : fmt::format("keeps {:.4f} mm from {}", f.clearance_mm, role_words(f.role));
    text += fmt::format(
        "  {:<11} {}, true to {:.4f} mm: {} at ({:.3f}, {:.3f}, {:.3f}), strip {}, pose {:.2f}, z {:.2f}{}\n",
        body_name(f.body), size, f.bound_mm, f.obstacle, f.point.x(), f.point.y(), f.point.z(), f.strip + 1, f.t,
        f.z_mm,
        f.kept   ? ""
        : enters ? "  COLLISION"
                 : "  TOO NEAR");
  }
  return text;
}

}  // namespace flank::internal

namespace flank {
using namespace internal;

std::string verify_text(const Verification& outcome) {
  const VerifyReport& v = outcome.report;
  std::string text =
      fmt::format("{:<8} {:>6} {:>11} {:>9} {:>9} {:>11} {:>11} {:>11} {:>11}\n", "face", "role", "area mm2",
                  "coverage", "at least", "overcut mm", "at most mm", "undercut mm", "rms mm");
  for (const FaceVerdict& f : v.faces) {
    if (f.target)
      text += fmt::format("{:<8} {:>6} {:>11.2f} {:>8.2f}% {:>8.2f}% {:>11.6f} {:>11.6f} {:>11.6f} {:>11.6f}\n", f.face,
                          "target", f.area_mm2, 100.0 * f.coverage, 100.0 * f.coverage_bound, f.overcut_mm,
                          f.overcut_bound_mm, f.undercut_covered_mm, f.rms_mm);
    else
      text += fmt::format("{:<8} {:>6} {:>11.2f} {:>9} {:>9} {:>11.6f} {:>11.6f}\n", f.face, "check", f.area_mm2, "",
                          "", f.overcut_mm, f.overcut_bound_mm);
  }
  for (const WorstPlace& w : v.worst)
    text += fmt::format("worst: {} at ({:.3f}, {:.3f}, {:.3f}) f = {:.6f} mm, strip {}, pose {:.2f}, s {:.3f}\n",
                        w.face, w.point.x(), w.point.y(), w.point.z(), w.f, w.strip + 1, w.t, w.s);
  text += sheet_side_text(v) + clearance_text(v.clearance);
  if (v.stock) text += stock_text(*v.stock);
  for (const std::string& note : outcome.notes) text += "note: " + note + "\n";
  text += reach_text(v) + "\n";
  text += depth_text(v) + "\n";
  text += fmt::format("coverage {:.2f} % of the whole face within {} mm, overcut {:.6f} mm: {}\n", 100.0 * v.coverage,
                      v.tolerance_mm, v.overcut_mm,
                      outcome.acceptance.pass() ? "meets the request" : "does NOT meet the request");
  text += reason_lines(outcome.acceptance);
  return text;
}

std::string verify_json(const Verification& outcome) { return verify_to_json(outcome.report, outcome.acceptance); }

}  // namespace flank
