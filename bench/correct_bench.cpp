// flank correct on a simulated machine: a tool that bends, a machine that grows warm, run-out, a tool ground with errors. The machine
// cuts, the face is measured with noise, the command corrects, the same machine cuts again. Error left and share taken away, beyond
// what the plan itself leaves (a face that is no envelope of the tool has a rest that no machine is to blame for), of four
// parts. What the machine leaves is computed here, by dense search over its poses; nothing of it is shared with the corrector.
// usage: bench_correct [PART or CASE...]
#include <fmt/format.h>
#include <unistd.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "asked_for.h"
#include "flank/base/parallel.h"
#include "flank/base/random.h"
#include "flank/part.h"
#include "flank/path_file.h"
#include "flank/target.h"
#include "flank/tool_file.h"
#include "part_file.h"

namespace {

namespace fs = std::filesystem;
using namespace flank;
using flank::internal::Random;

constexpr double kNoise = 0.002;  ///< mm, standard deviation of a measured point
constexpr int kChecked = 1500;    ///< points of the face at which the cut is judged, without noise
constexpr double kLeft = 1.5, kTaken = 0.92;

/// What is wrong with the machine. Lengths in mm.
struct Faults {
  double bend = 0.0;     ///< deflection of the tip, away from the face; the load depends on the place
  double warm = 0.0;     ///< the tool's shift after a way as long as the face, growing to a limit
  double run_out = 0.0;  ///< added to the radius everywhere
  double taper = 0.0;    ///< of the radius, from tip to upper end
  double bow = 0.0;      ///< of the radius, in the middle
};

struct Case {
  std::string name;
  int points = 2000;
  Faults faults;
  bool wrong_datum = false;  ///< the part lies elsewhere when it is measured
};

const std::vector<Case> kCases = {
    {"bend", 2000, {.bend = 0.06}},
    {"warm", 2000, {.warm = 0.05}},
    {"run-out", 2000, {.run_out = 0.02}},
    {"profile", 2000, {.taper = 0.03, .bow = 0.01}},
    {"all-200", 200, {.bend = 0.06, .warm = 0.03, .run_out = 0.01, .taper = 0.01, .bow = 0.002}},
    {"all-2000", 2000, {.bend = 0.06, .warm = 0.03, .run_out = 0.01, .taper = 0.01, .bow = 0.002}},
    {"all-20000", 20000, {.bend = 0.06, .warm = 0.03, .run_out = 0.01, .taper = 0.01, .bow = 0.002}},
    {"datum", 2000, {.bend = 0.06}, true},
};

struct Scene {
  std::string name, file;
  std::string options;  ///< of flank fit
};

/// One cut of the machine: its centres of spheres and radii, on a grid over poses and stations.
class Cut {
 public:
  Cut(const Path& path, const Tool& tool, const Target& face, const Faults& faults) {
    const double length = tool.radial.axis_length();
    double way = 0.0;  // of the middle of the axis, while it cuts
    for (const Strip& strip : path.strips)
      for (std::size_t k = 0; k < strip.poses.size(); ++k) {
        if (k > 0) way += (strip.poses[k].at(0.5 * length) - strip.poses[k - 1].at(0.5 * length)).norm();
        rows_.push_back(row(strip.poses[k], length, tool.radial, face, faults, way / face.diagonal()));
        joined_.push_back(k + 1 < strip.poses.size());
      }
  }

  /// Distance of p from the nearest sphere's surface; positive: material is left there. Every stretch between two rows is searched that may
  /// hold it, because no point is nearer by more than the row has moved.
  [[nodiscard]] double left_at(const Vec3& p) const {
    std::vector<double> f(rows_.size());
    for (std::size_t i = 0; i < rows_.size(); ++i)
      f[i] = least_at(p, std::min(i, rows_.size() - 2), i + 1 < rows_.size() ? 0.0 : 1.0);
    double best = *std::min_element(f.begin(), f.end());
    for (std::size_t i = 0; i + 1 < rows_.size(); ++i)
      if (joined_[i] && 0.5 * (f[i] + f[i + 1] - stride(i)) < best) best = std::min(best, least_between(p, i));
    return best;
  }

 private:
  static constexpr int kStations = 80;
  struct Row {
    std::array<Vec3, kStations + 1> centre;
    std::array<double, kStations + 1> radius{};
  };

  static Row row(const Pose& pose, double length, const RadialFunction& radial, const Target& face,
                 const Faults& faults, double way) {
    const Footpoint touched = face.closest(pose.at(0.5 * length));
    const Vec3 place = (touched.point - face.box().center()) / face.diagonal();
    const Vec3 warm = faults.warm * (1.0 - std::exp(-3.0 * way)) / (1.0 - std::exp(-3.0)) * Vec3(0.6, -0.48, 0.64);
    const double load = faults.bend * (0.7 + 0.3 * std::sin(4.0 * place.x() + 3.0 * place.y() + 2.0 * place.z()));
    Row out;
    for (int j = 0; j <= kStations; ++j) {
      const double share = static_cast<double>(j) / kStations, s = share * length;
      // A cantilever that is clamped two lengths of the flank above its tip, loaded at the tip.
      const double x = 1.0 - 0.5 * share, bent = x * x * (3.0 - x) / 2.0;
      const auto k = static_cast<std::size_t>(j);
      out.centre[k] = pose.at(s) + warm + load * bent * touched.normal;
      out.radius[k] = radial.at(s).r + faults.run_out + faults.taper * (share - 0.5) +
                      faults.bow * (std::sin(std::numbers::pi * share) - 0.5);
    }
    return out;
  }

  /// No sphere's surface comes nearer to a point by more from row i to the next one.
  [[nodiscard]] double stride(std::size_t i) const {
    const Row &a = rows_[i], &b = rows_[i + 1];
    return std::max((b.centre.front() - a.centre.front()).norm(), (b.centre.back() - a.centre.back()).norm());
  }

  /// Least distance over the stations at a share of the way from row i to the next one: the grid's least and a parabola through it.
  [[nodiscard]] double least_at(const Vec3& p, std::size_t i, double share) const {
    std::array<double, kStations + 1> f{};
    std::size_t least = 0;
    for (std::size_t j = 0; j <= kStations; ++j) {
      const Vec3 centre = (1.0 - share) * rows_[i].centre[j] + share * rows_[i + 1].centre[j];
      f[j] = (p - centre).norm() - ((1.0 - share) * rows_[i].radius[j] + share * rows_[i + 1].radius[j]);
      if (f[j] < f[least]) least = j;
    }
    if (least == 0 || least == kStations) return f[least];
    const double down = f[least - 1] - f[least], up = f[least + 1] - f[least];
    return down + up > 0.0 ? f[least] - (up - down) * (up - down) / (8.0 * (up + down)) : f[least];
  }

  [[nodiscard]] double least_between(const Vec3& p, std::size_t i) const {
    constexpr double kGolden = 0.6180339887498949;
    double a = 0.0, b = 1.0, c = b - kGolden, d = kGolden;
    double fc = least_at(p, i, c), fd = least_at(p, i, d);
    for (int step = 0; step < 14; ++step) {
      if (fc < fd)
        b = d, d = c, fd = fc, c = b - kGolden * (b - a), fc = least_at(p, i, c);
      else
        a = c, c = d, fc = fd, d = a + kGolden * (b - a), fd = least_at(p, i, d);
    }
    return std::min({fc, fd, least_at(p, i, 0.0), least_at(p, i, 1.0)});
  }

  std::vector<Row> rows_;
  std::vector<char> joined_;
};

/// How far the cut surface lies outside of each point, along its normal.
std::vector<double> errors_of(const Cut& cut, const std::vector<SurfaceSample>& points) {
  std::vector<double> errors(points.size());
  internal::parallel_for(points.size(), [&](std::size_t k) {
    double e = 0.0;
    for (int step = 0; step < 2; ++step) e += cut.left_at(points[k].point + e * points[k].normal);
    errors[k] = e;
  });
  return errors;
}

double rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// So many of the face's points, at random.
std::vector<SurfaceSample> some_of(const Target& face, int count, std::uint64_t seed) {
  double spacing = std::sqrt(face.area() / count);
  std::vector<SurfaceSample> all = face.samples(spacing);
  while (all.size() < static_cast<std::size_t>(count)) all = face.samples(spacing *= 0.9);
  Random random(seed);
  for (std::size_t k = all.size() - 1; k > 0; --k) std::swap(all[k], all[random.next() % (k + 1)]);
  all.resize(static_cast<std::size_t>(count));
  return all;
}

/// What is left of errors after the part is moved as it fits best: small moves, to first order.
std::vector<double> without_datum(const std::vector<SurfaceSample>& points, std::vector<double> errors) {
  Vec3 middle = Vec3::Zero();
  for (const SurfaceSample& p : points) middle += p.point / static_cast<double>(points.size());
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(points.size()), 6);
  for (std::size_t k = 0; k < points.size(); ++k)
    rows.row(static_cast<Eigen::Index>(k)) << points[k].normal.transpose(),
        (points[k].point - middle).cross(points[k].normal).transpose() / 10.0;
  const Eigen::Map<Eigen::VectorXd> e(errors.data(), static_cast<Eigen::Index>(errors.size()));
  const Eigen::MatrixXd normal = rows.transpose() * rows + 1e-9 * Eigen::MatrixXd::Identity(6, 6);
  const Eigen::VectorXd rest = e - rows * normal.ldlt().solve(rows.transpose() * e);
  return {rest.data(), rest.data() + rest.size()};
}

void write_scan(const fs::path& file, const Cut& cut, const Target& face, const Case& what) {
  const std::vector<SurfaceSample> points = some_of(face, what.points, 11);
  const std::vector<double> errors = errors_of(cut, points);
  Random random(23);
  const Eigen::Matrix3d turn = what.wrong_datum
                                   ? Eigen::AngleAxisd(0.001, Vec3(1, 2, 3).normalized()).toRotationMatrix()
                                   : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
  const Vec3 shift = what.wrong_datum ? Vec3(0.06, -0.05, 0.08) : Vec3(Vec3::Zero());
  const Vec3 middle = face.box().center();
  std::ofstream out(file);
  out << "x,y,z\n";
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec3 p = points[k].point + (errors[k] + kNoise * random.normal()) * points[k].normal;
    const Vec3 q = middle + turn * (p - middle) + shift;
    out << fmt::format("{:.6f},{:.6f},{:.6f}\n", q.x(), q.y(), q.z());
  }
}

int run(const std::string& command, const fs::path& log) {
  return std::system(fmt::format("{} > '{}' 2>&1", command, log.string()).c_str());
}

struct Ready {
  Scene scene;
  fs::path folder;
  std::unique_ptr<Target> face;
  std::vector<SurfaceSample> checked;
  std::vector<double> planned;  ///< what the plan leaves there on a machine without faults
};

std::optional<Ready> prepare(const Scene& scene, const fs::path& root) {
  Ready ready{scene, root / scene.name, nullptr, {}, {}};
  if (!fs::exists(ready.folder / "path.json"))
    (void)run(fmt::format("{} fit '{}' --face F1 --effort quick --quiet {} -o '{}'", FLANK_BINARY, scene.file,
                          scene.options, ready.folder.string()),
              root / (scene.name + ".log"));
  if (!fs::exists(ready.folder / "path.json")) {
    std::printf("%-18s MISSED: no plan, see %s.log\n", scene.name.c_str(), scene.name.c_str());
    return {};
  }
  const Part part = read_part(scene.file, "mm");
  ready.face = make_target({part.faces.front()}, +1);
  ready.checked = some_of(*ready.face, kChecked, 7);
  const Cut cut(read_path((ready.folder / "path.json").string()), read_tool((ready.folder / "tool.json").string()),
                *ready.face, {});
  ready.planned = errors_of(cut, ready.checked);
  return ready;
}

/// Error of the machine's cut of a folder's path, with the tool of the plan: beyond what the plan itself leaves.
std::vector<double> machine_errors(const Ready& ready, const fs::path& folder, const Faults& faults) {
  const Cut cut(read_path((folder / "path.json").string()), read_tool((ready.folder / "tool.json").string()),
                *ready.face, faults);
  std::vector<double> errors = errors_of(cut, ready.checked);
  for (std::size_t k = 0; k < errors.size(); ++k) errors[k] -= ready.planned[k];
  return errors;
}

bool correct(const Ready& ready, const Case& what, const fs::path& root) {
  const auto began = std::chrono::steady_clock::now();
  const std::string name = ready.scene.name + "-" + what.name;
  const fs::path scan = root / (name + ".csv"), output = root / name;
  {
    const Cut cut(read_path((ready.folder / "path.json").string()), read_tool((ready.folder / "tool.json").string()),
                  *ready.face, what.faults);
    write_scan(scan, cut, *ready.face, what);
  }
  std::vector<double> before = machine_errors(ready, ready.folder, what.faults);
  if (!fs::exists(output / "path.json"))
    (void)run(fmt::format("{} correct '{}' --measured '{}' --datum {} --limit 1 --quiet -o '{}'", FLANK_BINARY,
                          ready.folder.string(), scan.string(), what.wrong_datum ? "fit" : "keep", output.string()),
              root / (name + ".log"));
  if (!fs::exists(output / "correct.json")) {
    std::printf("%-18s %-10s MISSED: nothing written, see %s.log\n", ready.scene.name.c_str(), what.name.c_str(),
                name.c_str());
    return false;
  }
  std::vector<double> after = machine_errors(ready, output, what.faults);
  if (what.wrong_datum) {
    before = without_datum(ready.checked, before);
    after = without_datum(ready.checked, after);
  }
  const double left = rms(after), taken = 1.0 - left / rms(before);
  const double most = std::abs(
      *std::max_element(after.begin(), after.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  const bool met = left <= kLeft * kNoise && taken >= kTaken;
  std::printf("%-18s %-10s %6d  %8.4f  %8.4f  %8.4f  %6.1f %%  %8.4f  %5.0f s  %s\n", ready.scene.name.c_str(),
              what.name.c_str(), what.points, rms(before), left, most, 100.0 * taken, rms(ready.planned), took,
              met ? "met" : "MISSED");
  std::fflush(stdout);
  return met;
}

/// A tool that came from the grinder with errors of 10 um: coverage and gouge on the old motion and on the new one, by the judge. A
/// figure to look at: how much can be regained is for the face to say.
void as_ground(const Ready& ready, const fs::path& root) {
  constexpr double kWave = 0.006, kTaper = 0.004;  // mm: 10 um together
  constexpr int kPoints = 400;
  const RadialFunction radial = read_tool((ready.folder / "tool.json").string()).radial;
  const std::string name = ready.scene.name + "-ground";
  const fs::path profile = root / (name + ".csv"), output = root / name;
  Random random(31);
  std::ofstream out(profile);
  const double length = radial.axis_length();
  for (int k = 0; k < kPoints; ++k) {
    const double share = (k + 0.5) / kPoints, turn = 3.0 * std::numbers::pi * share;
    const RadialJet nominal = radial.at(share * length);
    const double r = nominal.r + kWave * std::sin(turn) + kTaper * (2.0 * share - 1.0) + kNoise * random.normal();
    const double slope = nominal.d1 + (3.0 * std::numbers::pi * kWave * std::cos(turn) + 2.0 * kTaper) / length;
    out << fmt::format("{:.6f},{:.6f}\n", share * length - r * slope, r * std::sqrt(1.0 - slope * slope));
  }
  out.close();
  if (!fs::exists(output / "path.json"))
    (void)run(fmt::format("{} correct '{}' --profile '{}' --quiet -o '{}'", FLANK_BINARY, ready.folder.string(),
                          profile.string(), output.string()),
              root / (name + ".log"));
  if (!fs::exists(output / "correct.json")) {
    std::printf("%-18s %-10s nothing written, see %s.log\n", ready.scene.name.c_str(), "ground", name.c_str());
    return;
  }
  const nlohmann::json found = nlohmann::json::parse(std::ifstream(output / "correct.json"));
  const auto percent = [&](const char* when) { return 100.0 * found[when]["coverage_reachable"].get<double>(); };
  const auto gouge = [&](const char* when) { return found[when]["overcut_mm"].get<double>(); };
  std::printf("%-18s %-10s finished %.2f %%, gouge %.4f mm; on the new motion %.2f %%, %.4f mm\n",
              ready.scene.name.c_str(), "ground", percent("before"), gouge("before"), percent("after"), gouge("after"));
  std::fflush(stdout);
}

std::vector<Scene> scenes(const fs::path& root) {
  std::vector<Scene> all;
  for (const char* name : {"envelope-barrel-1", "envelope-cone-1"}) {
    const std::string file = (root / (std::string(name) + ".step")).string();
    (void)run(fmt::format("{} example {} -o '{}'", FLANK_BINARY, name, file), root / "example.log");
    all.push_back({name, file,
                   fmt::format("--tolerance 0.01 --tool '{}'", (root / (std::string(name) + ".tool.json")).string())});
  }
  all.push_back({"kj66", internal::bench::part_file("kj66_impeller.step", root),
                 "--tolerance 0.01 --ignore-faces S2-S11 --radius-min 1.5 --radius-max 2.5"});
  all.push_back({"rotor37", internal::bench::part_file("r37_blade.step", root), "--tolerance 0.1"});
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  const char* kept = std::getenv("FLANK_BENCH_FOLDER");
  const fs::path root =
      kept ? fs::path(kept)
           : fs::temp_directory_path() / fmt::format("flank-correct-bench-{}", static_cast<int>(getpid()));
  fs::create_directories(root);
  std::printf(
      "noise %.3f mm; error beyond what the plan leaves, rms in mm at %d points: before and after one correction, "
      "largest after, share taken away; what the plan itself leaves\n",
      kNoise, kChecked);
  bool good = true;
  for (const Scene& scene : scenes(root)) {
    const bool whole = internal::bench::asked_for(scene.name, argc, argv);
    std::optional<Ready> ready;
    for (const Case& what : kCases) {
      if (!whole && !internal::bench::asked_for(scene.name + "-" + what.name, argc, argv)) continue;
      if (!ready && !(ready = prepare(scene, root))) break;
      good = correct(*ready, what, root) && good;
    }
    if (whole || internal::bench::asked_for(scene.name + "-ground", argc, argv))
      if (ready || (ready = prepare(scene, root))) as_ground(*ready, root);
    good = good && (!whole || ready.has_value());
  }
  if (!kept) fs::remove_all(root);
  std::printf("%s: at most %.1f times the noise left, at least %.0f %% taken away\n", good ? "met" : "MISSED", kLeft,
              100.0 * kTaken);
  return good ? 0 : 1;
}
