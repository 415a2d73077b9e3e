#include "flank/verify/stock/mesh_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "flank/base/parallel.h"

namespace flank::internal::verify {
namespace {

constexpr double kFar = 1e30;
/// Of a cell: lines are taken so far beside their place, so that they do not run along edges and through corners of bodies that lie as the
/// grid does.
constexpr double kAsideAcross = 1.37e-6, kAsideUp = 0.71e-6;

/// Where a line meets a triangle, and whether it goes in there (+1) or out (-1).
struct Crossing {
  double place = 0.0;
  int turn = 0;
};

/// A triangle as the lines of a field see it: across, up and along them.
using Seen = std::array<Vec3, 3>;

Seen seen_along(const DexelField& field, const TriangleMesh& mesh, const std::array<int, 3>& triangle) {
  Seen out;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& p = mesh.vertices[static_cast<std::size_t>(triangle[k])];
    out[k] = {p[field.across()], p[field.up()], p[field.axis()]};
  }
  return out;
}

/// On which side of an edge a place lies: the same numbers from both of its triangles, so that no line slips through between them.
double side(const Vec3& from, const Vec3& to, double across, double up) {
  const bool swapped = std::make_pair(to.x(), to.y()) < std::make_pair(from.x(), from.y());
  const Vec3 &a = swapped ? to : from, &b = swapped ? from : to;
  const double area = (b.x() - a.x()) * (up - a.y()) - (b.y() - a.y()) * (across - a.x());
  return swapped ? -area : area;
}

/// Rows that a triangle reaches.
std::pair<int, int> rows_of(const DexelField& field, const Seen& t) {
  const auto [low, high] = std::minmax({t[0].y(), t[1].y(), t[2].y()});
  return {std::max(0, static_cast<int>(std::floor(field.row_at(low)))),
          std::min(field.rows() - 1, static_cast<int>(std::ceil(field.row_at(high))))};
}

void cross(const DexelField& field, const Seen& t, int row, std::vector<std::vector<Crossing>>& lines) {
  const auto [low, high] = std::minmax({t[0].x(), t[1].x(), t[2].x()});
  const int first = std::max(0, static_cast<int>(std::floor(field.line_at(low)))),
            last = std::min(field.width() - 1, static_cast<int>(std::ceil(field.line_at(high))));
  const double up = field.place_up(row) + kAsideUp * field.cell();
  for (int line = first; line <= last; ++line) {
    const double across = field.place_across(line) + kAsideAcross * field.cell();
    const double a = side(t[1], t[2], across, up), b = side(t[2], t[0], across, up), c = side(t[0], t[1], across, up);
    if (!((a > 0.0 && b > 0.0 && c > 0.0) || (a < 0.0 && b < 0.0 && c < 0.0))) continue;
    const double place = (a * t[0].z() + b * t[1].z() + c * t[2].z()) / (a + b + c);
    // Counter-clockwise as the line comes towards it: its normal looks along the line, which goes out.
    lines[static_cast<std::size_t>(line)].push_back({place, a > 0.0 ? -1 : 1});
  }
}

/// Whether the line found its way out.
bool keep_inside(DexelField& field, int row, int line, std::vector<Crossing>& crossings) {
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    return a.place != b.place ? a.place < b.place : a.turn < b.turn;
  });
  int turns = 0;
  for (const Crossing& crossing : crossings) turns += crossing.turn;
  double from = -kFar;
  if (turns != 0) {
    field.subtract(row, line, from, crossings.front().place);
    field.subtract(row, line, crossings.back().place, kFar);
    return false;
  }
  for (const Crossing& crossing : crossings) {
    if (turns == 0) field.subtract(row, line, from, crossing.place);
    turns += crossing.turn;
    from = crossing.place;
  }
  field.subtract(row, line, from, kFar);
  return true;
}

}  // namespace

std::size_t keep_inside(DexelField& field, const TriangleMesh& mesh) {
  std::vector<Seen> triangles;
  std::vector<std::vector<std::size_t>> reached(static_cast<std::size_t>(field.rows()));
  for (const auto& triangle : mesh.triangles) {
    triangles.push_back(seen_along(field, mesh, triangle));
    const auto [first, last] = rows_of(field, triangles.back());
    for (int row = first; row <= last; ++row) reached[static_cast<std::size_t>(row)].push_back(triangles.size() - 1);
  }
  std::vector<std::size_t> open(reached.size(), 0);
  parallel_for(reached.size(), [&](std::size_t row) {
    std::vector<std::vector<Crossing>> lines(static_cast<std::size_t>(field.width()));
    for (const std::size_t k : reached[row]) cross(field, triangles[k], static_cast<int>(row), lines);
    for (int line = 0; line < field.width(); ++line)
      if (!keep_inside(field, static_cast<int>(row), line, lines[static_cast<std::size_t>(line)])) ++open[row];
  });
  std::size_t all = 0;
  for (const std::size_t count : open) all += count;
  return all;
}

}  // namespace flank::internal::verify
