// Uses every part of the front door that a program is likely to: a fit, a cover, the judge, files.
#include <flank/flank.h>

#include <iostream>
#include <string>

namespace {

/// A flat sheet of 40 x 20 mm, machined from above.
flank::Face sheet() {
  flank::Face face;
  face.id = "F1";
  face.surface.degree_u = face.surface.degree_v = 1;
  face.surface.knots_u = face.surface.knots_v = {0.0, 0.0, 1.0, 1.0};
  face.surface.count_u = face.surface.count_v = 2;
  for (const double u : {0.0, 40.0})
    for (const double v : {0.0, 20.0}) face.surface.poles.emplace_back(u, v, 0.0);
  return face;
}

int fail(const std::string& what) {
  std::cout << what << '\n';
  return 1;
}

}  // namespace

int main(int, char** argv) {
  const std::string folder = argv[1];
  flank::set_thread_count(2);
  const auto target = flank::make_target({sheet()});

  flank::FlankFitOptions fit_options;
  fit_options.tolerance_mm = 0.05;
  fit_options.bounds = {2.0, 4.0, 0.5};
  const flank::FlankFitResult fit = flank::fit_automatic(*target, flank::ToolModel(), fit_options, flank::Progress());
  if (fit.status != flank::FitStatus::kWithinTolerance) return fail("fit: " + fit.message);

  flank::Tool tool;
  tool.radial = flank::RadialFunction(flank::ToolFamily::kCylinder, 25.0, Eigen::VectorXd::Constant(1, 3.0));
  flank::CoverOptions cover_options;
  cover_options.tolerance_mm = 0.05;
  const flank::CoverResult cover = flank::cover(*target, tool, {}, cover_options, flank::Progress());
  if (cover.motions.empty()) return fail("cover: " + cover.message);

  flank::Path path;
  for (const flank::RuledMotion& motion : cover.motions) {
    flank::Strip& strip = path.strips.emplace_back();
    strip.id = static_cast<int>(path.strips.size());
    strip.poses = flank::sample_motion(motion, {}).poses;
  }
  flank::write_tool(tool, folder + "/tool.json");
  flank::write_path(path, folder + "/path.json");
  const flank::Tool tool_again = flank::read_tool(folder + "/tool.json");
  const flank::Path path_again = flank::read_path(folder + "/path.json");
  if (path_again.pose_count() != path.pose_count()) return fail("the path was not read as it was written");

  flank::JudgeOptions judge_options;
  judge_options.tolerance_mm = 0.05;
  const std::vector<flank::FaceSamples> samples{flank::sample_face(sheet(), 0.5, true)};
  const flank::VerifyReport report = flank::judge(tool_again, path_again, samples, judge_options);
  if (report.coverage < 0.95) return fail("the judge sees " + std::to_string(report.coverage));

  try {
    (void)flank::read_part(folder + "/no such file.step");
    return fail("a part that is not there was read");
  } catch (const flank::InputError&) {
    std::cout << "fit, cover, judge, tool and path: all there\n";
  }
  return 0;
}
