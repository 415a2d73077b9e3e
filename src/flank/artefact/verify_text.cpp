// The verdict of verify as a table for a terminal.
#include <fmt/format.h>

#include "flank/artefact/acceptance.h"
#include "flank/artefact/cavity/stock_json.h"
#include "flank/artefact/clearance_text.h"
#include "flank/run.h"

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
  text += clearance_text(v.clearance);
  if (v.stock) text += stock_text(*v.stock);
  for (const std::string& note : outcome.notes) text += "note: " + note + "\n";
  text += reach_text(v) + "\n";
  text += depth_text(v) + "\n";
  text += fmt::format("coverage {:.2f} % within {} mm, overcut {:.6f} mm: {}\n", 100.0 * v.coverage, v.tolerance_mm,
                      v.overcut_mm, outcome.acceptance.pass() ? "meets the request" : "does NOT meet the request");
  text += reason_lines(outcome.acceptance);
  return text;
}

}  // namespace flank
