#include "flank/verify/swept/tool_distance.h"

#include <cmath>

#include "flank/verify/swept/sphere_distance.h"

namespace flank::internal::verify {
namespace {

constexpr double kSingleMinimum = 0.95;  ///< of rho times the focal curvature: up to here there is one minimum only
constexpr double kLeastQ = 1e-9;         ///< of 1 - r'^2: a radial function that is no tool must not divide by zero
/// Of a step of the radial table: where golden section stops and Newton's method goes on.
constexpr double kNarrowed = 1e-3;
/// The corners of a cell agree on one minimum if their s differ by less than so many steps of the grid, and this share
/// of L.
constexpr double kAgreedSteps = 4.0, kAgreedShare = 0.05;

double largest_focal_curvature(const RadialTable& radial) {
  double largest = 0.0;
  for (int i = 0; i <= 4 * radial.count(); ++i) {
    const RadialJet j = radial.at(0.25 * i * radial.step());
    const double q = std::max(kLeastQ, 1.0 - j.d1 * j.d1);
    largest = std::max(largest, j.d2 / (q * std::sqrt(q)));
  }
  return largest;
}

}  // namespace

ToolDistance::ToolDistance(const RadialFunction& radial)
    : radial_(radial), focal_curvature_(largest_focal_curvature(radial_)), grids_(tool_grids(radial_)) {}

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
  NearestSphere found{sphere_distance(radial_, z, rho, 0.5 * (a + b)), 0.5 * (a + b), false};
  const double at_node = sphere_distance(radial_, z, rho, radial_.node(node));
  if (at_node < found.g) found = {at_node, radial_.node(node), false};
  double polished = found.s;
  if (polish_sphere(radial_, z, rho, polished) && sphere_distance(radial_, z, rho, polished) <= found.g)
    found = {sphere_distance(radial_, z, rho, polished), polished, false};
  return found;
}

// Between nodes the value can fall below the lower of the two by at most one step (its slope is at most 2): every local
// minimum of the node values within that margin is followed up.
NearestSphere ToolDistance::search(double z, double rho) const {
  const auto at_node = [&](int i) {
    const double dz = z - radial_.node(i);
    return std::sqrt(dz * dz + rho * rho) - radial_.node_radius(i);
  };
  double least = at_node(0);
  for (int i = 1; i <= radial_.count(); ++i) least = std::min(least, at_node(i));
  NearestSphere best{1e300, 0.0, false};
  for (int i = 0; i <= radial_.count(); ++i) {
    const double here = at_node(i);
    // Ties count as minima on both sides: better one search too many than a minimum missed.
    if (here > least + radial_.step()) continue;
    if (i > 0 && at_node(i - 1) < here) continue;
    if (i < radial_.count() && at_node(i + 1) < here) continue;
    const NearestSphere found = narrow(z, rho, i);
    if (found.g < best.g) best = found;
  }
  return best;
}

int ToolDistance::minima(double z, double rho, double below, std::array<double, kMostMinima>& s) const {
  const double limit = below + radial_.step();
  // Only spheres whose centre is near enough can be below the limit.
  const double reach = limit + radial_.largest_radius();
  if (!(reach > rho)) return 0;
  const double window = std::min(std::sqrt(reach * reach - rho * rho), 1e3 * radial_.length() + std::abs(z));
  const auto node_at = [&](double x) {
    return static_cast<int>(std::clamp(x / radial_.step(), -2.0, radial_.count() + 2.0));
  };
  const int first = std::max(0, node_at(z - window) - 1), last = std::min(radial_.count(), node_at(z + window) + 1);
  const auto at_node = [&](int i) {
    const double dz = z - radial_.node(i);
    return std::sqrt(dz * dz + rho * rho) - radial_.node_radius(i);
  };
  int count = 0;
  double before = first > 0 ? at_node(first - 1) : 1e300, here = at_node(std::min(first, radial_.count()));
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
  const bool single = rho * focal_curvature_ < kSingleMinimum;
  if (const ToolGrid* grid = grid_around(z, rho)) {
    double fz = 0.0, fr = 0.0;
    const ToolGrid::Node* lower = grid->cell(z, rho, fz, fr);
    const ToolGrid::Node* upper = lower + grid->columns;
    const auto [low, high] = std::minmax({lower[0].s, lower[1].s, upper[0].s, upper[1].s});
    // With several minima the grid is trusted only where all corners of the cell agree on one.
    const double agreed = std::min(kAgreedSteps * (grid->z_step + grid->rho_step), kAgreedShare * radial_.length());
    if (single || high - low < agreed) {
      double s = single ? grid->interpolate(z, rho).s : 0.5 * (static_cast<double>(low) + high);
      if (polish_sphere(radial_, z, rho, s)) return {sphere_distance(radial_, z, rho, s), s, false};
    }
  }
  NearestSphere best = search(z, rho);
  best.contested = !single;
  return best;
}

Estimate ToolDistance::beyond_grids(double z, double rho) const {
  const double beyond = std::max({-z, z - radial_.length(), 0.0});
  return {std::sqrt(beyond * beyond + rho * rho) - radial_.largest_radius(), std::clamp(z, 0.0, radial_.length()),
          radial_.length(), true};
}

}  // namespace flank::internal::verify
