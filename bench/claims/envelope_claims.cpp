// Exact envelopes of known tools under known motions: 4 tools x 3 motions.
#include "claims/claims_support.h"

#include "flank/example/example_write.h"

namespace flank::internal::bench {
namespace {

const char* const kTools[] = {"barrel", "hyperbolic", "cone", "spline"};

std::vector<Figure> from_a_start(const std::string& name) {
  const Example example = make_example(name);
  const double d = example.diagonal_mm;
  const std::unique_ptr<Target> target = make_target(std::vector<Face>{example.faces.front()});
  const RuledMotion start = start_off(example);
  FlankFitResult fit;
  const double seconds = seconds_of([&] {
    fit = fit_from_starts({{target.get(), start}}, ToolModel{}, open_options(d), {});
  });
  const VerifyReport verdict = judge_fit({example.faces.front()}, fit, 5e-5 * d, d / 200.0);
  return {at_most("largest error", largest_error(*target, fit) / d, 2e-6),
          at_most("overcut", verdict.overcut_mm / d, 5e-6),
          at_most("undercut over the covered strip", verdict.undercut_covered_mm / d, 5e-6),
          at_least("coverage", verdict.coverage, 0.95), shown("seconds", seconds)};
}

/// The whole command: from the STEP file.
std::vector<Figure> from_the_face(const std::string& name, bool with_length) {
  const Example example = make_example(name);
  const double d = example.diagonal_mm;
  write_example(example, scratch(name + ".step"));
  FitJob job;
  job.strips = 1;
  job.part.file = scratch(name + ".step");
  job.part.side = +1;
  job.tolerance_mm = 5e-5 * d;
  if (with_length) job.tool.axis_length_mm = example.truth->motions.front().axis_length;
  Result outcome;
  const double seconds = seconds_of([&] { outcome = run_fit(job, {}); });
  return {at_least("coverage", outcome.verify.coverage, 0.97), at_most("overcut", outcome.verify.overcut_mm / d, 1e-5),
          at_most("seconds", seconds, 5.0)};
}

std::vector<Figure> forced_cone(const std::string& name) {
  const Example example = make_example(name);
  const double d = example.diagonal_mm;
  const std::unique_ptr<Target> target = make_target(std::vector<Face>{example.faces.front()});
  const RuledMotion start = start_off(example);
  ToolModel cone;
  cone.make = [&](double length, double) {
    Eigen::VectorXd parameters = example.truth->tool.radial.parameters();
    parameters[0] *= 1.1;
    return RadialFunction(ToolFamily::kCone, length, parameters);
  };
  cone.free_parameters = {0, 1};
  const FlankFitResult fit = fit_from_starts({{target.get(), start}}, cone, open_options(d), {});
  return {at_most("largest error", largest_error(*target, fit) / d, 1e-6)};
}

std::vector<Figure> deformed() {
  const Example example = make_example("deformed-envelope");
  const double d = example.diagonal_mm;
  write_example(example, scratch("deformed.step"));
  FitJob job;
  job.strips = 1;
  job.part.file = scratch("deformed.step");
  job.part.side = +1;
  job.tolerance_mm = 1e-3 * d;
  const Result outcome = run_fit(job, {});
  return {at_most("real error", std::max(outcome.verify.overcut_mm, outcome.verify.undercut_mm) / d, 1.5e-3),
          shown("overcut", outcome.verify.overcut_mm / d), shown("undercut", outcome.verify.undercut_mm / d),
          at_least("coverage", outcome.verify.coverage, 0.95)};
}

}  // namespace

void add_envelope_claims(std::vector<Claim>& claims) {
  for (const char* tool : kTools)
    for (int k = 1; k <= 3; ++k) {
      const std::string name = std::string("envelope-") + tool + "-" + std::to_string(k);
      claims.push_back({"start off by 1e-2/" + name, [name] { return from_a_start(name); }});
    }
  for (const bool with_length : {true, false})
    for (const char* tool : kTools)
      for (int k = 1; k <= 3; ++k) {
        const std::string name = std::string("envelope-") + tool + "-" + std::to_string(k);
        claims.push_back({std::string("automatic, ") + (with_length ? "with" : "without") + " length/" + name,
                          [name, with_length] { return from_the_face(name, with_length); }});
      }
  for (int k = 1; k <= 3; ++k) {
    const std::string name = "envelope-cone-" + std::to_string(k);
    claims.push_back({"forced cone/" + name, [name] { return forced_cone(name); }});
  }
  claims.push_back({"deformed/deformed-envelope", deformed});
}

}  // namespace flank::internal::bench
