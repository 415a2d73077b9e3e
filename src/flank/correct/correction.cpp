#include "flank/correct/correction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "flank/io/text/json_dump.h"
#include "flank/job/correct_fields.h"

namespace flank::internal {
namespace {

using Json = nlohmann::ordered_json;

Json triple(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json judged(const VerifyReport& report) {
  return {{"coverage", report.coverage},
          {"coverage_reachable", report.coverage_reachable},
          {"overcut_mm", report.overcut_mm},
          {"other_faces_overcut_mm", report.gouge_mm}};
}

Json ground_entry(const GroundTool& ground) {
  return {{"points", ground.used},       {"elsewhere", ground.elsewhere},   {"outliers", ground.outliers},
          {"noise_mm", ground.noise_mm}, {"largest_mm", ground.largest_mm}, {"rms_mm", ground.rms_mm}};
}

/// What part of the error the best fit of the datum takes away.
double taken_away(const FaceError& error) {
  return error.rms_before_mm > 0.0 ? 1.0 - error.rms_after_mm / error.rms_before_mm : 0.0;
}

Json error_entry(const FaceError& error) {
  return {{"points", error.points.size()},
          {"beside", error.beside},
          {"outliers", error.outliers},
          {"shift_mm", triple(error.move.shift)},
          {"turn_deg", error.move.angle() * 180.0 / std::numbers::pi},
          {"rms_as_measured_mm", error.rms_before_mm},
          {"rms_after_best_fit_mm", error.rms_after_mm},
          {"taken_away_by_best_fit", taken_away(error)},
          {"planned_rms_mm", error.planned_rms_mm},
          {"noise_mm", error.field.noise_mm},
          {"smooth_rms_mm", error.smooth_rms_mm},
          {"smooth_largest_mm", error.smooth_largest_mm},
          {"limit_mm", error.limit_mm},
          {"limited", error.limited}};
}

std::string indices(const std::vector<int>& outliers) {
  constexpr std::size_t kShown = 10;
  std::string text;
  for (std::size_t k = 0; k < std::min(kShown, outliers.size()); ++k) text += fmt::format(" {}", outliers[k] + 1);
  if (outliers.size() > kShown) text += fmt::format(" and {} more", outliers.size() - kShown);
  return text;
}

std::string judged_line(const char* what, const VerifyReport& report) {
  return fmt::format("  {}: {:.2f} % of the accessible area finished, gouge {:.4f} mm\n", what,
                     100.0 * report.coverage_reachable, report.overcut_mm);
}

std::string ground_text(const GroundTool& ground) {
  std::string text = fmt::format("Tool as ground: {} points on the flank, {} elsewhere; noise {:.4f} mm\n", ground.used,
                                 ground.elsewhere, ground.noise_mm);
  text +=
      fmt::format("  its radii differ from the tool's by {:.4f} mm (rms {:.4f})\n", ground.largest_mm, ground.rms_mm);
  if (!ground.outliers.empty()) text += fmt::format("  points left out, by number:{}\n", indices(ground.outliers));
  return text;
}

std::string error_text(const FaceError& error) {
  std::string text = fmt::format("Face as cut: {} points on the face, {} off it; noise {:.4f} mm\n",
                                 error.points.size(), error.beside, error.field.noise_mm);
  text +=
      fmt::format("  the planned path itself leaves {:.4f} mm rms at these points; the errors below are without it\n",
                  error.planned_rms_mm);
  text +=
      fmt::format("  error {:.4f} mm rms as measured, {:.4f} after a best fit of the datum, which removes {:.1f} %\n",
                  error.rms_before_mm, error.rms_after_mm, 100.0 * taken_away(error));
  text += fmt::format("  form error (noise taken out): {:.4f} mm rms, {:.4f} at most\n", error.smooth_rms_mm,
                      error.smooth_largest_mm);
  if (error.limited) text += fmt::format("  the correction is limited to {:.4f} mm\n", error.limit_mm);
  if (!error.outliers.empty()) text += fmt::format("  points left out, by number:{}\n", indices(error.outliers));
  return text;
}

}  // namespace

std::string correction_json(const Correction& correction) {
  Json document = {{"schema", "openflank/correct/1"},
                   {"units", "mm"},
                   {"command", command_line(correction.job)},
                   {"tolerance", correction.tolerance_mm}};
  if (correction.ground) {
    document["ground"] = ground_entry(*correction.ground);
    document["before"] = judged(correction.other);
    document["after"] = judged(correction.result.verify);
  }
  if (correction.error) {
    document["error"] = error_entry(*correction.error);
    document["against_mirrored"] = judged(correction.result.verify);
    document["against_nominal"] = judged(correction.other);
  }
  document["pass"] = correction.result.acceptance().pass();
  return dumped(document, 1) + "\n";
}

std::string correction_text(const Correction& correction) {
  std::string text;
  if (correction.ground) {
    text = ground_text(*correction.ground);
    text += judged_line("tool as ground, old motion", correction.other);
    text += judged_line("tool as ground, new motion", correction.result.verify);
  }
  if (correction.error) {
    text = error_text(*correction.error);
    text += judged_line("new motion, checked against the face with its error mirrored", correction.result.verify);
    text += judged_line("new motion, checked against the nominal face, from which it deviates on purpose",
                        correction.other);
  }
  return text;
}

}  // namespace flank::internal
