#include "flank/verify/stock/dexel_stock.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flank/base/parallel.h"
#include "flank/error.h"
#include "flank/verify/stock/mesh_lines.h"
#include "flank/verify/stock/row_cut.h"

namespace flank::internal::verify {
namespace {

constexpr double kMostLines = 1e9;
/// Of all lines: through cracks of a mesh that is closed.
constexpr double kMostOpen = 0.01;

/// The nearest end of a line's material: where it is, and whether material lies above it.
struct LineEnd {
  double place = 0.0;
  bool lower = true, found = false, inside = false;
};

LineEnd nearest_end(const DexelField& field, int row, int line, double x) {
  LineEnd out;
  double best = std::numeric_limits<double>::infinity();
  if (row < 0 || row >= field.rows() || line < 0 || line >= field.width()) return out;
  field.visit(row, line, [&](const DexelSpan& span) {
    out.inside = out.inside || (span.low <= x && x <= span.high);
    for (const bool lower : {true, false}) {
      const double place = lower ? span.low : span.high, off = std::abs(x - place);
      if (off >= best) continue;
      best = off;
      out.place = place;
      out.lower = lower;
      out.found = true;
    }
  });
  return out;
}

/// Rounded down, without a call.
int floor_of(double x) {
  const int whole = static_cast<int>(x);
  return whole > x ? whole - 1 : whole;
}

/// What the line says of a place; mixed within `margin` of an end of its material, mm.
Sight sight_of(const DexelField& field, int row, int line, double place, double margin) {
  if (row < 0 || row >= field.rows() || line < 0 || line >= field.width()) return Sight::kOut;
  const auto seen = [&](double low, double high) {
    if (place < low - margin || place > high + margin) return Sight::kOut;
    return low + margin < place && place < high - margin ? Sight::kIn : Sight::kMixed;
  };
  const Sight all = seen(field.lows(row)[line], field.highs(row)[line]);
  if (all == Sight::kOut || field.is_whole(row, line)) return all;
  if (field.gap_lows(row)[line] + margin < place && place < field.gap_highs(row)[line] - margin) return Sight::kOut;
  Sight out = Sight::kOut;
  field.visit(row, line, [&](const DexelSpan& span) {
    if (const Sight here = seen(span.low, span.high); here != Sight::kOut) out = here;
  });
  return out;
}

/// What the four lines around a point say of it; mixed where they differ, and within `margin` of an end of one, mm.
Sight sight_along(const DexelField& field, const Vec3& x, double margin) {
  const int line = floor_of(field.line_at(x[field.across()])), row = floor_of(field.row_at(x[field.up()]));
  const double place = x[field.axis()];
  const Sight first = sight_of(field, row, line, place, margin);
  if (first == Sight::kMixed) return first;
  for (int k = 1; k < 4; ++k)
    if (sight_of(field, row + k / 2, line + k % 2, place, margin) != first) return Sight::kMixed;
  return first;
}

int most_along(const Vec3& direction) {
  const double x = std::abs(direction.x()), y = std::abs(direction.y()), z = std::abs(direction.z());
  return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}

/// Takes away what is beyond the planes.
void cut_by_planes(DexelField& field, const std::vector<HalfSpace>& planes, int row, int line) {
  constexpr double kFar = 1e30;
  Vec3 x = Vec3::Zero();
  x[field.up()] = field.place_up(row);
  x[field.across()] = field.place_across(line);
  for (const HalfSpace& plane : planes) {
    const double along = plane.normal[field.axis()], room = plane.offset - plane.normal.dot(x);
    if (std::abs(along) < 1e-12) {
      if (room < 0.0) field.subtract(row, line, -kFar, kFar);
    } else if (along > 0.0) {
      field.subtract(row, line, room / along, kFar);
    } else {
      field.subtract(row, line, -kFar, room / along);
    }
  }
}

}  // namespace

DexelStock::Surface DexelStock::surface_along(const DexelField& field, const Vec3& x, double cell) {
  /// Steeper than this many cells a cell, another direction sees the surface better.
  constexpr double kSteepest = 2.5;
  const double line = field.line_at(x[field.across()]), row = field.row_at(x[field.up()]);
  const int i = static_cast<int>(std::floor(line)), j = static_cast<int>(std::floor(row));
  const double fi = line - i, fj = row - j, place = x[field.axis()];
  std::array<LineEnd, 4> ends;
  Surface out;
  for (int k = 0; k < 4; ++k) {
    LineEnd& end = ends[static_cast<std::size_t>(k)];
    end = nearest_end(field, j + k / 2, i + k % 2, place);
    out.any = out.any || end.found;
  }
  out.inside = ends[static_cast<std::size_t>((fj > 0.5 ? 2 : 0) + (fi > 0.5 ? 1 : 0))].inside;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const LineEnd& end : ends) {
    if (!end.found || end.lower != ends[0].lower) return out;
    low = std::min(low, end.place);
    high = std::max(high, end.place);
  }
  if (high - low > kSteepest * cell) return out;
  const double a = std::lerp(ends[0].place, ends[1].place, fi), b = std::lerp(ends[2].place, ends[3].place, fi);
  const double across = std::lerp(ends[1].place - ends[0].place, ends[3].place - ends[2].place, fj) / cell;
  const double up = (b - a) / cell;
  const double along = (place - std::lerp(a, b, fj)) * (ends[0].lower ? 1.0 : -1.0);
  out.distance = along / std::sqrt(1.0 + across * across + up * up);
  out.found = true;
  return out;
}

DexelStock::DexelStock(const Box3& box, const std::vector<HalfSpace>& planes, double cell_mm)
    : box_(box), cell_(cell_mm) {
  if (!(cell_mm > 0.0)) throw UsageError("cell_mm", "expected a length > 0 mm");
  const Vec3 size = box.high - box.low;
  if (!(size.minCoeff() > 0.0)) throw InputError("the box of the stock is empty");
  const double lines = (size.x() * size.y() + size.y() * size.z() + size.z() * size.x()) / (cell_ * cell_);
  if (!(lines < kMostLines)) throw InputError("the stock has too many cells: take larger ones");
  for (int axis = 0; axis < 3; ++axis) {
    DexelField& field = fields_.emplace_back(axis, box_, cell_);
    weights_.emplace_back(field, box_, planes, cell_);
    parallel_for(static_cast<std::size_t>(field.rows()), [&](std::size_t row) {
      for (int line = 0; line < field.width(); ++line) cut_by_planes(field, planes, static_cast<int>(row), line);
    });
  }
}

DexelStock::DexelStock(const TriangleMesh& body, const Box3& box, double cell_mm)
    : DexelStock(box, std::vector<HalfSpace>(), cell_mm) {
  for (DexelField& field : fields_) {
    const std::size_t open = keep_inside(field, body);
    if (static_cast<double>(open) > kMostOpen * field.rows() * field.width())
      throw InputError("the blank is not closed; expected a body all round");
  }
}

double DexelStock::cut(const ToolSolid& tool, const Pose& pose) {
  double sum = 0.0;
  for (std::size_t axis = 0; axis < fields_.size(); ++axis) sum += cut_field(axis, tool, pose);
  return sum / 3.0;
}

double DexelStock::cut_field(std::size_t axis, const ToolSolid& tool, const Pose& pose) {
  DexelField& field = fields_[axis];
  const int c = field.up();
  const double radius = tool.largest(), low = pose.at(tool.low())[c], high = pose.at(tool.high())[c];
  const int first = std::max(0, clipped(std::ceil(field.row_at(std::min(low, high) - radius)), field.rows()));
  const int last =
      std::min(field.rows() - 1, clipped(std::floor(field.row_at(std::max(low, high) + radius)), field.rows()));
  if (first > last) return 0.0;
  std::vector<double> removed(static_cast<std::size_t>(last - first + 1), 0.0);
  constexpr std::size_t kRows = 32;
  parallel_blocks(removed.size(), kRows, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      removed[k] = cut_row(field, weights_[axis], tool, pose, first + static_cast<int>(k));
  });
  double sum = 0.0;
  for (const double length : removed) sum += length;
  return sum * cell_ * cell_;
}

std::array<double, 3> DexelStock::volumes() const {
  std::array<double, 3> out{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const DexelField& field = fields_[axis];
    for (int row = 0; row < field.rows(); ++row) {
      double length = 0.0;  // row by row: sums stay short
      for (int line = 0; line < field.width(); ++line)
        field.visit(row, line, [&](const DexelSpan& span) {
          const double low = span.low, high = span.high;
          length += (high - low) * weights_[axis].between(field, row, line, low, high);
        });
      out[axis] += length;
    }
    out[axis] *= cell_ * cell_;
  }
  return out;
}

double DexelStock::volume() const {
  const std::array<double, 3> all = volumes();
  return (all[0] + all[1] + all[2]) / 3.0;
}

std::optional<double> DexelStock::distance(const Vec3& x) const {
  Surface best;
  for (const DexelField& field : fields_) {
    const Surface surface = surface_along(field, x, cell_);
    if (surface.found && std::abs(surface.distance) < std::abs(best.distance)) best = surface;
  }
  return best.found ? std::optional(best.distance) : std::nullopt;
}

double DexelStock::depth(const Vec3& x) const { return depth(x, nullptr, {}); }

double DexelStock::depth(const Vec3& x, const DexelField* known, const Surface& of_known) const {
  Surface best;
  int inside = 0;
  bool any = false;
  for (const DexelField& field : fields_) {
    const Surface surface = &field == known ? of_known : surface_along(field, x, cell_);
    inside += surface.inside ? 1 : -1;
    any = any || surface.any;
    if (surface.found && std::abs(surface.distance) < std::abs(best.distance)) best = surface;
  }
  if (best.found) return best.distance;
  if (!any) return -std::numeric_limits<double>::infinity();
  return inside > 0 ? 0.5 * cell_ : -0.5 * cell_;
}

// Lines across a layer see it however thin it is: they are believed where none of them ends near, and where the ends of all
// four make a surface.
bool DexelStock::holds(const Vec3& x, const Vec3& across) const {
  const DexelField& first = field(most_along(across));
  return holds_by(first, x, sight_along(first, x, cell_));
}

bool DexelStock::holds(const Vec3& x, const Vec3& across, std::vector<EmptyBlocks>& known) const {
  const DexelField& first = field(most_along(across));
  EmptyBlocks& blocks = known[static_cast<std::size_t>(first.axis())];
  const std::optional<std::size_t> block = blocks.block_at(x);
  if (block && blocks.is_empty(*block)) return false;
  const Sight sight = sight_along(first, x, cell_);
  if (block && sight == Sight::kOut) blocks.add(first, *block, cell_);
  return holds_by(first, x, sight);
}

bool DexelStock::holds_by(const DexelField& first, const Vec3& x, Sight sight) const {
  if (sight != Sight::kMixed) return sight == Sight::kIn;
  const Surface surface = surface_along(first, x, cell_);
  return surface.found ? surface.distance > 0.0 : depth(x, &first, surface) > 0.0;
}

}  // namespace flank::internal::verify
