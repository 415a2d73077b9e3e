// The swept distance of the judge against plain brute force (every step of the path, golden section in t, golden
// section in s inside it) on the same points of an exact envelope: a barrel that runs along a bent, twisting path. Also
// the whole of judge() on 400,000 points.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <vector>

#include "flank/judge.h"
#include "flank/threads.h"

namespace {

using namespace flank;

constexpr double kLength = 40.0;
constexpr int kPoses = 1000;

Tool barrel() {
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kBarrel, kLength, Eigen::Vector3d(85.0, 5.0, 18.0));
  return tool;
}

Pose pose_at(double t) {
  const Vec3 tip(60.0 * t, 12.0 * std::sin(2.5 * t), 3.0 * t * t);
  return {tip, Vec3(0.15 * std::sin(2.0 * t), 0.3 - 0.5 * t, 1.0).normalized()};
}

Path twisted_path() {
  Strip strip;
  for (int i = 0; i < kPoses; ++i) strip.poses.push_back(pose_at(static_cast<double>(i) / (kPoses - 1)));
  return {{strip}};
}

/// Points of the envelope (MATH section 3) on a grid of t and s: f is nearly 0, as on a well cut face.
std::vector<Vec3> envelope_points(const Tool& tool, int count_t, int count_s) {
  std::vector<Vec3> points;
  for (int i = 0; i < count_t; ++i) {
    const double t = (i + 0.5) / count_t, h = 1e-5;
    const Pose pose = pose_at(t), before = pose_at(t - h), after = pose_at(t + h);
    for (int j = 0; j < count_s; ++j) {
      const double s = kLength * (j + 0.5) / count_s;
      const RadialJet r = tool.radial.at(s);
      const Vec3 v = after.at(s) - before.at(s);
      const double along = v.dot(pose.axis);
      const Vec3 across = v - along * pose.axis;
      const Vec3 e1 = across.normalized(), e2 = pose.axis.cross(e1);
      const double w = std::sqrt(1.0 - r.d1 * r.d1), c = r.d1 * along / (w * across.norm());
      if (std::abs(c) >= 1.0) continue;
      points.push_back(pose.at(s) + r.r * (-r.d1 * pose.axis + w * (c * e1 + std::sqrt(1.0 - c * c) * e2)));
    }
  }
  return points;
}

template <class Function>
double golden(double a, double b, const Function& f) {
  constexpr double kGolden = 0.6180339887498949;
  double c = b - kGolden * (b - a), d = a + kGolden * (b - a);
  double fc = f(c), fd = f(d);
  while (b - a > 1e-7) {
    if (fc < fd) {
      b = d, d = c, fd = fc, c = b - kGolden * (b - a), fc = f(c);
    } else {
      a = c, c = d, fc = fd, d = a + kGolden * (b - a), fd = f(d);
    }
  }
  return std::min(fc, fd);
}

double brute_force(const Tool& tool, const Path& path, const Vec3& x) {
  double best = 1e300;
  for (const Strip& strip : path.strips) {
    for (std::size_t i = 0; i + 1 < strip.poses.size(); ++i) {
      const Pose &p = strip.poses[i], &q = strip.poses[i + 1];
      best = std::min(best, golden(0.0, 1.0, [&](double tau) {
                        const Pose pose{p.tip + tau * (q.tip - p.tip), (p.axis + tau * (q.axis - p.axis)).normalized()};
                        return golden(0.0, kLength,
                                      [&](double s) { return (x - pose.at(s)).norm() - tool.radial.at(s).r; });
                      }));
    }
  }
  return best;
}

/// Processor seconds of this process.
double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void race(const Tool& tool, const Path& path) {
  constexpr int kRival = 6;
  const std::vector<Vec3> points = envelope_points(tool, 400, 100);
  double start = cpu_seconds();
  const SweptVolume volume(tool, path);
  const double preparation = cpu_seconds() - start;
  std::vector<SweptDistance> together(points.size());
  start = cpu_seconds();
  volume.distances(points, 1e300, together);
  const double ours = (cpu_seconds() - start) / static_cast<double>(points.size());
  start = cpu_seconds();
  double sum = 0.0;
  for (const Vec3& x : points) sum += volume.distance(x).f;
  const double alone = (cpu_seconds() - start) / static_cast<double>(points.size());
  double difference = 0.0;
  start = cpu_seconds();
  for (int i = 0; i < kRival; ++i) {
    const std::size_t k = points.size() * (2 * i + 1) / (2 * kRival);
    difference = std::max(difference, std::abs(brute_force(tool, path, points[k]) - together[k].f));
  }
  const double rival = (cpu_seconds() - start) / kRival;
  std::printf("%d poses, one thread, processor time\n", kPoses);
  std::printf("  preparation                        %10.2f ms\n", 1e3 * preparation);
  std::printf("  swept distance, points in rows     %10.3f us a point\n", 1e6 * ours);
  std::printf("  swept distance, each point alone   %10.3f us a point (mean f %.1e mm)\n", 1e6 * alone,
              sum / static_cast<double>(points.size()));
  std::printf("  all steps x golden x golden        %10.1f us a point\n", 1e6 * rival);
  std::printf("  ratio %.0f, largest difference %.1e mm\n", rival / ours, difference);
}

void whole(const Tool& tool, const Path& path) {
  FaceSamples face;
  face.face = "F1";
  face.target = true;
  face.points = envelope_points(tool, 2000, 200);
  face.areas.assign(face.points.size(), 1.0);
  face.spacing_mm = 0.2;
  for (int threads : {1, 2}) {
    set_thread_count(threads);
    const auto start = std::chrono::steady_clock::now();
    const VerifyReport r = judge(tool, path, {face}, {});
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::printf("judge(), %zu points x %d poses, %d thread(s): %.2f s wall, coverage %.4f, overcut %.1e mm\n",
                face.points.size(), kPoses, threads, seconds, r.coverage, r.overcut_mm);
  }
}

}  // namespace

int main() {
  const Tool tool = barrel();
  const Path path = twisted_path();
  race(tool, path);
  whole(tool, path);
  return 0;
}
