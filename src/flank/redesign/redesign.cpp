#include "flank/redesign/redesign.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "flank/io/text/json_dump.h"
#include "flank/job/redesign_fields.h"

namespace flank::internal {
namespace {

using Json = nlohmann::ordered_json;

Json triple(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json distance_entry(const DistanceFigure& figure) {
  if (!figure.known) return nullptr;
  return {{"least_before", figure.least_before},
          {"least_after", figure.least_after},
          {"mean_before", figure.mean_before},
          {"mean_after", figure.mean_after},
          {"at", triple(figure.at)}};
}

Json section_entry(const Section& section) {
  return {{"height_percent", section.height_percent},
          {"height_mm", section.height_mm},
          {"points", section.points.size()},
          {"chord", section.chord_mm},
          {"rms", section.rms_mm},
          {"largest", section.largest_mm},
          {"thickest_before", section.thickest_before_mm},
          {"thickest_after", section.thickest_after_mm},
          {"leading_edge_radius", section.leading_radius_mm},
          {"leading_kink_before_deg", section.leading_kink_before_deg},
          {"leading_kink_after_deg", section.leading_kink_after_deg},
          {"trailing_edge_radius", section.trailing_radius_mm},
          {"trailing_kink_before_deg", section.trailing_kink_before_deg},
          {"trailing_kink_after_deg", section.trailing_kink_after_deg}};
}

Json face_entry(const Redesign& redesign, std::size_t k) {
  const FaceTables& face = redesign.faces[k];
  Json sections = Json::array();
  for (const Section& section : face.sections) sections.push_back(section_entry(section));
  return {{"face", face.id},
          {"new_face", k < redesign.new_ids.size() ? Json(redesign.new_ids[k]) : Json(nullptr)},
          {"area", face.area_mm2},
          {"rms", face.rms_mm},
          {"highest", face.highest_mm},
          {"lowest", face.lowest_mm},
          {"border_moved", k < redesign.moved_mm.size() ? Json(redesign.moved_mm[k]) : Json(nullptr)},
          {"border_gap", k < redesign.gap_mm.size() ? Json(redesign.gap_mm[k]) : Json(nullptr)},
          {"surface_error", redesign.surface_error_mm[k]},
          {"thickness", distance_entry(face.thickness)},
          {"gap", distance_entry(face.gap)},
          {"sections", sections}};
}

std::string distance_line(const char* what, const DistanceFigure& figure) {
  if (!figure.known) return {};
  return fmt::format("    {:<10}least {:.4g} mm before, {:.4g} after; mean {:.4g} before, {:.4g} after\n", what,
                     figure.least_before, figure.least_after, figure.mean_before, figure.mean_after);
}

std::string face_text(const Redesign& redesign, std::size_t k) {
  const FaceTables& face = redesign.faces[k];
  std::string text =
      fmt::format("  {}: the new surface deviates by {:.4f} mm rms, at most {:.4f} mm outwards and {:.4f} mm inwards\n",
                  face.id, face.rms_mm, face.highest_mm, -face.lowest_mm);
  if (k < redesign.gap_mm.size())
    text += fmt::format(
        "    border    moved by up to {:.4f} mm along the neighbouring faces; gap of up to {:.2g} mm to neighbours "
        "that do not meet the new face\n",
        redesign.moved_mm[k], redesign.gap_mm[k]);
  text += distance_line("thickness", face.thickness) + distance_line("gap", face.gap);
  text += "    height %   rms mm  largest  thickest before/after   LE radius, kink before/after   TE radius, kink\n";
  for (const Section& s : face.sections)
    text += fmt::format(
        "    {:7.1f}  {:7.4f}  {:7.4f}  {:10.4f} {:10.4f}   {:9.4f} {:6.2f} {:6.2f}deg   {:8.4f} {:6.2f} {:6.2f}deg\n",
        s.height_percent, s.rms_mm, s.largest_mm, s.thickest_before_mm, s.thickest_after_mm, s.leading_radius_mm,
        s.leading_kink_before_deg, s.leading_kink_after_deg, s.trailing_radius_mm, s.trailing_kink_before_deg,
        s.trailing_kink_after_deg);
  return text;
}

std::string solid_line(const Redesign& redesign) {
  if (!redesign.not_joined.empty())
    return "  solid       none: " + redesign.not_joined + "; the new faces alone are in face.step\n";
  const CheckedSolids& checked = redesign.checked;
  const char* verdict = redesign.solid_valid() ? "valid" : "NOT valid";
  return fmt::format(
      "  solid       redesigned.step: {} by the CAD kernel's checker; {} of {} solids closed and valid, {} before\n",
      verdict, checked.valid, checked.solids, redesign.solids_before);
}

}  // namespace

bool Redesign::met() const {
  // What is far beyond a sample's own rounding is missed.
  constexpr double kMissed = 1e-4;
  const bool exactly = exact.share >= result.verify.reachable_share - 1e-3 && exact.overcut_mm <= exact.tolerance_mm;
  return result.complete && solid_valid() && exactly && largest_c < 1.0 && thickness_missed_mm <= kMissed;
}

std::string redesign_json(const Redesign& redesign) {
  Json faces = Json::array();
  for (std::size_t k = 0; k < redesign.faces.size(); ++k) faces.push_back(face_entry(redesign, k));
  const Json document = {{"schema", "openflank/redesign/1"},
                         {"units", "mm"},
                         {"command", command_line(redesign.job)},
                         {"part_sha256", redesign.part_sha256},
                         {"tolerance", redesign.tolerance_mm},
                         {"complete", redesign.result.complete},
                         {"met", redesign.met()},
                         {"largest_c", redesign.largest_c},
                         {"exact",
                          {{"tolerance", redesign.exact.tolerance_mm},
                           {"share", redesign.exact.share},
                           {"overcut", redesign.exact.overcut_mm},
                           {"left", redesign.exact.left_mm}}},
                         {"solid",
                          {{"joined", redesign.not_joined.empty()},
                           {"why_not", redesign.not_joined},
                           {"valid", redesign.solid_valid()},
                           {"solids", redesign.checked.solids},
                           {"valid_solids", redesign.checked.valid},
                           {"valid_solids_before", redesign.solids_before},
                           {"edge_tolerance", redesign.checked.tolerance_mm}}},
                         {"thickness_missed", redesign.thickness_missed_mm},
                         {"notes", redesign.notes},
                         {"faces", faces}};
  return dumped(document, 1) + "\n";
}

std::string redesign_text(const Redesign& redesign) {
  std::string text = fmt::format("Nearest surface that one pass mills exactly, for {} {}\n", redesign.job.part.file,
                                 redesign.job.part.target_text());
  for (std::size_t k = 0; k < redesign.faces.size(); ++k) text += face_text(redesign, k);
  text += solid_line(redesign);
  const Exactness& exact = redesign.exact;
  if (exact.tolerance_mm > 0.0)
    text += fmt::format(
        "  exact       its tool and motion mill {:.2f} % of the new faces to within {:.2g} mm (a millionth of the "
        "size); "
        "deepest cut {:.2g} mm, material left {:.2g} mm at most\n",
        100.0 * exact.share, exact.tolerance_mm, exact.overcut_mm, exact.left_mm);
  if (redesign.job.thickness_min_mm)
    text += redesign.thickness_missed_mm > 0.0
                ? fmt::format("  thickness   misses its limit by {:.4f} mm\n", redesign.thickness_missed_mm)
                : std::string("  thickness   nowhere below its limit\n");
  for (const std::string& note : redesign.notes) text += "  note: " + note + "\n";
  return text;
}

std::string deviation_csv(const Redesign& redesign) {
  std::string text =
      "face,x_mm,y_mm,z_mm,normal_x,normal_y,normal_z,area_mm2,deviation_mm,thickness_before_mm,thickness_after_mm\n";
  for (const FaceTables& face : redesign.faces)
    for (const DeviationPoint& p : face.points)
      text += fmt::format("{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.7f},{:.6f},{:.6f}\n", face.id,
                          p.point.x(), p.point.y(), p.point.z(), p.normal.x(), p.normal.y(), p.normal.z(), p.area_mm2,
                          p.deviation_mm, p.thickness_before_mm, p.thickness_after_mm);
  return text;
}

std::string sections_csv(const Redesign& redesign) {
  std::string text =
      "face,height_percent,before_x_mm,before_y_mm,before_z_mm,after_x_mm,after_y_mm,after_z_mm,deviation_mm\n";
  for (const FaceTables& face : redesign.faces)
    for (const Section& section : face.sections)
      for (const SectionPoint& p : section.points)
        text += fmt::format("{},{:.4g},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.7f}\n", face.id,
                            section.height_percent, p.before.x(), p.before.y(), p.before.z(), p.after.x(), p.after.y(),
                            p.after.z(), p.deviation_mm);
  return text;
}

}  // namespace flank::internal
