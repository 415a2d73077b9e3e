#include "flank/sheet/sheet_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "flank/io/tool/tool_svg.h"
#include "flank/report.h"
#include "flank/results/post_text.h"

namespace flank::internal {
namespace {

constexpr const char* kStyle = R"(
@page { size: A4; margin: 12mm }
body { font: 10pt/1.35 sans-serif; color: #000; background: #fff; max-width: 186mm; margin: 0 auto }
h1 { font-size: 16pt; margin: 0 0 2mm } h2 { font-size: 12pt; margin: 5mm 0 1mm; border-bottom: .3mm solid #000 }
table { border-collapse: collapse; width: 100% } th, td { border: .2mm solid #000; padding: .8mm 1.5mm; text-align: left; vertical-align: top }
td.n, th.n { text-align: right } .drawings { display: flex; gap: 4mm } figure { margin: 0; flex: 1; break-inside: avoid }
figure svg { width: 100%; max-height: 75mm } figcaption { font-size: 9pt }
.verdict { border: .6mm solid #000; padding: 2mm 3mm; margin: 2mm 0; font-weight: bold }
.verdict.no { border-color: #c00000; color: #c00000 } .reason { color: #c00000 }
.caution { border-left: 1.5mm solid #e69500; padding-left: 2mm; margin: 1mm 0 }
.edge { stroke: #777; stroke-width: .15%; } .target { stroke: #000; stroke-width: .5% } .clamp { stroke: #000; stroke-width: .2% }
.axis { stroke: #000; stroke-width: .5% } .zero { fill: #fff; stroke: #000; stroke-width: .5% }
.tool { break-inside: avoid } .tool svg { width: 100%; height: 45mm; margin: 1mm 0 4mm }
)";

std::string row(const std::string& name, const std::string& value) {
  return "<tr><th>" + html_safe(name) + "</th><td>" + html_safe(value) + "</td></tr>\n";
}

std::string number(double value, const char* unit) { return value > 0.0 ? fmt::format("{:.4g} {}", value, unit) : "-"; }

/// The verdict as the folders have it: red where it is no, cautions amber.
std::string verdict_html(const Acceptance& verdict) {
  std::string out = verdict.pass() ? "<div class=\"verdict\">MEETS THE REQUEST</div>\n"
                                   : "<div class=\"verdict no\">DOES NOT MEET THE REQUEST: do not run it</div>\n";
  for (const Shortfall& reason : verdict.reasons) out += "<p class=\"reason\">" + html_safe(reason.text) + "</p>\n";
  for (const Shortfall& caution : verdict.cautions)
    out += "<p class=\"caution\">CAUTION: " + html_safe(caution.text) + "</p>\n";
  return out;
}

/// How far the zero point is from the sides of the part, along the machine's axes: what is probed when the part is set.
std::string zero_text(const SetupSheet& sheet) {
  const Vec3 below = sheet.place.translation - sheet.box.low, above = sheet.box.high - sheet.place.translation;
  return fmt::format(
      "X {:.3f} from the part's left side, {:.3f} from its right; Y {:.3f} from its front, {:.3f} from its back; Z "
      "{:.3f} "
      "above its bottom, {:.3f} below its top (mm; negative: outside of the part)",
      below.x(), above.x(), below.y(), above.y(), below.z(), above.z());
}

/// Which side of the part, in its own frame, lies on the table.
std::string clamped_side(const WorkSetup& place) {
  const Vec3 down = place.rotation().transpose() * Vec3(0.0, 0.0, -1.0);
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(down(k)) > std::abs(down(axis))) axis = k;
  const char* const square = std::abs(down(axis)) > 1.0 - 1e-6 ? "" : " (tilted)";
  return fmt::format("the part's side {}{}{} lies on the table", down(axis) > 0.0 ? "+" : "-", "XYZ"[axis], square);
}

std::string setup_html(const SetupSheet& sheet) {
  const Vec3 size = sheet.box.high - sheet.box.low;
  std::string out = "<h2>The part on the table</h2>\n<table>\n";
  out += row("Part", sheet.part + "  (sha256 " + sheet.part_sha256.substr(0, 12) + ")");
  out += row("Size as clamped", fmt::format("X {:.2f}, Y {:.2f}, Z {:.2f} mm", size.x(), size.y(), size.z()));
  if (sheet.placed) {
    const auto& a = sheet.place.angles_deg;
    out += row("Turned by", fmt::format("A {:g}, B {:g}, C {:g} degrees about X, then Y, then Z", a[0], a[1], a[2]));
    out += row("Clamping", clamped_side(sheet.place));
    if (sheet.work_offset > 0)
      out += row("Zero point",
                 fmt::format("work offset {} ({}) holds {}", sheet.work_offset,
                             sheet.work_offset <= 6 ? fmt::format("G{}", 53 + sheet.work_offset) : "extended",
                             sheet.origin.empty() ? "the zero point of the set-up" : sheet.origin));
    out += row("Zero point is", zero_text(sheet));
  } else {
    out += row("Set-up", "not known: no program was given");
  }
  out += "</table>\n<div class=\"drawings\">\n<figure>" + sheet.front +
         "<figcaption>From the front: X to the right, Z up. Bold: machined; hatched: the table's "
         "side</figcaption></figure>\n<figure>" +
         sheet.above +
         "<figcaption>From above: X to the right, Y up. Circle: zero point</figcaption></figure>\n</div>\n";
  return out;
}

std::string operations_html(const SetupSheet& sheet) {
  std::string out =
      "<h2>Operations</h2>\n<table>\n<tr><th>No</th><th>Name</th><th>What</th><th>Faces</th><th>Tool</th><th "
      "class=\"n\">Passes</th><th class=\"n\">Spindle 1/min</th><th class=\"n\">Feed mm/min</th><th "
      "class=\"n\">Time</th><th>Verdict</th></tr>\n";
  int k = 0;
  for (const SheetOperation& one : sheet.operations) {
    const std::string times = one.copies > 1 ? fmt::format(" ({} times, turned)", one.copies) : "";
    const std::string feed = one.feed_high > 0.0   ? fmt::format("{:.0f} to {:.0f}", one.feed_low, one.feed_high)
                             : one.tool_number > 0 ? std::string("inverse time")
                                                   : std::string("-");
    out += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{}, within {:g} mm</td><td>{}</td><td>{}</td><td class=\"n\">{}</td>"
        "<td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"{}\">{}</td></tr>\n",
        ++k, html_safe(one.name + times), one.kind, one.tolerance_mm, html_safe(one.faces),
        one.tool_number > 0 ? fmt::format("T{}", one.tool_number) : "-", one.strips,
        one.spindle_rpm > 0.0 ? fmt::format("{:.0f}", one.spindle_rpm) : "-", feed,
        one.minutes > 0.0 ? minutes_text(one.minutes) : "-", one.verdict.pass() ? "" : "reason",
        one.verdict.pass() ? "meets" : "does NOT meet");
  }
  return out + "</table>\n";
}

std::string tool_html(const SheetTool& tool) {
  const Tool& t = tool.tool;
  double largest = 0.0;
  for (const Vec2& p : meridian(t.radial, 200)) largest = std::max(largest, p.y());
  const bool shank = !t.shank.empty(), holder = !t.holder.empty();
  const Stiffness bends = stiffness(t);
  std::string out = "<div class=\"tool\"><table>\n";
  out += row("Tool", (tool.number > 0 ? fmt::format("T{}  ", tool.number) : std::string()) + t.name);
  out += row("Diameter, tip", fmt::format("{:.3f} mm, ball of radius {:.3f} mm", 2.0 * largest, t.radial.at(0.0).r));
  out += row("Stick-out", fmt::format("{:.2f} mm from the lowest point to {}", tool.stick_out_mm,
                                      holder  ? "the holder"
                                      : shank ? "the end of the shank"
                                              : "the end of the flank"));
  out += row("Shank", shank ? fmt::format("diameter {:.3f} mm", 2.0 * t.shank.front().y()) : "not given, not checked");
  out += row("Holder", holder ? fmt::format("diameter {:.2f} mm at its face", 2.0 * t.holder.front().y())
                              : "not given, not checked");
  out += row("Length for the control", number(tool.length_mm, "mm, gauge line to controlled point"));
  out += row("Stiffness", fmt::format("L:D {:.2f}, the tip deflects by {:.1f} um under {:g} N", bends.slenderness,
                                      bends.deflection_um, kStiffnessForce));
  return out + "</table>\n" + tool_to_svg(t) + "</div>\n";
}

}  // namespace

std::string sheet_html(const SetupSheet& sheet) {
  const std::string title = "Set-up sheet: " + (sheet.program.empty() ? sheet.part : sheet.program);
  double minutes = 0.0;
  for (const SheetOperation& one : sheet.operations) minutes += one.minutes;
  std::string out = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + html_safe(title) +
                    "</title><style>" + kStyle + "</style></head><body>\n<h1>" + html_safe(title) + "</h1>\n";
  out += verdict_html(sheet.verdict);
  out += "<table>\n";
  if (!sheet.program.empty())
    out += row("Program", sheet.program + "  (sha256 " + sheet.program_sha256.substr(0, 12) + ")" +
                              (sheet.dry_run ? ", DRY RUN: the spindle stands" : ""));
  if (!sheet.machine.empty()) out += row("Machine", sheet.machine);
  if (minutes > 0.0) out += row("Time", minutes_text(minutes) + " in all, without tool changes");
  out += "</table>\n" + setup_html(sheet) + operations_html(sheet) + "<h2>Tools</h2>\n";
  for (const SheetTool& tool : sheet.tools) out += tool_html(tool);
  return out + "</body></html>\n";
}

}  // namespace flank::internal
