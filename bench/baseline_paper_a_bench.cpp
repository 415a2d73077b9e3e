// Our starts and fit against the literal method of paper A (paper_a.h): the same meshes of about 13,000 vertices, the
// same user line or the same ruled start, one thread, one run (CPU time). Errors are real: distances to the exact face
// (not to the mesh) on a grid three times denser than the fit's, minus the radii, relative to the diagonal; samples
// whose footpoint is past the border do not count.
#include <cmath>
#include <cstdio>

#include "fit_scenes.h"
#include "flank/fit/polish.h"
#include "flank/seed/line_start.h"
#include "flank/threads.h"
#include "paper_a.h"

namespace {

using namespace flank;
using namespace flank::internal;
using namespace flank::internal::bench;

constexpr int kGridT = 298, kGridS = 88;
constexpr int kRepeats = 3;

struct Outcome {
  double largest = 0.0, rms = 0.0, inside = 0.0;  // error; share of samples inside
  double init_s = 0.0, optimise_s = 0.0;
  double settled_s = 0.0;  // when the optimisation's own error first came within 5 percent of its least
  [[nodiscard]] double seconds() const { return init_s + optimise_s; }
};

// distance(i, j) - radius(j) over the grid.
template <class Point, class Radius>
void measure(const Scene& scene, Point point, Radius radius, Outcome& out) {
  int inside = 0;
  double squares = 0.0;
  for (int i = 0; i < kGridT; ++i)
    for (int j = 0; j < kGridS; ++j) {
      const double s = static_cast<double>(j) / (kGridS - 1);
      const Footpoint foot = scene.face->closest(point(static_cast<double>(i) / (kGridT - 1), s));
      if (foot.location != Location::kInside) continue;
      ++inside;
      const double e = foot.distance - radius(s);
      squares += e * e;
      out.largest = std::max(out.largest, std::abs(e) / scene.diagonal);
    }
  out.rms = std::sqrt(squares / std::max(1, inside)) / scene.diagonal;
  out.inside = static_cast<double>(inside) / (kGridT * kGridS);
}

TriangleMesh normalised(const Scene& scene) {
  TriangleMesh mesh = scene.mesh;
  for (Vec3& v : mesh.vertices) v /= scene.diagonal;
  return mesh;
}

double settled(const PaperAResult& result) {
  double least = 1e300;
  for (const PaperAIteration& k : result.trace) least = std::min(least, k.error);
  for (const PaperAIteration& k : result.trace)
    if (k.error <= 1.05 * least) return k.seconds;
  return 0.0;
}

Outcome measure_theirs(const Scene& scene, const PaperAResult& result) {
  Outcome out;
  out.init_s = result.init_seconds;
  out.optimise_s = result.optimise_seconds;
  out.settled_s = settled(result);
  if (result.trace.empty()) return out;
  // A spline through all d_j: what its 30 radii mean between the samples.
  std::vector<Vec2> samples;
  const auto n = static_cast<int>(result.d.size());
  for (int j = 0; j < n; ++j) samples.emplace_back(static_cast<double>(j) / (n - 1), result.d[j]);
  const RadialFunction radii = RadialFunction::spline_through(1.0, samples, n);
  const auto point = [&](double t, double s) {
    return Vec3(scene.diagonal * ((1.0 - s) * result.a.value(t) + s * result.b.value(t)));
  };
  measure(
      scene, point, [&](double s) { return scene.diagonal * radii.at(s).r; }, out);
  return out;
}

Outcome measure_ours(const Scene& scene, const FlankFitResult& result) {
  Outcome out;
  const RuledMotion& motion = result.motions.front();
  measure(
      scene, [&](double t, double s) { return motion.pose(t).at(s * motion.axis_length); },
      [&](double s) { return result.tool.at(s * motion.axis_length).r; }, out);
  return out;
}

FlankFitOptions fit_options(double diagonal) {
  FlankFitOptions options;
  options.tolerance_mm = 1e-5 * diagonal;
  options.bounds.smallest = 1e-3 * diagonal;
  options.bounds.largest = diagonal;
  return options;
}

// The whole fit: several passes of growing resolution, coverage estimated between them, the result validated.
FlankFitResult whole_fit(const Target& target, const RuledMotion& start, double diagonal) {
  return fit_from_starts({{&target, start}}, ToolModel{}, fit_options(diagonal), {});
}

// One pass at the resolution of the rival, 100 x 30 samples and 24 control points: the same work for both.
FlankFitResult one_pass(const Target& target, const RuledMotion& start, double diagonal) {
  const FlankFitOptions options = fit_options(diagonal);
  const FitDraft draft = run_stage(make_draft({{&target, start}}, ToolModel{}, options), options.bounds,
                                   polish_stage(robust_scale(target, options)));
  FlankFitResult result;
  result.tool = draft.tool;
  result.motions = draft.motions;
  return result;
}

void print(const char* who, const Outcome& o, const char* more) {
  std::printf("  %-26s largest %8.2e  rms %8.2e  inside %5.1f %%  init %8.1f ms  optimise %8.1f ms%s\n", who, o.largest,
              o.rms, 100.0 * o.inside, 1e3 * o.init_s, 1e3 * o.optimise_s, more);
}

void print_ratio(const Outcome& theirs, const Outcome& ours) {
  std::printf("  ratio of times %.1f (counted until it settled %.1f), of largest errors %.3g\n",
              theirs.seconds() / ours.seconds(), (theirs.init_s + theirs.settled_s) / ours.seconds(),
              theirs.largest / ours.largest);
}

std::string story(const PaperAResult& result) {
  char text[160];
  std::snprintf(text, sizeof text, "  (%d Euler steps, %zu iterations, settled after %.1f ms)", result.euler_steps,
                result.trace.size() - (result.trace.empty() ? 0 : 1), 1e3 * settled(result));
  return text;
}

template <class Run>
PaperAResult best_of(Run run) {
  PaperAResult best = run();
  for (int k = 1; k < kRepeats; ++k) {
    PaperAResult again = run();
    if (again.init_seconds + again.optimise_seconds < best.init_seconds + best.optimise_seconds)
      best = std::move(again);
  }
  return best;
}

// Ours on both kinds of target, `start` gives the motion for one: its time is the initialisation.
template <class Start>
void race_ours(const Scene& scene, const Target& jets, const Outcome& theirs, Start start) {
  const std::pair<const char*, const Target*> targets[] = {{"mesh with jets", &jets}, {"NURBS face", scene.face.get()}};
  for (const auto& [name, target] : targets) {
    RuledMotion motion;
    const double init = fastest(kRepeats, [&] { motion = start(*target); });
    if (motion.tip.count() == 0) {
      std::printf("  ours, %s: no motion\n", name);
      continue;
    }
    for (const bool whole : {false, true}) {
      FlankFitResult result;
      const double optimise =
          fastest(kRepeats, [&] { result = (whole ? whole_fit : one_pass)(*target, motion, scene.diagonal); });
      Outcome ours = measure_ours(scene, result);
      ours.init_s = init;
      ours.optimise_s = optimise;
      print((std::string(whole ? "ours whole, " : "ours 1 pass, ") + name).c_str(), ours, "");
      print_ratio(theirs, ours);
    }
  }
}

void race_line(const Scene& scene, const PaperA& paper, const Target& jets) {
  const Pose line = scene.start.pose(0.5);
  const double length = scene.start.axis_length;
  const PaperAResult literal =
      best_of([&] { return paper.run(line.tip / scene.diagonal, line.at(length) / scene.diagonal); });
  const Outcome theirs = measure_theirs(scene, literal);
  print("paper A, from a line", theirs, story(literal).c_str());
  race_ours(scene, jets, theirs, [&](const Target& target) { return start_from_line(target, line, length).motion; });
}

BSplineCurve3 scaled(BSplineCurve3 curve, double factor) {
  curve.poles *= factor;
  return curve;
}

void race_ruled(const Scene& scene, const PaperA& paper, const Target& jets) {
  std::vector<double> t;
  Eigen::Matrix3Xd a(3, 200), b(3, 200);
  for (int i = 0; i < 200; ++i) {
    t.push_back(i / 199.0);
    const Pose pose = scene.start.pose(t.back());
    a.col(i) = pose.tip;
    b.col(i) = pose.at(scene.start.axis_length);
  }
  const BSplineCurve3 rail_a = scaled(fit_curve(a, t, 3, 24), 1.0 / scene.diagonal),
                      rail_b = scaled(fit_curve(b, t, 3, 24), 1.0 / scene.diagonal);
  const PaperAResult literal =
      best_of([&] { return paper.run(rail_a, rail_b, scene.start.axis_length / scene.diagonal); });
  const Outcome theirs = measure_theirs(scene, literal);
  print("paper A, from rails", theirs, story(literal).c_str());
  race_ours(scene, jets, theirs, [&](const Target&) { return scene.start; });
}

}  // namespace

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  set_thread_count(1);
  std::vector<std::string> names(argv + 1, argv + argc);
  if (names.empty()) names = {"envelope-barrel-1", "envelope-cone-2", "envelope-spline-3"};
  for (const std::string& name : names) {
    const Scene scene = make_scene(name);
    const TriangleMesh mesh = normalised(scene);
    std::unique_ptr<PaperA> paper;
    std::unique_ptr<Target> jets;
    const double prepare_theirs = fastest(1, [&] { paper = std::make_unique<PaperA>(mesh, PaperAOptions{}); });
    const double prepare_ours = fastest(1, [&] { jets = make_target(scene.mesh); });
    std::printf("%s: %zu vertices, preparation %.1f ms, ours %.1f ms\n", name.c_str(), mesh.vertices.size(),
                1e3 * prepare_theirs, 1e3 * prepare_ours);
    race_line(scene, *paper, *jets);
    race_ruled(scene, *paper, *jets);
  }
  return 0;
}
