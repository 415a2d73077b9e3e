#include "flank/machine/cutting/cutting_force.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace flank::internal {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// Gauss-Legendre, five points on [-1, 1]: exact for polynomials up to the ninth degree.
constexpr std::array<double, 5> kNodes = {-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831,
                                          0.9061798459386640};
constexpr std::array<double, 5> kWeights = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                            0.4786286704993665, 0.2369268850561891};
constexpr double kJustInside = 1e-9;  ///< rad: an edge that leaves an arc has left it
constexpr double kArc = 0.25;         ///< rad of azimuth in one step of the quadrature

/// Integral over [low, high] in equal steps.
template <class Value, class Function>
Value integral(double low, double high, int steps, Value sum, const Function& at) {
  for (int k = 0; k < steps; ++k) {
    const double half = 0.5 * (high - low) / steps, middle = low + (2 * k + 1) * half;
    for (std::size_t i = 0; i < kNodes.size(); ++i) sum += (kWeights[i] * half) * at(middle + half * kNodes[i]);
  }
  return sum;
}

int steps_for(double angle) { return std::clamp(static_cast<int>(std::ceil(std::abs(angle) / kArc)), 1, 1000); }

/// Force and torque as one vector of four.
using Load = Eigen::Vector4d;

double radius_of(const CutterRing& ring, double z) {
  const double height = ring.high.x() - ring.low.x();
  return height > 0.0 ? ring.low.y() + (ring.high.y() - ring.low.y()) * (z - ring.low.x()) / height : ring.low.y();
}

/// What an edge at this azimuth feels for every mm of z.
Load load_per_z(const RotatingCutter& cutter, const CutterMotion& motion, const ForceCoefficients& k,
                const CutterRing& ring, double z, double azimuth) {
  const Vec2 along = (ring.high - ring.low).normalized();  // (cos, sin) of the meridian's slope
  const double edge = 1.0 / along.x();                     // mm of edge for every mm of z
  const double c = std::cos(azimuth), s = std::sin(azimuth);
  const Vec3 normal(along.x() * c, along.x() * s, -along.y()), way(-s, c, 0.0);
  const Vec3 binormal(along.y() * c, along.y() * s, along.x());
  const double h = chip_thickness(cutter, motion, ring, z, azimuth);
  // An edge that meets nothing rubs on nothing.
  if (!(h > 0.0)) return Load::Zero();
  const double tangential = (k.tangential * h + k.tangential_edge) * edge;
  const Vec3 force = -tangential * way - (k.normal * h + k.normal_edge) * edge * normal +
                     (k.binormal * h + k.binormal_edge) * edge * binormal;
  return {force.x(), force.y(), force.z(), tangential * radius_of(ring, z)};
}

/// How far the edge has turned back at z: the integral of tan(helix) / rho, from the tip's rings on.
struct Lag {
  double at_low = 0.0;
  double slope = 0.0;  ///< rad for every mm of z, in this ring
};
std::vector<Lag> lags_of(const RotatingCutter& cutter) {
  std::vector<Lag> lags;
  double lag = 0.0;
  const CutterRing* before = nullptr;
  for (const CutterRing& ring : cutter.rings) {
    // The same ring once more, with another arc.
    if (before != nullptr && before->low == ring.low) {
      lags.push_back(lags.back());
      continue;
    }
    if (before != nullptr) lag += lags.back().slope * (before->high.x() - before->low.x());
    const double rho = 0.5 * (ring.low.y() + ring.high.y());
    lags.push_back({lag, rho > 0.0 ? std::tan(cutter.helix) / rho : 0.0});
    before = &ring;
  }
  return lags;
}

/// Azimuths between 0 and one turn above the ring's entry.
double behind_entry(double azimuth, double entry) {
  const double turned = std::fmod(azimuth - entry, kTurn);
  return turned < 0.0 ? turned + kTurn : turned;
}

/// Of one tooth in one ring, at one instant. z from low to high has azimuths from the tooth's own back by its lag.
Load tooth_load(const RotatingCutter& cutter, const CutterMotion& motion, const ForceCoefficients& k,
                const CutterRing& ring, const Lag& lag, double tooth) {
  Load sum = Load::Zero();
  const double low = ring.low.x(), high = ring.high.x(), arc = ring.exit - ring.entry;
  if (!(arc > 0.0) || !(high > low)) return sum;
  const auto azimuth = [&](double z) { return tooth - lag.at_low - lag.slope * (z - low); };
  if (!(lag.slope > 0.0)) {
    if (behind_entry(azimuth(low), ring.entry) >= arc) return sum;
    return integral(low, high, 1, sum, [&](double z) { return load_per_z(cutter, motion, k, ring, z, azimuth(z)); });
  }
  // Where the azimuth passes entry or exit: what is turned back by between top - arc and top is engaged, turn by turn.
  const double turned = behind_entry(azimuth(low), ring.entry), span = lag.slope * (high - low);
  for (double top = turned; top - arc < span; top += kTurn) {
    const double from = std::max(0.0, top - arc), to = std::min(span, top);
    if (!(to > from)) continue;
    sum = integral(low + from / lag.slope, low + to / lag.slope, steps_for(to - from), sum,
                   [&](double z) { return load_per_z(cutter, motion, k, ring, z, azimuth(z)); });
  }
  return sum;
}

/// On a ring's arc, in the middle of its height: where the cutter goes, or as near to that as the arc comes; within [entry, exit].
double thickest_azimuth(const RotatingCutter& cutter, const CutterMotion& motion, const CutterRing& ring) {
  const double z = 0.5 * (ring.low.x() + ring.high.x());
  const Vec3 velocity = motion.velocity + z * motion.velocity_by_z;
  const double forward = behind_entry(std::atan2(velocity.y(), velocity.x()), ring.entry);
  if (forward <= ring.exit - ring.entry) return ring.entry + forward;
  const auto at = [&](double azimuth) { return chip_thickness(cutter, motion, ring, z, azimuth); };
  return at(ring.entry) > at(ring.exit) ? ring.entry : ring.exit;
}

CuttingLoad as_load(const Load& sum) { return {sum.head<3>(), sum[3]}; }

}  // namespace

double chip_thickness(const RotatingCutter& cutter, const CutterMotion& motion, const CutterRing& ring, double z,
                      double azimuth) {
  const Vec2 along = (ring.high - ring.low).normalized();
  const Vec3 normal(along.x() * std::cos(azimuth), along.x() * std::sin(azimuth), -along.y());
  return std::max(0.0, normal.dot(motion.velocity + z * motion.velocity_by_z)) /
         (cutter.teeth * cutter.turns_per_second);
}

double thickest_chip(const RotatingCutter& cutter, const CutterMotion& motion, const CutterRing& ring) {
  if (!(ring.exit > ring.entry)) return 0.0;
  return chip_thickness(cutter, motion, ring, 0.5 * (ring.low.x() + ring.high.x()),
                        thickest_azimuth(cutter, motion, ring));
}

double lag_at(const RotatingCutter& cutter, double z) {
  const std::vector<Lag> lags = lags_of(cutter);
  double lag = 0.0;
  for (std::size_t k = 0; k < lags.size(); ++k)
    if (cutter.rings[k].low.x() <= z) lag = lags[k].at_low + lags[k].slope * (z - cutter.rings[k].low.x());
  return lag;
}

std::optional<double> nearest_engaged(const RotatingCutter& cutter, double z, double wanted, double most) {
  std::optional<double> nearest;
  double off = most;
  for (const CutterRing& ring : cutter.rings) {
    if (!(ring.exit > ring.entry) || z < ring.low.x() || z > ring.high.x()) continue;
    const double arc = ring.exit - ring.entry, inside = std::min(kJustInside, 0.5 * arc),
                 behind = behind_entry(wanted, ring.entry);
    const double past_exit = behind - arc, before_entry = kTurn - behind;
    const double away = std::max(0.0, std::min(past_exit, before_entry));
    if (away > off) continue;
    off = away;
    const bool at_entry = past_exit > 0.0 && before_entry < past_exit;
    nearest = ring.entry + std::clamp(at_entry ? 0.0 : behind, inside, arc - inside);
  }
  return nearest;
}

std::vector<double> peak_phases(const RotatingCutter& cutter, const CutterMotion& motion, int even) {
  std::vector<double> phases;
  for (int k = 0; k < even; ++k) phases.push_back(kTurn * k / (even * cutter.teeth));
  const std::vector<Lag> lags = lags_of(cutter);
  for (std::size_t k = 0; k < cutter.rings.size(); ++k) {
    const CutterRing& ring = cutter.rings[k];
    if (!(ring.exit > ring.entry)) continue;
    const double inside = std::min(kJustInside, 0.5 * (ring.exit - ring.entry)),
                 azimuth = std::clamp(thickest_azimuth(cutter, motion, ring), ring.entry + inside, ring.exit - inside);
    phases.push_back(azimuth + lags[k].at_low + 0.5 * lags[k].slope * (ring.high.x() - ring.low.x()));
  }
  return phases;
}

std::vector<CuttingLoad> ring_loads(const RotatingCutter& cutter, const CutterMotion& motion,
                                    const ForceCoefficients& coefficients, double phase) {
  const std::vector<Lag> lags = lags_of(cutter);
  std::vector<CuttingLoad> loads;
  for (std::size_t k = 0; k < cutter.rings.size(); ++k) {
    Load sum = Load::Zero();
    for (int tooth = 0; tooth < cutter.teeth; ++tooth)
      sum += tooth_load(cutter, motion, coefficients, cutter.rings[k], lags[k], phase + kTurn * tooth / cutter.teeth);
    loads.push_back(as_load(sum));
  }
  return loads;
}

CuttingLoad load_at(const RotatingCutter& cutter, const CutterMotion& motion, const ForceCoefficients& coefficients,
                    double phase) {
  CuttingLoad sum;
  for (const CuttingLoad& ring : ring_loads(cutter, motion, coefficients, phase))
    sum.force += ring.force, sum.torque_nmm += ring.torque_nmm;
  return sum;
}

CuttingLoad mean_load(const RotatingCutter& cutter, const CutterMotion& motion, const ForceCoefficients& coefficients) {
  Load sum = Load::Zero();
  for (const CutterRing& ring : cutter.rings) {
    if (!(ring.exit > ring.entry) || !(ring.high.x() > ring.low.x())) continue;
    const auto at_z = [&](double z) -> Load {
      return integral(ring.entry, ring.exit, steps_for(ring.exit - ring.entry), Load(Load::Zero()),
                      [&](double azimuth) { return load_per_z(cutter, motion, coefficients, ring, z, azimuth); });
    };
    sum = integral(ring.low.x(), ring.high.x(), 1, sum, at_z);
  }
  return as_load(sum * (cutter.teeth / kTurn));
}

double mean_power_w(const RotatingCutter& cutter, const CuttingLoad& mean) {
  return mean.torque_nmm * 1e-3 * kTurn * cutter.turns_per_second;
}

PeakLoad peak_load(const RotatingCutter& cutter, const CutterMotion& motion, const ForceCoefficients& coefficients,
                   int even) {
  PeakLoad peak;
  for (const double phase : peak_phases(cutter, motion, even)) {
    const CuttingLoad load = load_at(cutter, motion, coefficients, phase);
    peak.force_n = std::max(peak.force_n, load.force.norm());
    peak.torque_nmm = std::max(peak.torque_nmm, load.torque_nmm);
  }
  for (const CutterRing& ring : cutter.rings)
    peak.chip_mm = std::max(peak.chip_mm, thickest_chip(cutter, motion, ring));
  return peak;
}

}  // namespace flank::internal
