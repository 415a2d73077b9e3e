#include "flank/verify/clearance/revolved.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "flank/base/assert.h"

namespace flank::internal::verify {
namespace {

/// Slopes that grow by no more than this count as equal: rounding of a straight profile must not cut it into pieces.
constexpr double kStraight = 1e-12;

bool turns_outwards(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 p = b - a, q = c - b;
  return p.x() * q.y() - p.y() * q.x() > kStraight * p.norm() * q.norm();
}

}  // namespace

Revolved::Revolved(std::vector<Vec2> corners, double rounding) : corners_(std::move(corners)), rounding_(rounding) {
  FLANK_ASSERT(!corners_.empty() && rounding >= 0.0);
  std::vector<Vec2> outline{Vec2(corners_.front().x(), 0.0)};
  outline.insert(outline.end(), corners_.begin(), corners_.end());
  outline.emplace_back(corners_.back().x(), 0.0);
  for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
    const Vec2 step = outline[i + 1] - outline[i];
    const double length = step.norm();
    if (length > 0.0) sides_.push_back({outline[i], step / length, Vec2(-step.y(), step.x()) / length, length});
  }
}

// Inside a convex body the distance to the surface is that to the nearest side's line, so the largest over the sides;
// outside it is that to the nearest point of a side.
double Revolved::value(double z, double rho) const { return distance(z, rho).value; }

double Revolved::floor(double z, double rho) const {
  if (sides_.empty()) return value(z, rho);
  double farthest = -1e300;
  for (const Side& side : sides_)
    farthest = std::max(farthest, side.normal.x() * (z - side.from.x()) + side.normal.y() * (rho - side.from.y()));
  return farthest - rounding_;
}

ProfileDistance Revolved::distance(double z, double rho) const {
  const Side* facing = nullptr;
  double farthest = -1e300;
  for (const Side& side : sides_) {
    const double out = side.normal.x() * (z - side.from.x()) + side.normal.y() * (rho - side.from.y());
    if (out > farthest) farthest = out, facing = &side;
  }
  if (facing != nullptr && farthest <= 0.0) return {farthest - rounding_, facing->normal.x(), facing->normal.y(), 0.0};
  // Outside: the nearest point of all sides, or of the only corner.
  double least = 1e300;
  ProfileDistance found;
  if (facing == nullptr) {
    found = {0.0, z - corners_.front().x(), rho, 1.0};
    least = found.dz * found.dz + rho * rho;
  }
  for (const Side& side : sides_) {
    const double dz = z - side.from.x(), dr = rho - side.from.y();
    const double t = std::clamp(side.along.x() * dz + side.along.y() * dr, 0.0, side.length);
    const double ez = dz - t * side.along.x(), er = dr - t * side.along.y();
    const double squared = ez * ez + er * er;
    if (squared >= least) continue;
    least = squared;
    found = {0.0, ez, er, t > 0.0 && t < side.length ? 0.0 : 1.0};
  }
  const double distance = std::sqrt(least);
  found.value = distance - rounding_;
  if (!(distance > 0.0)) return {found.value, 0.0, 1.0, 0.0};  // the centre of a ball: any direction is a subgradient
  found.dz /= distance;
  found.drho /= distance;
  found.corner /= distance;
  return found;
}

std::array<Vec2, 2> Revolved::facing(double z, double rho) const {
  const ProfileDistance at = distance(z, rho);
  std::array<Vec2, 2> normals{Vec2(at.dz, at.drho), Vec2(at.dz, at.drho)};
  std::array<double, 2> most{-1e300, -1e300};
  if (sides_.size() < 2) return normals;
  for (const Side& side : sides_) {
    const double out = side.normal.x() * (z - side.from.x()) + side.normal.y() * (rho - side.from.y());
    const bool first = out > most[0];
    if (!first && !(out > most[1])) continue;
    if (first) most[1] = most[0], normals[1] = normals[0];
    most[first ? 0 : 1] = out;
    normals[first ? 0 : 1] = side.normal;
  }
  return normals;
}

const Vec2& Revolved::support(double along, double across) const {
  const Vec2* best = &corners_.front();
  double most = -1e300;
  for (const Vec2& c : corners_) {
    const double value = c.x() * along + c.y() * across;
    if (value > most) most = value, best = &c;
  }
  return *best;
}

// A profile is cut where it turns outwards: a convex chain turned about the axis is a convex body, and the union of all
// of them is the solid, as neighbours share the disc at which they were cut.
std::vector<Revolved> convex_bodies(const std::vector<Vec2>& profile) {
  std::vector<Revolved> bodies;
  std::vector<Vec2> chain;
  const auto finish = [&] {
    if (!chain.empty()) bodies.emplace_back(std::move(chain));
    chain = {};
  };
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const Vec2 &a = profile[i], &b = profile[i + 1];
    if (!(b.x() > a.x())) {
      // A step of the radius at one z: the bodies on its two sides bound it.
      finish();
      continue;
    }
    if (chain.size() >= 2 && turns_outwards(chain[chain.size() - 2], chain.back(), b)) finish();
    if (chain.empty()) chain.push_back(a);
    chain.push_back(b);
  }
  finish();
  if (!bodies.empty() || profile.size() < 2) return bodies;
  // All of the profile at one z: a disc.
  double radius = 0.0;
  for (const Vec2& p : profile) radius = std::max(radius, p.y());
  bodies.emplace_back(std::vector<Vec2>{Vec2(profile.front().x(), radius)});
  return bodies;
}

}  // namespace flank::internal::verify
