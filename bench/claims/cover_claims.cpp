// Strips of a given tool: exact envelopes that are longer than the tool, blades, channels with a hub, and what a command takes.
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "claims/claims_support.h"
#include "flank/base/parallel.h"
#include "flank/cover.h"
#include "flank/example/example_envelope.h"
#include "flank/example/example_motions.h"
#include "flank/example/example_write.h"
#include "flank/run.h"
#include "flank/strip/line_fit.h"

namespace flank::internal::bench {
namespace {

/// A tool, and the piece of it that has to machine the envelope of the whole.
struct LongTool {
  const char* name;
  ToolFamily family;
  double length, first, piece_length;
  Eigen::VectorXd whole, piece;
  std::optional<double> mirror;  ///< of the whole: r(mirror + x) = r(mirror - x); the piece turned round fits as well
};

std::vector<LongTool> long_tools() {
  const auto values = [](std::initializer_list<double> v) {
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(v.begin(), static_cast<Eigen::Index>(v.size())));
  };
  return {
      {"power", ToolFamily::kPower, 40.0, 8.0, 24.0, values({12.0, 1.5, 1.0, 2.0}), values({24.0, 1.5, 1.0, 2.0}), {}},
      {"barrel", ToolFamily::kBarrel, 40.0, 8.0, 24.0, values({80.0, 6.5, 18.0}), values({80.0, 6.5, 10.0}), 18.0},
      {"hyperbolic", ToolFamily::kHyperbolic, 42.0, 8.5, 25.0, values({4.0, 0.05, 0.006}), values({4.0, 0.05, 0.006}),
       21.0 - 0.05 / 0.012}};
}

/// The true motion of the piece.
Path true_path(const RuledMotion& whole, double first) {
  constexpr int kPoses = 4000;
  Strip strip;
  strip.id = 1;
  for (int i = 0; i <= kPoses; ++i) {
    const Pose pose = whole.pose(static_cast<double>(i) / kPoses);
    strip.poses.push_back({pose.at(first), pose.axis});
  }
  Path path;
  path.strips.push_back(std::move(strip));
  return path;
}

/// How far a pose can be from where its distances belong, mm at the ends of the axis: the root mean square of its errors
/// over the second smallest singular value of their rows. The smallest belongs to the motion along the surface.
double undetermined(const Target& target, const RadialFunction& radial, const Pose& pose) {
  LineFitter fitter(target, radial, {});
  const LineFit line = fitter.measure(pose);
  if (line.inside_share < 1.0) return 1e300;
  const LineFrame frame = line_frame(pose, Vec3::Zero());
  const auto n = static_cast<double>(fitter.feet().size());
  Eigen::Matrix<double, 5, 5> sum = Eigen::Matrix<double, 5, 5>::Zero();
  double squares = 0.0;
  for (std::size_t j = 0; j < fitter.feet().size(); ++j) {
    const double share = static_cast<double>(j) / (n - 1.0);
    const Vec5 row = distance_row(frame, fitter.feet()[j].normal, 2.0 * share - 1.0);
    sum += row * row.transpose() / n;
    squares += std::pow(fitter.feet()[j].distance - radial.at(share * radial.axis_length()).r, 2) / n;
  }
  const double least = Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 5, 5>>(sum).eigenvalues()[1];
  return least > 0.0 ? std::sqrt(squares / least) : 1e300;
}

/// How far a pose is from the true motion: its angle, and the way of its middle, at the true pose whose ends are nearest.
struct Off {
  double degrees = 0.0, mm = 0.0;
};
Off off_truth(const LongTool& tool, const RuledMotion& whole, bool turned, const Pose& pose) {
  const double length = tool.piece_length;
  const auto true_pose = [&](double t) {
    const Pose p = whole.pose(t);
    return turned ? Pose{p.at(2.0 * *tool.mirror - tool.first), -p.axis} : Pose{p.at(tool.first), p.axis};
  };
  const auto distance = [&](double t) {
    const Pose p = true_pose(t);
    return (p.tip - pose.tip).squaredNorm() + (p.at(length) - pose.at(length)).squaredNorm();
  };
  double best = 0.0;
  for (int i = 0; i <= 1000; ++i)
    if (distance(i / 1000.0) < distance(best)) best = i / 1000.0;
  for (double h = 1e-3; h > 1e-12; h *= 0.5)
    for (const double t : {best - h, best + h})
      if (t >= 0.0 && t <= 1.0 && distance(t) < distance(best)) best = t;
  const Pose p = true_pose(best);
  const double angle = std::atan2(p.axis.cross(pose.axis).norm(), p.axis.dot(pose.axis));
  return {angle * 180.0 / std::numbers::pi, (p.at(0.5 * length) - pose.at(0.5 * length)).norm()};
}

/// How many poses of the strips their distances determine to what is asked of them, and how many of those are there.
struct Positions {
  int poses = 0, determined = 0, there = 0;
};
Positions positions(const LongTool& tool, const Target& target, const RadialFunction& radial, const RuledMotion& whole,
                    const std::vector<RuledMotion>& motions) {
  constexpr int kPoses = 200;
  constexpr double kDegrees = 0.01, kShare = 1e-4;
  const double turn_mm = 0.5 * radial.axis_length() * kDegrees * std::numbers::pi / 180.0;
  const double asked_mm = std::min(turn_mm, kShare * target.diagonal());
  Positions count;
  for (const RuledMotion& motion : motions) {
    for (int i = 0; i <= kPoses; ++i) {
      ++count.poses;
      const Pose pose = motion.pose(static_cast<double>(i) / kPoses);
      if (undetermined(target, radial, pose) > asked_mm) continue;
      ++count.determined;
      const bool turned = tool.mirror && pose.axis.dot(whole.pose(0.5).axis) < 0.0;
      const Off off = off_truth(tool, whole, turned, pose);
      if (off.degrees <= kDegrees && off.mm <= kShare * target.diagonal()) ++count.there;
    }
  }
  return count;
}

Path sampled(const std::vector<RuledMotion>& motions, double chord_mm) {
  Path path;
  for (const RuledMotion& motion : motions) {
    Strip strip;
    strip.id = static_cast<int>(path.strips.size()) + 1;
    SamplingOptions sampling;
    sampling.chord_tolerance_mm = chord_mm;
    strip.poses = sample_motion(motion, sampling).poses;
    path.strips.push_back(std::move(strip));
  }
  return path;
}

/// Strips from nothing on the envelope of a longer tool; by the judge: the share of what the true motion of the piece
/// finishes, and what its largest error is there.
std::vector<Figure> longer_than_the_tool(const LongTool& t, int motion, double relative) {
  const RuledMotion whole = example_motion(motion, t.length);
  const RadialFunction long_radial(t.family, t.length, t.whole);
  const EnvelopeFace envelope = envelope_face(whole, long_radial, 1e-9);
  const auto target = make_target({envelope.face});
  Tool tool;
  tool.radial = RadialFunction(t.family, t.piece_length, t.piece);
  CoverOptions options;
  options.tolerance_mm = relative * envelope.diagonal_mm;
  CoverResult result;
  const double seconds = seconds_of([&] { result = cover(*target, tool, {}, options, {}); });
  const FaceSamples samples = sample_face(envelope.face, 0.005 * envelope.diagonal_mm, true);
  const SweptVolume truth(tool, true_path(whole, t.first)),
      found(tool, sampled(result.motions, 0.01 * options.tolerance_mm));
  double reachable = 0.0, both = 0.0, deepest = 0.0;
  for (std::size_t k = 0; k < samples.points.size(); ++k) {
    const double f = found.distance(samples.points[k], 1.0).f;
    deepest = std::max(deepest, -f);
    if (std::abs(truth.distance(samples.points[k], 1.0).f) > options.tolerance_mm) continue;
    reachable += samples.areas[k];
    if (std::abs(f) <= options.tolerance_mm) both += samples.areas[k];
  }
  const Positions at = positions(t, *target, tool.radial, whole, result.motions);
  const bool asked = relative >= 1e-5;  // finer ones show where it ends
  return {at_least("share of what one true motion finishes", both / reachable, asked ? 0.95 : 0.0),
          at_most("overcut / diagonal", deepest / envelope.diagonal_mm, relative),
          shown("coverage of the whole face, by the planner", result.coverage),
          shown("strips", static_cast<double>(result.motions.size())),
          at_least("determined positions within 0.01 degrees and 1e-4",
                   static_cast<double>(at.there) / std::max(1, at.determined), at.determined > 0 ? 0.95 : 0.0),
          shown("poses that are determined, share", static_cast<double>(at.determined) / std::max(1, at.poses)),
          shown("seconds", seconds)};
}

/// A command on a part, as a user would give it.
struct Case {
  std::string name, part, face, tool;
  double length, tolerance;  // mm; tolerance below 0: a share of the diagonal
  double coverage;           // asked of the reachable share
  double strips;
  double price = 0.005;  // of a strip: --strip-price
};

std::string example_part(const std::string& name) {
  const std::string file = scratch(name + ".step");
  write_example(make_example(name), file);
  return file;
}

std::vector<Figure> command(const Case& c) {
  CoverJob job;
  job.part.file = c.part.find('.') == std::string::npos ? example_part(c.part) : real_part(c.part);
  job.part.faces = c.face;
  job.tool.spec = c.tool;
  job.tool.axis_length_mm = c.length;
  job.tolerance_mm = c.tolerance > 0.0 ? c.tolerance : -c.tolerance * make_example(c.part).diagonal_mm;
  job.strip_price = c.price;
  Result outcome;
  const double seconds = seconds_of([&] { outcome = run_cover(job, {}); });
  const TargetCover cover = std::get<CoverSummary>(outcome.plan).whole();
  return {shown("coverage before smoothing, by the planner", cover.before),
          shown("coverage of the whole face", outcome.verify.coverage),
          shown("reachable share", outcome.verify.reachable_share),
          at_least("coverage of the reachable share", outcome.verify.coverage_reachable, c.coverage),
          at_most("strips", static_cast<double>(outcome.motions.size()), c.strips),
          shown("overlap", cover.overlap),
          at_most("overcut, mm", outcome.verify.overcut_mm, *job.tolerance_mm),
          at_most("deepest in another face, mm", outcome.verify.gouge_mm, *job.tolerance_mm),
          at_most("seconds", seconds, 30.0)};
}

}  // namespace

void add_cover_claims(std::vector<Claim>& claims) {
  for (const LongTool& tool : long_tools())
    for (const int motion : {1, 2, 3})
      for (const double relative : {1e-5, 1e-7})
        claims.push_back({fmt::format("cover/{} tool, motion {}, at {}", tool.name, motion, relative),
                          [=] { return longer_than_the_tool(tool, motion, relative); }});
  const std::string cylinder = "cylinder:radius=5", blade = "r37_blade.step", wheel = "kj66_impeller.step";
  for (const Case& c :
       {Case{"twisted-blade at 1e-3", "twisted-blade", "F1", cylinder, 20.0, -1e-3, 0.95, 10.0},
        Case{"twisted-blade at 1e-4", "twisted-blade", "F1", cylinder, 20.0, -1e-4, 0.80, 10.0},
        Case{"elliptic-side, a cone", "elliptic-side", "F1", "cone:radius=3,angle=4", 30.0, -1e-3, 0.95, 10.0},
        Case{"r37_blade F1 at 0.05", blade, "F1", cylinder, 20.0, 0.05, 0.97, 10.0},
        Case{"r37_blade F1 at 0.02", blade, "F1", cylinder, 20.0, 0.02, 0.93, 10.0},
        Case{"r37_blade F3 at 0.05", blade, "F3", cylinder, 20.0, 0.05, 0.95, 10.0},
        Case{"r37_blade F3 at 0.02", blade, "F3", cylinder, 20.0, 0.02, 0.90, 10.0},
        Case{"kj66_impeller F1, strips at a tenth of their price", wheel, "F1", "cylinder:radius=2", 25.0, 0.01, 0.999,
             6.0, 5e-4},
        Case{"kj66_impeller F3, strips at a tenth of their price", wheel, "F3", "cylinder:radius=2", 25.0, 0.01, 0.999,
             6.0, 5e-4},
        Case{"blisk F9", "r37_blisk_sector_2blades.step", "F9", cylinder, 20.0, 0.05, 0.90, 10.0},
        Case{"blisk F11", "r37_blisk_sector_2blades.step", "F11", cylinder, 20.0, 0.05, 0.90, 10.0}})
    claims.push_back({"cover/" + c.name, [c] { return command(c); }});
}

}  // namespace flank::internal::bench
