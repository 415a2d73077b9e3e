/// Forces between a milling cutter and what it cuts, by mechanistic coefficients (docs/MATH.md, section 18).
#pragma once

#include <optional>
#include <vector>

#include "flank/vec.h"

namespace flank::internal {

/// What an edge feels: forces per area of the uncut chip, N/mm^2, and per length of the edge, N/mm. Tangential against the
/// edge's way, normal into the tool, binormal along the meridian towards the holder.
struct ForceCoefficients {
  double tangential = 0.0, tangential_edge = 0.0;
  double normal = 0.0, normal_edge = 0.0;
  double binormal = 0.0, binormal_edge = 0.0;
};

/// A ring of the cutter, and where it is in the material; a ring with several arcs is there once for each. Azimuths are counted the way the cutter turns, from the first direction
/// of the frame, rad; an exit <= entry: nothing is engaged.
struct CutterRing {
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();  ///< ends of its meridian, (z, rho), mm, z towards the holder
  double entry = 0.0, exit = 0.0;
};

struct RotatingCutter {
  std::vector<CutterRing> rings;  ///< from the tip upwards
  int teeth = 2;
  double helix = 0.0;             ///< of the edges to the axis, rad; edges higher up cut later
  double turns_per_second = 0.0;  ///< > 0
};

/// How the axis moves against the work, mm/s: of the point z = 0 and, for every mm of z, more. In the frame of the azimuths: x is
/// azimuth 0, y azimuth 90 degrees, z towards the holder.
struct CutterMotion {
  Vec3 velocity = Vec3::Zero(), velocity_by_z = Vec3::Zero();
};

/// On the tool.
struct CuttingLoad {
  Vec3 force = Vec3::Zero();  ///< N
  double torque_nmm = 0.0;    ///< against the spindle, N mm
};

/// The chip of a tooth at an azimuth of a ring, mm: the normal velocity times the time between two teeth, never below 0.
[[nodiscard]] double chip_thickness(const RotatingCutter& cutter, const CutterMotion& motion, const CutterRing& ring,
                                    double z, double azimuth);

/// The thickest chip on a ring's arc, at the middle of its height, mm.
[[nodiscard]] double thickest_chip(const RotatingCutter& cutter, const CutterMotion& motion, const CutterRing& ring);

/// Phases between two teeth at which the load may be the largest of a turn: `even` equal ones, and for each ring that in which an edge is
/// where its chip is thickest; a straight edge meets all of a narrow arc at once, and even ones would miss it.
[[nodiscard]] std::vector<double> peak_phases(const RotatingCutter& cutter, const CutterMotion& motion, int even);

/// How far an edge has turned back at height z against its place at z = 0, rad.
[[nodiscard]] double lag_at(const RotatingCutter& cutter, double z);

/// Of the ring at height z the engaged azimuth that is nearest to the wanted one, just inside of its arc; none where nothing within `most` of it is
/// engaged, rad.
[[nodiscard]] std::optional<double> nearest_engaged(const RotatingCutter& cutter, double z, double wanted,
                                                    double most = 0.2);

/// On each ring at one instant: the first tooth's edge is at azimuth `phase` where z = 0. Rings are cut into pieces in which no edge enters or
/// leaves, so that this is no sampled sum.
[[nodiscard]] std::vector<CuttingLoad> ring_loads(const RotatingCutter& cutter, const CutterMotion& motion,
                                                  const ForceCoefficients& coefficients, double phase);

/// The sum of these.
[[nodiscard]] CuttingLoad load_at(const RotatingCutter& cutter, const CutterMotion& motion,
                                  const ForceCoefficients& coefficients, double phase);

/// Over a whole turn: it does not depend on the helix, which only shifts when what is cut.
[[nodiscard]] CuttingLoad mean_load(const RotatingCutter& cutter, const CutterMotion& motion,
                                    const ForceCoefficients& coefficients);

/// W: of the mean torque.
[[nodiscard]] double mean_power_w(const RotatingCutter& cutter, const CuttingLoad& mean);

/// The largest force and chip of a turn, over peak_phases.
struct PeakLoad {
  double force_n = 0.0, torque_nmm = 0.0, chip_mm = 0.0;
};
[[nodiscard]] PeakLoad peak_load(const RotatingCutter& cutter, const CutterMotion& motion,
                                 const ForceCoefficients& coefficients, int even = 90);

}  // namespace flank::internal
