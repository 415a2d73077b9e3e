#include "flank/pipeline/verify_job.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "flank/artefact/verify_json.h"
#include "flank/artefact/view.h"
#include "flank/artefact/view_json.h"
#include "flank/base/atomic_file.h"
#include "flank/error.h"
#include "flank/job/job_json.h"
#include "flank/path_file.h"
#include "flank/pipeline/judge_job.h"
#include "flank/tool_file.h"

namespace flank::internal {
namespace {

std::string read_text_file(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(file + ": cannot be read; a folder written by `flank fit` is needed");
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// Shank and holder as asked for now: tool.json has those of the job.
ClearanceJob overrides(const ClearanceJob& asked, const ClearanceJob& merged) {
  ClearanceJob job = asked;
  job.fixtures = merged.fixtures;
  job.required_mm = merged.required_mm;
  return job;
}

}  // namespace

VerifyOutcome run_verify(const VerifyJob& request) {
  const std::filesystem::path folder(request.folder);
  if (!std::filesystem::is_directory(folder))
    throw InputError(request.folder + ": no such folder; a folder written by `flank fit` is needed");
  const auto file = [&](const char* name) { return (folder / name).string(); };
  VerifyOutcome outcome;
  outcome.job = job_from_json(read_text_file(file("job.json")), file("job.json"));
  if (request.part) outcome.job.part = *request.part;
  if (request.tolerance_mm) outcome.job.tolerance_mm = *request.tolerance_mm;
  if (request.sample_mm) outcome.job.sample_mm = request.sample_mm;
  if (request.reach_radius_mm) outcome.job.reach_radius_mm = request.reach_radius_mm;
  check_reach_radius(outcome.job);
  if (request.check.any()) outcome.job.check = request.check;
  if (!(outcome.job.tolerance_mm > 0.0)) throw UsageError("--tolerance: a length > 0 mm is needed");
  ClearanceJob& clearance = outcome.job.clearance;
  if (!request.clearance.fixtures.empty()) clearance.fixtures = request.clearance.fixtures;
  if (request.clearance.required_mm) clearance.required_mm = request.clearance.required_mm;
  Tool tool = read_tool(file("tool.json"));
  const ClearanceJob now = overrides(request.clearance, clearance);
  check_clearance_job(now, &tool);
  equip_tool(now, tool);
  const Path path = read_path(file("path.json"));
  const Part part = read_part(outcome.job.part, outcome.job.unit);
  const std::vector<int> faces = parse_face_list(part, outcome.job.faces);
  const std::vector<int> checks = faces_to_check(part, faces, outcome.job.check);
  if (const std::string note = unchecked_note(part, faces, checks); !note.empty()) outcome.notes.push_back(note);
  outcome.report = judge_job(outcome.job, part, faces, checks, tool, path);
  outcome.report.clearance = measure_clearance(clearance, tool, path, part, faces, checks, outcome.job.unit,
                                               outcome.job.tolerance_mm, outcome.notes);
  outcome.acceptance = accept(tool, outcome.report, outcome.job.least_coverage);
  write_file(file("verify.json"), verify_to_json(outcome.report, outcome.acceptance));
  write_file(file("view.json"), view_to_json(make_view(outcome.job, part, faces, tool, path, outcome.report)));
  return outcome;
}

std::string verify_text(const VerifyOutcome& outcome) {
  const VerifyReport& v = outcome.report;
  std::string text = fmt::format("{:<8} {:>6} {:>11} {:>9} {:>11} {:>11} {:>11}\n", "face", "role", "area mm2",
                                 "coverage", "overcut mm", "undercut mm", "rms mm");
  for (const FaceVerdict& f : v.faces) {
    if (f.target)
      text += fmt::format("{:<8} {:>6} {:>11.2f} {:>8.2f}% {:>11.6f} {:>11.6f} {:>11.6f}\n", f.face, "target",
                          f.area_mm2, 100.0 * f.coverage, f.overcut_mm, f.undercut_covered_mm, f.rms_mm);
    else
      text += fmt::format("{:<8} {:>6} {:>11.2f} {:>9} {:>11.6f}\n", f.face, "check", f.area_mm2, "", f.overcut_mm);
  }
  for (const WorstPlace& w : v.worst)
    text += fmt::format("worst: {} at ({:.3f}, {:.3f}, {:.3f}) f = {:.6f} mm, strip {}, pose {:.2f}, s {:.3f}\n",
                        w.face, w.point.x(), w.point.y(), w.point.z(), w.f, w.strip + 1, w.t, w.s);
  text += clearance_text(v.clearance);
  for (const std::string& note : outcome.notes) text += "note: " + note + "\n";
  text += reach_text(v) + "\n";
  text +=
      fmt::format("coverage {:.2f} % within {} mm, overcut {:.6f} mm, between samples at most {:.4f} mm worse: {}\n",
                  100.0 * v.coverage, v.tolerance_mm, v.overcut_mm, v.sampling_bound_mm,
                  outcome.acceptance.pass() ? "within what was asked" : "NOT within what was asked");
  text += reason_lines(outcome.acceptance);
  return text;
}

}  // namespace flank::internal
