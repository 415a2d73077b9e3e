// How much of the search space (footpoint, s) do real admissible directions leave, and how much the tolerance-aware
// filter (paper B, figure 6; docs/algorithms/directions.md)? The rival is the paper's test for real roots. With an
// argument, also draws docs/images/directions.svg into that file.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "flank/example.h"
#include "flank/seed/direction/direction_filter.h"

namespace {

using namespace flank;
using namespace flank::internal;

constexpr double kLength = 30.0, kRadius = 5.0, kFootpoints = 2000.0;
constexpr int kSpheres = 30;

struct NamedTool {
  std::string name;
  RadialFunction radial;
};

RadialFunction barrel(double arc) {
  return {ToolFamily::kBarrel, kLength, Eigen::Vector3d(arc, kRadius, 0.5 * kLength)};
}

std::vector<NamedTool> tools() {
  return {{"cylinder", {ToolFamily::kCylinder, kLength, Eigen::VectorXd::Constant(1, kRadius)}},
          {"cone", {ToolFamily::kCone, kLength, Eigen::Vector2d(4.0, 0.07)}},
          {"barrel 85", barrel(85.0)},
          {"barrel 250", barrel(250.0)},
          {"concave 250", barrel(-250.0)}};
}

void count_row(const std::string& side, const std::vector<Footpoint>& feet, const NamedTool& tool, double tolerance) {
  DirectionFilterOptions options;
  options.tolerance_mm = tolerance;
  const auto start = std::chrono::steady_clock::now();
  const SearchSpace space = count_search_space(feet, tool.radial, kSpheres, options);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  std::printf("%-18s %-12s tolerance %-5g no real root %5.1f %%  removed %5.1f %%  %3.0f ns a pair\n", side.c_str(),
              tool.name.c_str(), tolerance, 100.0 * space.removed_by_real_roots(), 100.0 * space.removed_by_filter(),
              1e9 * time.count() / static_cast<double>(space.pairs));
}

void count_side(const std::string& side) {
  const std::unique_ptr<Target> target = make_target(make_example(side).faces);
  std::vector<Footpoint> feet;
  for (const SurfaceSample& sample : target->samples(std::sqrt(target->area() / kFootpoints))) {
    const Footpoint foot = target->closest(sample.point);
    if (foot.location == Location::kInside) feet.push_back(foot);
  }
  for (const NamedTool& tool : tools())
    for (const double tolerance : {0.05, 0.01}) count_row(side, feet, tool, tolerance);
}

/// One panel: the parameter square of the deformed envelope, coloured by what becomes of the middle sphere's pair.
void draw_panel(std::ofstream& svg, const Target& target, const Face& face, const NamedTool& tool, int left) {
  constexpr int kCells = 60, kSize = 4;
  const char* const colours[] = {"#2a6f97", "#a9d6e5", "#e5e5e5"};  // by Candidate
  const DirectionFilterOptions options{0.05, kLength, 3.0};
  const BSplineSurface& s = face.surface;
  const auto colour = [&](int i, int j) {
    const double u = s.u_first() + (i + 0.5) / kCells * (s.u_last() - s.u_first());
    const double v = s.v_first() + (j + 0.5) / kCells * (s.v_last() - s.v_first());
    const Footpoint foot = target.closest(s.value(u, v));
    return static_cast<int>(candidate_directions(foot, tool.radial.at(0.5 * kLength), options).candidate);
  };
  svg << "<text x='" << left << "' y='14'>" << tool.name << "</text>\n";
  for (int j = 0; j < kCells; ++j) {
    for (int i = 0, end = 0; i < kCells; i = end) {
      const int c = colour(i, j);
      for (end = i + 1; end < kCells && colour(end, j) == c;) ++end;
      svg << "<rect x='" << left + kSize * i << "' y='" << 20 + kSize * (kCells - 1 - j) << "' width='"
          << kSize * (end - i) << "' height='" << kSize << "' fill='" << colours[c] << "'/>\n";
    }
  }
}

void draw(const std::string& file) {
  const std::vector<Face> faces = make_example("deformed-envelope").faces;
  const std::unique_ptr<Target> target = make_target(faces);
  std::ofstream svg(file);
  svg << "<svg xmlns='http://www.w3.org/2000/svg' width='780' height='290' font-family='sans-serif' font-size='13' "
         "shape-rendering='crispEdges'>\n<rect width='780' height='290' fill='white'/>\n";
  const std::vector<NamedTool> all = tools();
  int left = 10;
  for (const std::size_t k : {0U, 2U, 3U}) {
    draw_panel(svg, *target, faces.front(), all[k], left);
    left += 260;
  }
  svg << "<text x='10' y='280'>dark: real directions; light: kept by the filter at 0.05 mm; grey: "
         "removed</text>\n</svg>\n";
}

}  // namespace

int main(int argc, char** argv) {
  for (const char* side : {"elliptic-side", "twisted-blade", "ruled-blade", "deformed-envelope"}) count_side(side);
  if (argc > 1) draw(argv[1]);
  return 0;
}
