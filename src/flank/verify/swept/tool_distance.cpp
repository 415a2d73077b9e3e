#include "flank/verify/swept/tool_distance.h"

#include <cmath>

namespace flank::internal::verify {
namespace {

constexpr double kPolishedMm = 1e-6;     ///< last step of s; what is left of the value is its square
constexpr double kSingleMinimum = 0.95;  ///< of rho times the focal curvature: up to here there is one minimum only
/// Steps of Newton's method for s, least q = 1 - r'^2, and least slope: with less the root is nearly double, and steps
/// run away. Whoever fails any of these is searched for without the grid.
constexpr int kMostSteps = 16;
constexpr double kLeastQ = 1e-6, kLeastSlope = 0.02;
/// Of a step of the radial table: where golden section stops and Newton's method goes on.
constexpr double kNarrowed = 1e-3;
/// The corners of a cell agree on one minimum if their s differ by less than so many steps of the grid, and this share
/// of L.
constexpr double kAgreedSteps = 4.0, kAgreedShare = 0.05;

}  // namespace

double ToolDistance::value(double z, double rho, double s) const {
  return std::sqrt((z - s) * (z - s) + rho * rho) - radial_.at(s).r;
}

// A stationary s solves (s - z)/D = r', that is s - z - rho r'/sqrt(1 - r'^2) = 0. This form has no pole at D = 0 and
// its slope 1 - rho r''/(1 - r'^2)^(3/2) is positive exactly at minima.
bool ToolDistance::polish(double z, double rho, double& s) const {
  for (int i = 0; i < kMostSteps; ++i) {
    const RadialJet j = radial_.at(s);
    const double q = 1.0 - j.d1 * j.d1;
    if (q < kLeastQ) return false;
    const double w = 1.0 / std::sqrt(q);
    const double residual = s - z - rho * j.d1 * w;
    const double slope = 1.0 - rho * j.d2 * w * w * w;
    if (slope < kLeastSlope) return false;
    const double next = std::clamp(s - residual / slope, 0.0, radial_.length());
    const double step = std::abs(next - s);
    s = next;
    if (step < kPolishedMm) return true;
  }
  return false;
}

// The least value near a node of the radial table: golden section between its neighbours, then the stationary point.
NearestSphere ToolDistance::narrow(double z, double rho, int node) const {
  constexpr double kGolden = 0.6180339887498949;
  double a = radial_.node(std::max(0, node - 1)), b = radial_.node(std::min(radial_.count(), node + 1));
  double c = b - kGolden * (b - a), d = a + kGolden * (b - a);
  double vc = value(z, rho, c), vd = value(z, rho, d);
  while (b - a > kNarrowed * radial_.step()) {
    if (vc < vd) {
      b = d, d = c, vd = vc, c = b - kGolden * (b - a), vc = value(z, rho, c);
    } else {
      a = c, c = d, vc = vd, d = a + kGolden * (b - a), vd = value(z, rho, d);
    }
  }
  NearestSphere found{value(z, rho, 0.5 * (a + b)), 0.5 * (a + b), false};
  const double at_node = value(z, rho, radial_.node(node));
  if (at_node < found.g) found = {at_node, radial_.node(node), false};
  double polished = found.s;
  if (polish(z, rho, polished) && value(z, rho, polished) <= found.g)
    found = {value(z, rho, polished), polished, false};
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
  if (const Grid* grid = grid_around(z, rho)) {
    double fz = 0.0, fr = 0.0;
    const Node* lower = grid->cell(z, rho, fz, fr);
    const Node* upper = lower + grid->columns;
    const auto [low, high] = std::minmax({lower[0].s, lower[1].s, upper[0].s, upper[1].s});
    // With several minima the grid is trusted only where all corners of the cell agree on one.
    const double agreed = std::min(kAgreedSteps * (grid->z_step + grid->rho_step), kAgreedShare * radial_.length());
    if (single || high - low < agreed) {
      double s = single ? grid->interpolate(z, rho).s : 0.5 * (static_cast<double>(low) + high);
      if (polish(z, rho, s)) return {value(z, rho, s), s, false};
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
