#include "flank/artefact/acceptance.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "flank/setup/machined_side.h"

namespace flank::internal {
namespace {

constexpr std::size_t kMostFacesNamed = 8;  ///< of entered faces, the deepest first

/// Where a face is cut deepest, for the end of a sentence; empty where nothing is cut.
std::string place(const FaceVerdict& face) {
  if (!face.deepest) return "";
  const Vec3& p = face.deepest->point;
  return fmt::format(" at ({:.3f}, {:.3f}, {:.3f}), strip {}", p.x(), p.y(), p.z(), face.deepest->strip + 1);
}

/// The faces that are cut deeper than the tolerance, deepest first.
std::vector<const FaceVerdict*> cut_faces(const VerifyReport& report, bool targets) {
  std::vector<const FaceVerdict*> faces;
  for (const FaceVerdict& face : report.faces)
    if (face.target == targets && face.overcut_mm > report.tolerance_mm) faces.push_back(&face);
  std::stable_sort(faces.begin(), faces.end(),
                   [](const auto* a, const auto* b) { return a->overcut_mm > b->overcut_mm; });
  return faces;
}

/// A reason for each face that is cut: a number for the whole part would not say where to look.
void add_cuts(const VerifyReport& report, bool targets, Acceptance& out) {
  const Figure figure = targets ? Figure::kOvercut : Figure::kGouge;
  const std::vector<const FaceVerdict*> faces = cut_faces(report, targets);
  for (std::size_t k = 0; k < faces.size() && k < kMostFacesNamed; ++k)
    add_reason(out, figure,
               fmt::format("{} {} by {:.4f} mm > {} mm{}", faces[k]->face, targets ? "is overcut" : "is entered",
                           faces[k]->overcut_mm, report.tolerance_mm, place(*faces[k])));
  if (faces.size() > kMostFacesNamed)
    add_reason(out, figure, fmt::format("and {} more faces", faces.size() - kMostFacesNamed));
}

/// Faces where no cut over the tolerance was found, nor was it proved that there is none.
void add_unproved(const VerifyReport& report, Acceptance& out) {
  std::vector<const FaceVerdict*> faces;
  // Written as a negation: a bound that is not a number proves nothing.
  for (const FaceVerdict& face : report.faces)
    if (face.overcut_mm <= report.tolerance_mm && !(face.overcut_bound_mm <= report.tolerance_mm))
      faces.push_back(&face);
  std::stable_sort(faces.begin(), faces.end(),
                   [](const auto* a, const auto* b) { return a->overcut_bound_mm > b->overcut_bound_mm; });
  for (std::size_t k = 0; k < faces.size() && k < kMostFacesNamed; ++k) {
    const Vec3& p = faces[k]->bound_point;
    const std::string sampled =
        report.depth == DepthProof::kSampled ? ", between samples; without --sample it is looked at" : "";
    add_reason(out, faces[k]->target ? Figure::kOvercutBound : Figure::kGougeBound,
               fmt::format("{} is not proved: cut by {:.4f} mm, but it may be {:.4f} mm > {} mm about "
                           "({:.3f}, {:.3f}, {:.3f}){}",
                           faces[k]->face, faces[k]->overcut_mm, faces[k]->overcut_bound_mm, report.tolerance_mm, p.x(),
                           p.y(), p.z(), sampled));
  }
  if (faces.size() > kMostFacesNamed)
    add_reason(out, Figure::kOvercutBound, fmt::format("and {} more faces", faces.size() - kMostFacesNamed));
}

/// Which side of open sheets was taken where nobody asked for one: the file does not say where their material is.
void add_sheet_sides(const VerifyReport& report, Acceptance& out) {
  for (const SheetSide& sheet : report.sheet_sides)
    if (!sheet.asked)
      add_caution(out, Figure::kSheetSide,
                  fmt::format("{} bounds no material; machined from {}; --side {} takes the other side", sheet.faces,
                              side_text(sheet), sheet.side > 0 ? "-" : "+"));
}

/// Strips inside the material: the first, and how many more.
void add_buried(const VerifyReport& report, Acceptance& out) {
  if (report.buried.empty()) return;
  const BuriedStrip& first = report.buried.front();
  std::string text = fmt::format("strip {} runs inside the material, about ({:.3f}, {:.3f}, {:.3f})", first.strip + 1,
                                 first.point.x(), first.point.y(), first.point.z());
  if (report.buried.size() > 1) text += fmt::format(", and {} more", report.buried.size() - 1);
  add_reason(out, Figure::kBuried, std::move(text));
}

/// Coverage that was measured but is not proved; of a target that is cut too deep, nothing of it is.
void add_coverage(const VerifyReport& report, double least, Acceptance& out) {
  if (!(report.coverage_reachable >= least)) {
    add_reason(out, Figure::kCoverage,
               fmt::format("coverage {:.3f} % < {:.3f} % of what is reachable", 100.0 * report.coverage_reachable,
                           100.0 * least));
    return;
  }
  const bool deep = report.overcut_bound_mm > report.tolerance_mm;
  if (deep || !report.coverage_reachable_bound || *report.coverage_reachable_bound >= least) return;
  const auto worst = std::min_element(report.faces.begin(), report.faces.end(), [](const auto& a, const auto& b) {
    return a.target != b.target ? a.target : a.target && a.coverage_bound - a.coverage < b.coverage_bound - b.coverage;
  });
  const Vec3 p = worst != report.faces.end() ? worst->uncovered_point : Vec3(Vec3::Zero());
  add_reason(out, Figure::kCoverageBound,
             fmt::format("coverage is not proved: {:.3f} % of what is reachable is measured, {:.3f} % is proved "
                         "< {:.3f} %; the rest is about ({:.3f}, {:.3f}, {:.3f})",
                         100.0 * report.coverage_reachable, 100.0 * *report.coverage_reachable_bound, 100.0 * least,
                         p.x(), p.y(), p.z()));
}

}  // namespace

void add_reason(Acceptance& acceptance, Figure figure, std::string text) {
  acceptance.reasons.push_back({std::string(figure_name(figure)), std::move(text)});
}

void add_caution(Acceptance& acceptance, Figure figure, std::string text) {
  acceptance.cautions.push_back({std::string(figure_name(figure)), std::move(text)});
}

Acceptance accept(const Tool& tool, const VerifyReport& report, double least_coverage, bool complete) {
  Acceptance out;
  if (!complete) add_reason(out, Figure::kComplete, "interrupted: incomplete");
  if (const Legitimacy legitimacy = check_legitimacy(tool.radial); !legitimacy.legitimate)
    add_reason(out, Figure::kLegitimate, "the tool is not legitimate: " + legitimacy.reason);
  add_sheet_sides(report, out);
  if (!complete && report.verdict == Verdict::kNotRun) {
    add_reason(out, Figure::kVerdict, "not judged: `flank verify` judges it");
    return out;
  }
  add_cuts(report, true, out);
  add_cuts(report, false, out);
  add_buried(report, out);
  // What was stopped was judged by samples alone, and says already why it does not pass.
  if (complete) add_unproved(report, out);
  add_coverage(report, least_coverage, out);
  // "surely": the judge's figure less its bound is what counts (ClearanceFigure::kept).
  for (const ClearanceFigure& f : report.clearance.figures)
    if (!f.kept)
      add_reason(
          out, Figure::kClearance,
          fmt::format("the {} does not keep {} mm from {} surely", body_name(f.body), f.required_mm, f.obstacle));
  return out;
}

void accept_stock(const StockReport& stock, double most_engagement_deg, double tolerance_mm, Acceptance& acceptance) {
  constexpr double kSpareCells = 0.1;
  // The replay cuts cells: an engagement that is over by less than one of them may be the grid's.
  const double most = most_engagement_deg + stock.resolution_deg;
  for (const StockKind& kind : stock.kinds)
    // Cycles make the limit; a finishing sweep or a link that engages more has met what they have left.
    if (kind.engagement_deg > most && !kind.cuts_a_slot())
      add_reason(acceptance, Figure::kStock,
                 fmt::format("replayed, a {} has an engagement of {:.3f} degrees > {} + {:.2f}, strip {}", kind.kind,
                             kind.engagement_deg, most_engagement_deg, stock.resolution_deg, kind.strip + 1));
  // A stretch of up to two cells may only be the grid's.
  if (stock.uncut_mm > std::max(kMostUncutMm, 2.0 * stock.cell_mm)) {
    const Vec3& p = stock.uncut_point;
    add_reason(acceptance, Figure::kStock,
               fmt::format("replayed, {:.3f} mm of material are left between the sides, before ({:.3f}, {:.3f}, "
                           "{:.3f})",
                           stock.uncut_mm, p.x(), p.y(), p.z()));
  }
  if (stock.entered_mm > tolerance_mm + kSpareCells * stock.cell_mm)
    add_reason(acceptance, Figure::kStock,
               fmt::format("replayed, a face is entered by {:.4f} mm > {} mm", stock.entered_mm, tolerance_mm));
}

void accept_bends(const PlanJob& job, const BendRadii& bends, Acceptance& acceptance) {
  const auto* fit = std::get_if<FitJob>(&job);
  if (fit == nullptr || !fit->min_bend_radius_mm) return;
  const double asked = *fit->min_bend_radius_mm;
  for (const auto& [end, radius_mm] : {std::pair("tip", bends.tip_mm), std::pair("holder end", bends.holder_end_mm)})
    if (radius_mm < asked)
      add_reason(acceptance, Figure::kBendRadius,
                 fmt::format("the path of the {} bends with a radius of {:.3g} mm < {} mm", end, radius_mm, asked));
}

void accept_cavity(const TrochoidSummary& cavity, Acceptance& acceptance) {
  constexpr double kSpareDeg = 1e-6;  // rounding of a limit that cycles are made to reach
  if (cavity.largest_deg() > cavity.most_engagement_deg + kSpareDeg)
    add_reason(acceptance, Figure::kEngagement,
               fmt::format("engagement {:.3f} degrees > {} degrees", cavity.largest_deg(), cavity.most_engagement_deg));
  for (std::size_t k = 0; k < cavity.layers.size(); ++k)
    if (cavity.layers[k].side_deg > cavity.most_engagement_deg + kSpareDeg)
      add_reason(acceptance, Figure::kEngagement,
                 fmt::format("layer {}: a finishing sweep has an engagement of {:.3f} degrees > {} degrees", k + 1,
                             cavity.layers[k].side_deg, cavity.most_engagement_deg));
  // A layer that ended early has a good engagement in what it has, and leaves the rest.
  for (std::size_t k = 0; k < cavity.layers.size(); ++k)
    if (cavity.layers[k].status != "done")
      add_reason(
          acceptance, Figure::kCycles,
          fmt::format("layer {} is {} after {} cycles", k + 1, cavity.layers[k].status, cavity.layers[k].cycles));
  if (cavity.layers.empty()) add_reason(acceptance, Figure::kCycles, "no cycle was planned");
}

std::string reason_lines(const Acceptance& acceptance) {
  std::string text;
  for (const Shortfall& reason : acceptance.reasons) text += "              " + reason.text + "\n";
  for (const Shortfall& caution : acceptance.cautions) text += "  CAUTION     " + caution.text + "\n";
  return text;
}

}  // namespace flank::internal
