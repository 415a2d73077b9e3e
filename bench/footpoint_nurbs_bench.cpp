// Footpoints on NURBS faces: our warm `track` against Open CASCADE's ShapeAnalysis_Surface::NextValueOfUV and our cold
// `closest` against its ValueOfUV, one thread, the same surfaces and points, medians of interleaved repetitions. Real
// faces come from FLANK_DATA and are left out without it.
#include <Geom_BSplineSurface.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "flank/base/random.h"
#include "flank/part.h"
#include "flank/target.h"

namespace {

using namespace flank;
using namespace flank::internal;

constexpr int kRepetitions = 5;
constexpr int kWarmLines = 60, kWarmPoints = 50;
constexpr int kColdPoints = 150;

struct Subject {
  std::string name;
  Face face;
};

void knots_of(const std::vector<double>& flat, TColStd_Array1OfReal*& knots, TColStd_Array1OfInteger*& multiplicities) {
  std::vector<double> values;
  std::vector<int> counts;
  for (double k : flat) {
    if (values.empty() || k > values.back()) {
      values.push_back(k);
      counts.push_back(0);
    }
    ++counts.back();
  }
  knots = new TColStd_Array1OfReal(1, static_cast<int>(values.size()));
  multiplicities = new TColStd_Array1OfInteger(1, static_cast<int>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) {
    knots->SetValue(static_cast<int>(i) + 1, values[i]);
    multiplicities->SetValue(static_cast<int>(i) + 1, counts[i]);
  }
}

Handle(Geom_BSplineSurface) occt_surface(const BSplineSurface& s) {
  TColgp_Array2OfPnt poles(1, s.count_u, 1, s.count_v);
  TColStd_Array2OfReal weights(1, s.count_u, 1, s.count_v);
  for (int i = 0; i < s.count_u; ++i)
    for (int j = 0; j < s.count_v; ++j) {
      const Vec3& p = s.pole(i, j);
      poles.SetValue(i + 1, j + 1, gp_Pnt(p[0], p[1], p[2]));
      weights.SetValue(i + 1, j + 1, s.weights.empty() ? 1.0 : s.weights[static_cast<std::size_t>(i * s.count_v + j)]);
    }
  TColStd_Array1OfReal *ku = nullptr, *kv = nullptr;
  TColStd_Array1OfInteger *mu = nullptr, *mv = nullptr;
  knots_of(s.knots_u, ku, mu);
  knots_of(s.knots_v, kv, mv);
  Handle(Geom_BSplineSurface) result =
      s.weights.empty() ? new Geom_BSplineSurface(poles, *ku, *kv, *mu, *mv, s.degree_u, s.degree_v)
                        : new Geom_BSplineSurface(poles, weights, *ku, *kv, *mu, *mv, s.degree_u, s.degree_v);
  delete ku;
  delete kv;
  delete mu;
  delete mv;
  return result;
}

/// A doubly curved bicubic patch with 20 x 20 control points, 100 mm wide.
Face generated() {
  Face f;
  f.id = "generated";
  f.surface = {3, 3, uniform_knots(3, 20), uniform_knots(3, 20), 20, 20, {}, {}};
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j) {
      const double x = 100.0 * i / 19, y = 100.0 * j / 19;
      f.surface.poles.emplace_back(x, y, 12 * std::sin(x / 25) * std::cos(y / 30) + 0.002 * x * y);
    }
  return f;
}

std::vector<Subject> subjects() {
  std::vector<Subject> list{{"generated bicubic 20 x 20", generated()}};
  const char* variable = std::getenv("FLANK_DATA");
  const std::string folder = variable != nullptr ? variable : FLANK_SOURCE_DIR "/../shared/data";
  for (const char* file : {"r37_blade.step", "kj66_impeller.step"}) {
    const std::string path = folder + "/" + file;
    if (!std::filesystem::exists(path)) {
      std::printf("%s is not there: left out\n", file);
      continue;
    }
    Face face = read_part(path).faces.at(0);
    face.loops.clear();  // Open CASCADE's projection knows no trims: the whole surface for both
    list.push_back({std::string(file) + " F1", std::move(face)});
  }
  return list;
}

/// Processor time of this thread: other processes of a busy machine do not count.
double now() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double seconds(const std::function<void()>& work) {
  const double start = now();
  work();
  return now() - start;
}

double median(std::vector<double> x) {
  std::nth_element(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2), x.end());
  return x[x.size() / 2];
}

/// Axis points of a moving tool: rows of points above the surface, neighbours about 1 to 2 percent of the face apart.
std::vector<Vec3> warm_points(const BSplineSurface& s, double height) {
  std::vector<Vec3> points;
  for (int i = 0; i < kWarmLines; ++i)
    for (int j = 0; j < kWarmPoints; ++j) {
      const double u = s.u_first() + (s.u_last() - s.u_first()) * (0.05 + 0.9 * i / (kWarmLines - 1));
      const double v = s.v_first() + (s.v_last() - s.v_first()) * (0.05 + 0.9 * j / (kWarmPoints - 1));
      const SurfaceJet jet = s.jet(u, v);
      points.push_back(jet.p + height * jet.du.cross(jet.dv).normalized());
    }
  return points;
}

struct Times {
  std::vector<double> ours, theirs;
  [[nodiscard]] double ratio() const { return median(theirs) / median(ours); }
};

void race_warm(const Subject& subject, const Target& target, ShapeAnalysis_Surface& rival) {
  const std::vector<Vec3> points = warm_points(subject.face.surface, 0.05 * target.diagonal());
  Times times;
  double worst_ours = 0.0, worst_theirs = 0.0;
  for (int repetition = 0; repetition < kRepetitions; ++repetition) {
    std::vector<double> ours(points.size()), theirs(points.size());
    times.ours.push_back(seconds([&] {
      Footpoint f;
      for (std::size_t k = 0; k < points.size(); ++k) {
        if (k % kWarmPoints == 0) f = target.closest(points[k]);
        f = target.track(points[k], f);
        ours[k] = std::abs(f.distance);
      }
    }));
    times.theirs.push_back(seconds([&] {
      gp_Pnt2d uv;
      for (std::size_t k = 0; k < points.size(); ++k) {
        const gp_Pnt p(points[k][0], points[k][1], points[k][2]);
        if (k % kWarmPoints == 0) uv = rival.ValueOfUV(p, 1e-7);
        uv = rival.NextValueOfUV(uv, p, 1e-7);
        theirs[k] = rival.Value(uv).Distance(p);
      }
    }));
    for (std::size_t k = 0; k < points.size(); ++k) {
      worst_ours = std::max(worst_ours, ours[k] - theirs[k]);
      worst_theirs = std::max(worst_theirs, theirs[k] - ours[k]);
    }
  }
  std::printf(
      "%-28s warm: ours %7.3f us, Open CASCADE %8.3f us, ratio %6.1f   worst excess: ours %.1e, theirs %.1e mm\n",
      subject.name.c_str(), 1e6 * median(times.ours) / static_cast<double>(points.size()),
      1e6 * median(times.theirs) / static_cast<double>(points.size()), times.ratio(), worst_ours, worst_theirs);
}

void race_cold(const Subject& subject, const Target& target, ShapeAnalysis_Surface& rival, double margin) {
  Random random(7);
  std::vector<Vec3> points;
  const Vec3 spare = Vec3::Constant(margin * target.diagonal());
  const Vec3 low = target.box().low - spare, high = target.box().high + spare;
  for (int k = 0; k < kColdPoints; ++k)
    points.emplace_back(random.uniform(low[0], high[0]), random.uniform(low[1], high[1]),
                        random.uniform(low[2], high[2]));
  Times times;
  std::vector<double> ours(points.size()), theirs(points.size());
  for (int repetition = 0; repetition < kRepetitions; ++repetition) {
    times.ours.push_back(seconds([&] {
      for (std::size_t k = 0; k < points.size(); ++k) ours[k] = std::abs(target.closest(points[k]).distance);
    }));
    times.theirs.push_back(seconds([&] {
      for (std::size_t k = 0; k < points.size(); ++k) {
        const gp_Pnt p(points[k][0], points[k][1], points[k][2]);
        theirs[k] = rival.Value(rival.ValueOfUV(p, 1e-7)).Distance(p);
      }
    }));
  }
  int missed_by_us = 0, missed_by_them = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    missed_by_us += ours[k] > theirs[k] + 1e-6;
    missed_by_them += theirs[k] > ours[k] + 1e-6;
  }
  std::printf(
      "%-28s cold, margin %4.2f: ours %7.3f us, Open CASCADE %8.2f us, ratio %6.1f   missed: ours %d, theirs %d of "
      "%zu\n",
      subject.name.c_str(), margin, 1e6 * median(times.ours) / static_cast<double>(points.size()),
      1e6 * median(times.theirs) / static_cast<double>(points.size()), times.ratio(), missed_by_us, missed_by_them,
      points.size());
}

}  // namespace

int main() {
  for (const Subject& subject : subjects()) {
    const double build = seconds([&] { (void)make_target(std::vector<Face>{subject.face}); });
    const auto target = make_target(std::vector<Face>{subject.face});
    std::printf("%-28s build %.1f ms\n", subject.name.c_str(), 1e3 * build);
    ShapeAnalysis_Surface rival(occt_surface(subject.face.surface));
    race_warm(subject, *target, rival);
    for (double margin : {0.05, 0.5, 3.0}) race_cold(subject, *target, rival, margin);
  }
  return 0;
}
