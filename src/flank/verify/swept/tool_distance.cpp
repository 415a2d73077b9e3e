#include "flank/verify/swept/tool_distance.h"

#include <cmath>

#include "flank/verify/swept/sphere_distance.h"

namespace flank::internal::verify {
namespace {

constexpr double kSingleMinimum = 0.95;  ///< of rho times the focal curvature: up to here there is one minimum only
constexpr double kFlat = 0.25;           ///< of rho times the focal curvature: less makes no difference to who asks
constexpr double kLeastQ = 1e-9;         ///< of 1 - r'^2: a radial function that is no tool must not divide by zero
/// Of a step of the radial table: where golden section stops and Newton's method goes on.
constexpr double kNarrowed = 1e-3;
/// The corners of a cell agree on one minimum if their s differ by less than so many steps of the grid, and this share
/// of L.
constexpr double kAgreedSteps = 4.0, kAgreedShare = 0.05;

/// The largest in each cell, of five places of it.
std::vector<double> focal_curvatures(const RadialTable& radial) {
  const auto at = [&](int quarter) {
    const RadialJet j = radial.at(0.25 * quarter * radial.step());
    const double q = std::max(kLeastQ, 1.0 - j.d1 * j.d1);
    return j.d2 / (q * std::sqrt(q));
  };
  std::vector<double> out(static_cast<std::size_t>(radial.count()), 0.0);
  for (int i = 0; i < radial.count(); ++i)
    for (int k = 0; k <= 4; ++k)
      out[static_cast<std::size_t>(i)] = std::max(out[static_cast<std::size_t>(i)], at(4 * i + k));
  return out;
}

/// No radius in the cell is larger: between two nodes r leaves theirs by at most half a cell of slope 1.
std::vector<double> largest_radii(const RadialTable& radial) {
  std::vector<double> out;
  for (int i = 0; i < radial.count(); ++i)
    out.push_back(std::max(radial.node_radius(i), radial.node_radius(i + 1)) + 0.5 * radial.step());
  return out;
}

/// The chord of r over [first, last], lifted until r is nowhere above it; `most` becomes what it is above r at most.
RadiusLine line_above(const RadialTable& radial, double first, double last, double& most) {
  constexpr int kPlaces = 8;  // of a cell of the table
  const double low = radial.radius(first), slope = (radial.radius(last) - low) / (last - first);
  const int count = std::max(2, static_cast<int>(std::ceil(kPlaces * (last - first) / radial.step())));
  double above = 0.0, below = 0.0;
  for (int k = 0; k <= count; ++k) {
    const double s = first + (last - first) * k / count, off = radial.radius(s) - low - slope * (s - first);
    above = std::max(above, off), below = std::max(below, -off);
  }
  // |r'| < 1: between two places, at most half a step from either.
  const double lift = above + 0.5 * (1.0 + std::abs(slope)) * (last - first) / count;
  most = lift + below;
  return {first, last, low - slope * first + lift, slope};
}

}  // namespace

std::vector<RadiusLine> radius_lines(const RadialTable& radial) {
  constexpr double kClose = 0.1;
  constexpr int kMost = 8;
  std::vector<RadiusLine> lines;
  for (int count = 1; count <= kMost; count *= 2) {
    double most = 0.0;
    lines.clear();
    for (int k = 0; k < count; ++k) {
      double here = 0.0;
      lines.push_back(line_above(radial, radial.length() * k / count, radial.length() * (k + 1) / count, here));
      most = std::max(most, here);
    }
    if (most <= kClose * radial.least_radius()) break;
  }
  return lines;
}

ToolDistance::ToolDistance(const RadialFunction& radial)
    : radial_(radial),
      lines_(radius_lines(radial_)),
      bends_(focal_curvatures(radial_)),
      radii_(largest_radii(radial_)),
      focal_curvature_(bends_.over_all()),
      grids_(tool_grids(radial_)) {}

// The least value near a node of the radial table: golden section between its neighbours, then the stationary point.
NearestSphere ToolDistance::narrow(double z, double rho, int node) const {
  constexpr double kGolden = 0.6180339887498949;
  double a = radial_.node(std::max(0, node - 1)), b = radial_.node(std::min(radial_.count(), node + 1));
  double c = b - kGolden * (b - a), d = a + kGolden * (b - a);
  double vc = sphere_distance(radial_, z, rho, c), vd = sphere_distance(radial_, z, rho, d);
  while (b - a > kNarrowed * radial_.step()) {
    if (vc < vd) {
      b = d, d = c, vd = vc, c = b - kGolden * (b - a), vc = sphere_distance(radial_, z, rho, c);
    } else {
      a = c, c = d, vc = vd, d = a + kGolden * (b - a), vd = sphere_distance(radial_, z, rho, d);
    }
  }
  NearestSphere found{sphere_distance(radial_, z, rho, 0.5 * (a + b)), 0.5 * (a + b)};
  const double at_node = sphere_distance(radial_, z, rho, radial_.node(node));
  if (at_node < found.g) found = {at_node, radial_.node(node)};
  double polished = found.s;
  if (polish_sphere(radial_, z, rho, polished) && sphere_distance(radial_, z, rho, polished) <= found.g)
    found = {sphere_distance(radial_, z, rho, polished), polished};
  return found;
}

// sqrt((z - s)^2 + rho^2) < below + r(s) bounds |z - s|.
ToolDistance::Cells ToolDistance::cells_below(double z, double rho, double below, double largest) const {
  const double reach = below + largest;
  if (!(reach > rho)) return {};
  const double window = std::min(std::sqrt(reach * reach - rho * rho), 1e3 * radial_.length() + std::abs(z));
  const auto cell_at = [&](double s) {
    return std::clamp(s * radial_.cells_per_mm(), -1.0, static_cast<double>(radial_.count()));
  };
  const int first = static_cast<int>(std::floor(cell_at(z - window))), last = static_cast<int>(cell_at(z + window));
  return {std::max(0, first), z + window < 0.0 ? -1 : std::min(radial_.count() - 1, last)};
}

ToolDistance::Cells ToolDistance::cells_nearer(double z, double rho, double below) const {
  const Cells wide = cells_below(z, rho, below, radial_.largest_radius());
  if (wide.first > wide.last) return wide;
  const auto first = static_cast<std::size_t>(wide.first), last = static_cast<std::size_t>(wide.last);
  return cells_below(z, rho, below, radii_.over(first, last));
}

// Between nodes the value can fall below the lower of the two by at most one step (its slope is at most 2): every local
// minimum of the node values within that margin is followed up.
NearestSphere ToolDistance::search(double z, double rho) const {
  /// Steps: the margin, and a little for what rounding does to the bound.
  constexpr double kMargin = 1.01;
  const auto at_node = [&](int i) {
    const double dz = z - radial_.node(i);
    return std::sqrt(dz * dz + rho * rho) - radial_.node_radius(i);
  };
  // The least value is at most that of the sphere beside the point: what cannot be that near need not be looked at.
  const double count = radial_.count();
  const double beside = at_node(static_cast<int>(std::clamp(z / radial_.step(), 0.0, count)));
  const Cells cells = cells_nearer(z, rho, beside + kMargin * radial_.step());
  const int first = cells.first, last = std::min(cells.last + 1, radial_.count());
  double least = beside;
  for (int i = first; i <= last; ++i) least = std::min(least, at_node(i));
  NearestSphere best{1e300, 0.0};
  double before = first > 0 ? at_node(first - 1) : 1e300, here = at_node(first);
  for (int i = first; i <= last; ++i) {
    const double after = i < radial_.count() ? at_node(i + 1) : 1e300;
    // Ties count as minima on both sides: better one search too many than a minimum missed.
    if (here <= least + radial_.step() && here <= before && here <= after) {
      const NearestSphere found = narrow(z, rho, i);
      if (found.g < best.g) best = found;
    }
    before = here;
    here = after;
  }
  return best;
}

double ToolDistance::focal_curvature(double z, double rho, double below) const {
  if (focal_curvature_ == 0.0) return 0.0;
  const auto over = [](const RangeMaximum& values, const Cells& cells) {
    return values.over(static_cast<std::size_t>(cells.first), static_cast<std::size_t>(cells.last));
  };
  Cells cells = cells_below(z, rho, below, radial_.largest_radius());
  if (cells.first > cells.last) return 0.0;
  const double wide = over(bends_, cells);
  if (rho * wide < kFlat) return wide;
  cells = cells_below(z, rho, below, over(radii_, cells));
  return cells.first > cells.last ? 0.0 : over(bends_, cells);
}

int ToolDistance::minima(double z, double rho, double below, std::array<double, kMostMinima>& s) const {
  const double limit = below + radial_.step();
  const Cells cells = cells_below(z, rho, limit, radial_.largest_radius());
  if (cells.first > cells.last) return 0;
  const int first = std::max(0, cells.first - 1), last = std::min(radial_.count(), cells.last + 2);
  const auto at_node = [&](int i) {
    const double dz = z - radial_.node(i);
    return std::sqrt(dz * dz + rho * rho) - radial_.node_radius(i);
  };
  int count = 0;
  double before = first > 0 ? at_node(first - 1) : 1e300, here = at_node(first);
  for (int i = first; i <= last; ++i) {
    const double after = i < radial_.count() ? at_node(i + 1) : 1e300;
    if (here <= before && here < after && here < limit && count < kMostMinima)
      s[static_cast<std::size_t>(count++)] = radial_.node(i);
    before = here;
    here = after;
  }
  return count;
}

NearestSphere ToolDistance::nearest(double z, double rho) const {
  const ToolGrid* grid = grid_around(z, rho);
  if (grid == nullptr) return search(z, rho);
  double s = grid->interpolate(z, rho).s;
  if (rho * focal_curvature_ >= kSingleMinimum) {
    // The nearest sphere is no farther than this one: if only one minimum is below it, Newton's method finds that.
    const double value = sphere_distance(radial_, z, rho, s);
    if (rho * focal_curvature(z, rho, value) >= kSingleMinimum) return nearest_of_several(*grid, z, rho);
    if (!polish_sphere(radial_, z, rho, s)) return search(z, rho);
    const double found = sphere_distance(radial_, z, rho, s);
    return found <= value ? NearestSphere{found, s} : search(z, rho);
  }
  if (polish_sphere(radial_, z, rho, s)) return {sphere_distance(radial_, z, rho, s), s};
  return search(z, rho);
}

// The grid is trusted only where all corners of the cell agree on one minimum.
NearestSphere ToolDistance::nearest_of_several(const ToolGrid& grid, double z, double rho) const {
  double fz = 0.0, fr = 0.0;
  const ToolGrid::Node* lower = grid.cell(z, rho, fz, fr);
  const ToolGrid::Node* upper = lower + grid.columns;
  const auto [low, high] = std::minmax({lower[0].s, lower[1].s, upper[0].s, upper[1].s});
  const double agreed = std::min(kAgreedSteps * (grid.z_step + grid.rho_step), kAgreedShare * radial_.length());
  double s = 0.5 * (static_cast<double>(low) + high);
  if (high - low < agreed && polish_sphere(radial_, z, rho, s)) return {sphere_distance(radial_, z, rho, s), s};
  return search(z, rho);
}

Estimate ToolDistance::beyond_grids(double z, double rho) const {
  const double beyond = std::max({-z, z - radial_.length(), 0.0});
  return {std::sqrt(beyond * beyond + rho * rho) - radial_.largest_radius(), std::clamp(z, 0.0, radial_.length()),
          radial_.length(), true, 0.0};
}

}  // namespace flank::internal::verify
