#include "flank/results/acceptance.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "flank/base/proved_digits.h"
#include "flank/results/cavity/stock_json.h"
#include "flank/setup/machined_side.h"

namespace flank::internal {
namespace {

constexpr std::size_t kMostFacesNamed = 8;  ///< of entered faces, the deepest first

/// Where a face is cut deepest, for the end of a sentence; empty where nothing is cut.
std::string place(const FaceVerdict& face) {
  if (!face.deepest) return "";
  const Vec3& p = face.deepest->point;
  return fmt::format(" at ({:.3f}, {:.3f}, {:.3f}), pass {}", p.x(), p.y(), p.z(), face.deepest->strip + 1);
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
               fmt::format("{} is gouged by {:.4f} mm > {} mm{}", faces[k]->face, faces[k]->overcut_mm,
                           report.tolerance_mm, place(*faces[k])));
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
        report.depth == DepthProof::kSampled ? ", between samples; leave out --sample for a proof" : "";
    add_reason(
        out, faces[k]->target ? Figure::kOvercutBound : Figure::kGougeBound,
        fmt::format(
            "{} is not proved: gouge {:.4f} mm found, {:.4f} mm > {} mm possible near ({:.3f}, {:.3f}, {:.3f}){}",
            faces[k]->face, faces[k]->overcut_mm, faces[k]->overcut_bound_mm, report.tolerance_mm, p.x(), p.y(), p.z(),
            sampled));
  }
  if (faces.size() > kMostFacesNamed)
    add_reason(out, Figure::kOvercutBound, fmt::format("and {} more faces", faces.size() - kMostFacesNamed));
}

/// Which side of open sheets was taken where nobody asked for one: the file does not say where their material is.
void add_sheet_sides(const VerifyReport& report, Acceptance& out) {
  for (const SheetSide& sheet : report.sheet_sides)
    if (!sheet.asked)
      add_caution(out, Figure::kSheetSide,
                  fmt::format("{} belongs to no solid; machined from {}; --side {} takes the other side", sheet.faces,
                              side_text(sheet), sheet.side > 0 ? "-" : "+"));
}

/// Strips inside the material: the first, and how many more.
void add_buried(const VerifyReport& report, Acceptance& out) {
  if (report.buried.empty()) return;
  const BuriedStrip& first = report.buried.front();
  std::string text = fmt::format("pass {} runs inside the material near ({:.3f}, {:.3f}, {:.3f})", first.strip + 1,
                                 first.point.x(), first.point.y(), first.point.z());
  if (report.buried.size() > 1) text += fmt::format(", and {} more", report.buried.size() - 1);
  add_reason(out, Figure::kBuried, std::move(text));
}

/// Faces that nobody could judge.
void add_unread(const VerifyReport& report, Acceptance& out) {
  const std::vector<UnjudgedFace>& faces = report.unread_faces;
  for (std::size_t k = 0; k < faces.size() && k < kMostFacesNamed; ++k)
    add_reason(out, Figure::kUnreadFaces,
               fmt::format("{0} is not checked: {1}; if the tool may cut into it: --ignore-faces {0}", faces[k].face,
                           faces[k].why));
  if (faces.size() > kMostFacesNamed)
    add_reason(out, Figure::kUnreadFaces, fmt::format("and {} more faces", faces.size() - kMostFacesNamed));
}

/// Coverage that was measured but is not proved; of a target that is cut too deep, nothing of it is.
void add_coverage(const VerifyReport& report, double least, Acceptance& out) {
  if (!(report.coverage_reachable >= least)) {
    add_reason(out, Figure::kCoverage,
               fmt::format("finished {:.3f} % < {:.3f} % of the accessible area; {:.3f} % of the whole face",
                           100.0 * report.coverage_reachable, 100.0 * least, 100.0 * report.coverage));
    return;
  }
  const bool deep = report.overcut_bound_mm > report.tolerance_mm;
  if (deep || !report.coverage_reachable_bound || *report.coverage_reachable_bound >= least) return;
  const auto worst = std::min_element(report.faces.begin(), report.faces.end(), [](const auto& a, const auto& b) {
    return a.target != b.target ? a.target : a.target && a.coverage_bound - a.coverage < b.coverage_bound - b.coverage;
  });
  const Vec3 p = worst != report.faces.end() ? worst->uncovered_point : Vec3(Vec3::Zero());
  add_reason(out, Figure::kCoverageBound,
             fmt::format("finished area is not proved: {:.3f} % of the accessible area measured, {:.3f} % proved < "
                         "{:.3f} %; largest unproved area near ({:.3f}, {:.3f}, {:.3f})",
                         100.0 * report.coverage_reachable, 100.0 * *report.coverage_reachable_bound, 100.0 * least,
                         p.x(), p.y(), p.z()));
}

/// Which tool would reach what is left of the whole face.
std::string who_reaches(const VerifyReport& report) {
  if (!report.finer_reach) return "";
  const auto& [radius, share] = *report.finer_reach;
  // As far as the ball of the request goes everything was in reach, and is left all the same.
  constexpr double kAlike = 0.999;
  if (radius >= kAlike * report.reach_radius_mm) return "; this tool could reach it";
  if (!(radius > report.tolerance_mm)) return "; no tool reaches it";
  return fmt::format("; a tool of radius {:.2g} mm would reach {:.1f} %", radius, 100.0 * share);
}

/// What is proved of the face of which most is left: a tool that is no thinner does not finish it.
std::string who_leaves(const VerifyReport& report) {
  if (!report.least_left || report.least_left->bound_mm < report.tolerance_mm) return "";
  const LeastLeft& left = *report.least_left;
  return fmt::format(
      "; at ({:.3f}, {:.3f}, {:.3f}) every tool with no radius below {:.3g} mm leaves or cuts {:.2g} mm or more",
      left.point.x(), left.point.y(), left.point.z(), digits_above(left.radius_mm, 3), digits_below(left.bound_mm, 2));
}

/// The share of the whole face, whatever is reachable: a demand, or, where none was made, a caution if as much is left as of what is
/// reachable may be.
void add_whole(const VerifyReport& report, const JudgeRequest& request, Acceptance& out) {
  const double wanted = request.least_whole.value_or(request.least_coverage);
  const bool deep = report.overcut_bound_mm > report.tolerance_mm;
  const bool proved = deep || !report.coverage_bound || *report.coverage_bound >= wanted;
  if (report.coverage >= wanted && (proved || !request.least_whole)) return;
  if (report.coverage >= wanted) {
    add_reason(
        out, Figure::kWholeCoverage,
        fmt::format("finished area of the whole face is not proved: {:.3f} % measured, {:.3f} % proved < {:.3f} %",
                    100.0 * report.coverage, 100.0 * *report.coverage_bound, 100.0 * wanted));
    return;
  }
  const std::string text =
      fmt::format("{:.2f} % of the face is not finished, up to {:.2g} mm of excess material{}{}",
                  100.0 * (1.0 - report.coverage), report.undercut_mm, who_reaches(report), who_leaves(report));
  if (request.least_whole)
    add_reason(out, Figure::kWholeCoverage,
               fmt::format("{}; {:.3f} % of the whole face is required", text, 100.0 * wanted));
  else
    add_caution(out, Figure::kWholeCoverage, text);
}

/// A motion that turns on the spot leaves a mark, and a machine slows down to nothing there.
void add_turn(const VerifyReport& report, const JudgeRequest& request, Acceptance& out) {
  if (!report.turn || !(report.turn->angle_deg > request.most_turn_deg) || request.most_turn_deg <= 0.0) return;
  const Vec3& p = report.turn->point;
  add_reason(out, Figure::kTurn,
             fmt::format("the motion changes direction by {:.1f} degrees > {:.4g} within 1 % of the face's diagonal, "
                         "pass {}, tip at ({:.3f}, {:.3f}, {:.3f})",
                         report.turn->angle_deg, request.most_turn_deg, report.turn->strip + 1, p.x(), p.y(), p.z()));
}

/// Feeds can be lowered, and a second pass takes what a first one leaves: what bending adds is no fault of the path.
void add_bending(const VerifyReport& report, Acceptance& out) {
  if (!report.bending) return;
  const BendingReport& b = *report.bending;
  const auto beyond = [&](double stiff, double bent) { return bent > report.tolerance_mm && bent > stiff; };
  if (!beyond(b.overcut_mm, b.bent_overcut_mm) && !beyond(b.undercut_mm, b.bent_undercut_mm)) return;
  add_caution(
      out, Figure::kBending,
      fmt::format("where the tool bends under the load, it gouges by {:.3f} mm and leaves {:.3f} mm (stiff: {:.3f} and "
                  "{:.3f}), by samples; most is added at ({:.3f}, {:.3f}, {:.3f})",
                  b.bent_overcut_mm, b.bent_undercut_mm, b.overcut_mm, b.undercut_mm, b.most_point.x(),
                  b.most_point.y(), b.most_point.z()));
}

/// Whether anything could hold the tool, and what of that was not given.
void add_hold(const Tool& tool, const VerifyReport& report, Acceptance& out) {
  if (report.hold && !report.hold->axis.kept) {
    const ClearanceFigure& axis = report.hold->axis;
    add_reason(out, Figure::kHold,
               fmt::format("nothing could hold the tool: above the flank its axis runs through {} at ({:.3f}, {:.3f}, "
                           "{:.3f}), pass {}",
                           axis.obstacle, axis.point.x(), axis.point.y(), axis.point.z(), axis.strip + 1));
  }
  if (!tool.shank.empty() && !tool.holder.empty()) return;
  std::string text =
      tool.shank.empty() ? tool.holder.empty() ? "shank and holder were" : "the shank was" : "the holder was";
  text += " not given and not checked";
  if (report.hold && report.hold->as_thick && !report.hold->as_thick->kept) {
    const ClearanceFigure& f = *report.hold->as_thick;
    text += fmt::format(
        ": a shank as thick as the flank's upper end would collide with {} by {:.2g} mm within one diameter above it, "
        "pass {}; the flank is {:.4g} mm long",
        f.obstacle, f.bound_mm - f.clearance_mm, f.strip + 1, tool.radial.axis_length());
  }
  add_caution(out, Figure::kBodyUnknown, text);
}

/// How near, or how deep, and where, beside the clearance that is required.
std::string lost_clearance(const ClearanceFigure& f) {
  const std::string place =
      fmt::format("({:.3f}, {:.3f}, {:.3f}), pass {}", f.point.x(), f.point.y(), f.point.z(), f.strip + 1);
  if (f.clearance_mm < 0.0)
    return fmt::format("the {} collides with {} by {:.3f} mm at {}", body_name(f.body), f.obstacle, -f.clearance_mm,
                       place);
  // The figure less its bound is what counts (ClearanceFigure::kept).
  return fmt::format("the {} keeps {:.3f} mm (+-{:.3f}) from {}, not the {} mm that are required, at {}",
                     body_name(f.body), f.clearance_mm, f.bound_mm, f.obstacle, f.required_mm, place);
}

}  // namespace

void add_reason(Acceptance& acceptance, Figure figure, std::string text) {
  acceptance.reasons.push_back({std::string(figure_name(figure)), std::move(text)});
}

void add_caution(Acceptance& acceptance, Figure figure, std::string text) {
  acceptance.cautions.push_back({std::string(figure_name(figure)), std::move(text)});
}

Acceptance accept(const Tool& tool, const VerifyReport& report, const JudgeRequest& request, bool complete) {
  Acceptance out;
  if (!complete) add_reason(out, Figure::kComplete, "interrupted: incomplete");
  if (const Legitimacy legitimacy = check_legitimacy(tool.radial); !legitimacy.legitimate)
    add_reason(out, Figure::kLegitimate, "the tool's profile is not valid: " + legitimacy.reason);
  add_sheet_sides(report, out);
  if (!complete && report.verdict == Verdict::kNotRun) {
    add_reason(out, Figure::kVerdict, "not checked; run `flank verify`");
    return out;
  }
  add_cuts(report, true, out);
  add_cuts(report, false, out);
  add_unread(report, out);
  add_buried(report, out);
  // What was stopped was judged by samples alone, and says already why it does not pass.
  if (complete) add_unproved(report, out);
  add_coverage(report, request.least_coverage, out);
  add_whole(report, request, out);
  add_turn(report, request, out);
  add_hold(tool, report, out);
  add_bending(report, out);
  for (const ClearanceFigure& f : report.clearance.figures)
    if (!f.kept) add_reason(out, Figure::kClearance, lost_clearance(f));
  return out;
}

void accept_stock(const StockReport& stock, double most_engagement_deg, double tolerance_mm, Acceptance& acceptance,
                  const std::function<std::string(std::size_t, std::size_t)>& where) {
  constexpr double kSpareCells = 0.1;
  // The replay cuts cells: an engagement that is over by less than one of them may be the grid's.
  const double most = most_engagement_deg + stock.resolution_deg;
  for (const StockKind& kind : stock.kinds)
    // Cycles make the limit; a finishing sweep or a link that engages more has met what they have left.
    if (kind.engagement_deg > most && !kind.cuts_a_slot())
      add_reason(acceptance, Figure::kStock,
                 fmt::format("stock simulation: {} with an engagement of {:.2f} degrees > {} + {:.2f}, {}",
                             move_words(kind.kind), kind.engagement_deg, most_engagement_deg, stock.resolution_deg,
                             where ? where(static_cast<std::size_t>(kind.strip), kind.pose)
                                   : fmt::format("pass {}", kind.strip + 1)));
  // A stretch of up to two cells may only be the grid's.
  if (stock.uncut_mm > std::max(kMostUncutMm, 2.0 * stock.cell_mm)) {
    const Vec3& p = stock.uncut_point;
    add_reason(
        acceptance, Figure::kStock,
        fmt::format("stock simulation: {:.3f} mm of material left in front of the side at ({:.3f}, {:.3f}, {:.3f})",
                    stock.uncut_mm, p.x(), p.y(), p.z()));
  }
  if (stock.entered_mm > tolerance_mm + kSpareCells * stock.cell_mm)
    add_reason(acceptance, Figure::kStock,
               fmt::format("stock simulation: a face is gouged by {:.4f} mm > {} mm", stock.entered_mm, tolerance_mm));
}

void accept_bends(const PlanJob& job, const BendRadii& bends, Acceptance& acceptance) {
  const auto* fit = std::get_if<FitJob>(&job);
  if (fit == nullptr || !fit->min_bend_radius_mm) return;
  const double asked = *fit->min_bend_radius_mm;
  for (const auto& [end, radius_mm] : {std::pair("tip", bends.tip_mm), std::pair("holder end", bends.holder_end_mm)})
    if (radius_mm < asked)
      add_reason(
          acceptance, Figure::kBendRadius,
          fmt::format("smallest radius of curvature of the path of the {}: {:.3g} mm < {} mm", end, radius_mm, asked));
}

void accept_cavity(const TrochoidSummary& cavity, Acceptance& acceptance) {
  const auto with_colon = [](const std::string& why) { return why.empty() ? why : ": " + why; };
  constexpr double kSpareDeg = 1e-6;  // rounding of a limit that cycles are made to reach
  if (cavity.largest_deg() > cavity.most_engagement_deg + kSpareDeg)
    add_reason(acceptance, Figure::kEngagement,
               fmt::format("engagement {:.2f} degrees > {} degrees", cavity.largest_deg(), cavity.most_engagement_deg));
  for (std::size_t k = 0; k < cavity.layers.size(); ++k)
    if (cavity.layers[k].side_deg > cavity.most_engagement_deg + kSpareDeg)
      add_reason(acceptance, Figure::kEngagement,
                 fmt::format("layer {}: a finishing pass has an engagement of {:.2f} degrees > {} degrees", k + 1,
                             cavity.layers[k].side_deg, cavity.most_engagement_deg));
  // A layer that ended early has a good engagement in what it has, and leaves the rest.
  for (std::size_t k = 0; k < cavity.layers.size(); ++k)
    if (cavity.layers[k].status != "done")
      add_reason(acceptance, Figure::kCycles,
                 fmt::format("layer {} is {} after {} cycles{}", k + 1, cavity.layers[k].status,
                             cavity.layers[k].cycles, with_colon(cavity.layers[k].why)));
  if (cavity.layers.empty())
    add_reason(acceptance, Figure::kCycles, "no cycle was planned" + with_colon(cavity.no_cycles));
}

std::string reason_lines(const Acceptance& acceptance) {
  std::string text;
  for (const Shortfall& reason : acceptance.reasons) text += "              " + reason.text + "\n";
  for (const Shortfall& caution : acceptance.cautions) text += "  CAUTION     " + caution.text + "\n";
  return text;
}

}  // namespace flank::internal
