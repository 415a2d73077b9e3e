#include "flank/setup/clearance_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "flank/base/tolerance_budget.h"
#include "flank/error.h"
#include "flank/io/cad/triangulate.h"
#include "flank/io/text/json_input.h"

namespace flank::internal {
namespace {

constexpr double kFinestMm = 0.002, kCoarsestMm = 0.02;  ///< deviation of the triangles, about half the tolerance

void require_length(const std::optional<double>& value, const char* option) {
  if (value && !(*value > 0.0 && std::isfinite(*value)))
    throw UsageError(fmt::format("{} {}: a length > 0 mm is needed", option, *value));
}

/// Words that are too long for the name of a file are none, and no reason to give up.
bool is_there(const std::string& file) {
  std::error_code error;
  return std::filesystem::exists(file, error);
}

/// "30:10,70:12", or lines of "30 10", "30,10" or "30:10" (# starts a comment) when it came from a file.
std::vector<Vec2> pairs_of(std::string text, const std::string& what) {
  std::vector<double> numbers;
  bool comment = false;
  for (char& c : text) {
    if (c == '#') comment = true;
    if (c == '\n') comment = false;
    if (comment || c == ',' || c == ';' || c == ':' || c == '\n' || c == '\r' || c == '\t') c = ' ';
  }
  const char *at = text.data(), *end = at + text.size();
  for (;;) {
    while (at < end && *at == ' ') ++at;
    if (at == end) break;
    double value = 0.0;
    const auto [stop, error] = std::from_chars(at, end, value);
    if (error != std::errc() || (stop < end && *stop != ' ') || !std::isfinite(value))
      throw UsageError(fmt::format("{}: \"{}\" is not a number; z:radius,z:radius,... is accepted", what,
                                   std::string(at, std::find(at, end, ' '))));
    numbers.push_back(value);
    at = stop;
  }
  if (numbers.size() % 2 != 0 || numbers.size() < 4)
    throw UsageError(fmt::format("{}: has {} numbers; two or more pairs z:radius are needed", what, numbers.size()));
  std::vector<Vec2> profile;
  for (std::size_t k = 0; k < numbers.size(); k += 2) profile.emplace_back(numbers[k], numbers[k + 1]);
  return profile;
}

void check_profile(const std::vector<Vec2>& profile, const std::string& what) {
  for (std::size_t i = 0; i < profile.size(); ++i) {
    if (profile[i].x() < 0.0 || profile[i].y() < 0.0)
      throw UsageError(fmt::format("{}: {}:{} is negative; heights above the flank and radii >= 0 are accepted", what,
                                   profile[i].x(), profile[i].y()));
    if (i > 0 && profile[i].x() < profile[i - 1].x())
      throw UsageError(fmt::format("{}: z falls from {} to {}; z must not fall from point to point", what,
                                   profile[i - 1].x(), profile[i].x()));
  }
}

std::vector<Vec2> lifted(std::vector<Vec2> profile, double by) {
  for (Vec2& p : profile) p.x() += by;
  return profile;
}

bool is_mesh_file(const std::string& file) {
  std::string end = std::filesystem::path(file).extension().string();
  std::transform(end.begin(), end.end(), end.begin(), [](unsigned char c) { return std::tolower(c); });
  return end == ".stl" || end == ".obj" || end == ".ply";
}

bool holds(const std::vector<int>& faces, std::size_t face) {
  return std::find(faces.begin(), faces.end(), static_cast<int>(face)) != faces.end();
}

void add_obstacles(const Part& part, ObstacleRole role, const std::vector<int>& targets, const std::vector<int>& checks,
                   double deviation, std::vector<Obstacle>& out, std::vector<std::string>& notes) {
  std::vector<FaceTriangles> faces = triangulate(part, deviation);
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const bool target = holds(targets, k);
    if (role == ObstacleRole::kPart && !target && !holds(checks, k)) continue;
    const std::string file = std::filesystem::path(part.file).filename().string();
    const std::string name = role == ObstacleRole::kFixture ? file + " " + faces[k].face : faces[k].face;
    if (faces[k].deviation_mm > 2.0 * deviation)
      notes.push_back(fmt::format("{}: its triangles for clearances are up to {:.3g} mm off (counted in the bound)",
                                  name, faces[k].deviation_mm));
    if (faces[k].beyond_border)
      notes.push_back(name + ": its triangles for clearances may go past its border, which could not be followed");
    out.push_back({name, target ? ObstacleRole::kTarget : role, std::move(faces[k].mesh), faces[k].deviation_mm});
  }
}

const char* role_words(ObstacleRole role) {
  return role == ObstacleRole::kTarget ? "the target" : role == ObstacleRole::kPart ? "other faces" : "fixtures";
}

}  // namespace

std::vector<Vec2> holder_profile(const std::string& text) {
  const std::string what = "--holder " + text;
  const bool inline_text = text.find(':') != std::string::npos && !is_there(text);
  std::vector<Vec2> profile;
  if (inline_text) {
    profile = pairs_of(text, what);
  } else {
    const std::string content = read_file(text);
    const std::size_t first = content.find_first_not_of(" \t\r\n");
    // The reader of JSON takes objects only.
    profile = first != std::string::npos && content[first] == '['
                  ? JsonInput(text, "{\"holder\":" + content + "}").member("holder").pairs()
                  : pairs_of(content, what);
  }
  if (profile.size() < 2) throw UsageError(what + ": two or more pairs z:radius are needed");
  check_profile(profile, what);
  return profile;
}

void check_clearance_job(const ClearanceJob& job, const Tool* tool) {
  require_length(job.shank_radius_mm, "--shank-radius");
  require_length(job.shank_length_mm, "--shank-length");
  if (job.shank_radius_mm && !job.shank_length_mm)
    throw UsageError("--shank-radius needs --shank-length: how far the shank reaches above the flank, mm");
  if (job.required_mm && !(*job.required_mm >= 0.0 && std::isfinite(*job.required_mm)))
    throw UsageError(fmt::format("--clearance {}: a length >= 0 mm is needed", *job.required_mm));
  if (job.holder) (void)holder_profile(*job.holder);
  const bool has_body = tool != nullptr && (!tool->shank.empty() || !tool->holder.empty());
  if (job.required_mm && !job.shank_length_mm && !job.holder && job.fixtures.empty() && !has_body)
    throw UsageError(
        "--clearance: of what? --shank-length, --holder or --fixture is needed, or a tool that has a shank");
  for (const std::string& file : job.fixtures)
    if (!is_there(file))
      throw InputError(file + ": no such fixture file; STEP, IGES, BREP, STL, OBJ and PLY are accepted");
}

void equip_tool(const ClearanceJob& job, Tool& tool) {
  const Vec2 top = meridian_point(tool.radial, tool.radial.axis_length());
  if (job.shank_length_mm) {
    const double radius = job.shank_radius_mm.value_or(top.y());
    tool.shank = lifted({{0.0, radius}, {*job.shank_length_mm, radius}}, top.x());
  }
  if (job.holder) tool.holder = lifted(holder_profile(*job.holder), top.x());
}

ClearanceReport measure_clearance(const ClearanceJob& job, const Tool& tool, const Path& path, const Part& part,
                                  const std::vector<int>& target_faces, const std::vector<int>& check_faces,
                                  const std::optional<std::string>& unit, double tolerance_mm,
                                  std::vector<std::string>& notes) {
  if (tool.shank.empty() && tool.holder.empty() && job.fixtures.empty()) return {};
  const double deviation = std::clamp(kToleranceBudget.shank.judge_triangles * tolerance_mm, kFinestMm, kCoarsestMm);
  std::vector<Obstacle> obstacles;
  if (!tool.shank.empty() || !tool.holder.empty())
    add_obstacles(part, ObstacleRole::kPart, target_faces, check_faces, deviation, obstacles, notes);
  for (const std::string& file : job.fixtures) {
    const Part fixture = read_part(file, is_mesh_file(file) ? unit : std::nullopt);
    for (const std::string& repair : fixture.repairs) notes.push_back(file + ": " + repair);
    add_obstacles(fixture, ObstacleRole::kFixture, {}, {}, deviation, obstacles, notes);
  }
  ClearanceOptions options;
  options.tolerance_mm = tolerance_mm;
  options.required_mm = job.required_mm.value_or(-1.0);
  return judge_clearance(tool, path, obstacles, options);
}

std::string clearance_text(const ClearanceReport& report) {
  std::string text;
  for (const ClearanceFigure& f : report.figures) {
    const bool enters = f.clearance_mm < 0.0;
    const std::string size = enters ? fmt::format("enters {} by {:.4f} mm", role_words(f.role), -f.clearance_mm)
                                    : fmt::format("keeps {:.4f} mm from {}", f.clearance_mm, role_words(f.role));
    text += fmt::format(
        "  {:<11} {}, true to {:.4f} mm: {} at ({:.3f}, {:.3f}, {:.3f}), strip {}, pose {:.2f}, z {:.2f}{}\n",
        body_name(f.body), size, f.bound_mm, f.obstacle, f.point.x(), f.point.y(), f.point.z(), f.strip + 1, f.t,
        f.z_mm,
        f.kept   ? ""
        : enters ? "  COLLISION"
                 : "  TOO NEAR");
  }
  return text;
}

}  // namespace flank::internal
