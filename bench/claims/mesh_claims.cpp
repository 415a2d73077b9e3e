// The exact envelope as a mesh of about 13,000 vertices: clean, noisy, with two holes. Errors are against the exact face.
#include "claims/claims_support.h"
#include "flank/example/example_envelope.h"
#include "flank/example/example_write.h"
#include "flank/setup/targets.h"

namespace flank::internal::bench {
namespace {

std::vector<Figure> from_a_start(const std::string& name, double bound, double least_coverage) {
  const Example example = make_example(name);
  const double d = example.diagonal_mm;
  const RuledMotion& truth = example.truth->motions.front();
  const EnvelopeFace exact = envelope_face(truth, example.truth->tool.radial, 1e-9);
  const std::unique_ptr<Target> exact_target = make_target(std::vector<Face>{exact.face});
  write_example(example, scratch(name + ".ply"));
  const Part part = read_part(scratch(name + ".ply"), "mm");
  const std::vector<TargetGroup> targets = make_targets({part, {0}, {}, 0.01, {}});
  const RuledMotion start = start_off(example);
  const FlankFitOptions options = open_options(d);
  FlankFitResult fit;
  const double seconds = seconds_of([&] {
    fit = fit_from_starts({{targets.front().target.get(), start}}, ToolModel{}, options, {});
  });
  const VerifyReport verdict = judge_fit({exact.face}, fit, 5e-5 * d, d / 200.0);
  return {at_most("largest error", largest_error(*exact_target, fit) / d, bound),
          at_least("coverage", verdict.coverage, least_coverage), shown("seconds", seconds)};
}

}  // namespace

void add_mesh_claims(std::vector<Claim>& claims) {
  claims.push_back({"mesh/envelope-mesh", [] { return from_a_start("envelope-mesh", 1e-5, 0.95); }});
  claims.push_back({"mesh/envelope-noisy", [] { return from_a_start("envelope-noisy", 1e-4, 0.5); }});
  claims.push_back({"mesh/envelope-holes", [] { return from_a_start("envelope-holes", 5e-6, 0.95); }});
}

}  // namespace flank::internal::bench
