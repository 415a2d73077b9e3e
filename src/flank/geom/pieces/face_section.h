/// Lines across a face, along one of its two parameters, and where they bend like the edge of an aerofoil.
#pragma once

#include <optional>
#include <vector>

#include "flank/bspline_surface.h"

namespace flank::internal {

/// Where the surface's curvature across is larger than this over its width, it is an edge: a radius below a tenth of the
/// chord. A round bar has 2, an elliptic section of axes 2 : 1 has 8 at its ends.
inline constexpr double kEdgeBend = 10.0;
/// An edge turns the normal by at least this much: less is a ripple, or a crease.
inline constexpr double kEdgeTurnDeg = 45.0;
/// Only a face whose normals turn by more than this is told apart: one tool on one side cannot see all of it.
inline constexpr double kWrapTurnDeg = 120.0;

struct SectionSample {
  double t;
  Vec3 point, normal;
};

/// A stretch of a section; `last` may lie past the end of a closed one.
struct SectionStretch {
  double first = 0.0, last = 0.0;
  [[nodiscard]] double middle() const { return 0.5 * (first + last); }
};

/// One line across the face.
struct FaceSection {
  std::vector<SectionSample> samples;
  double width = 0.0;  ///< largest distance between two of its points, mm
  double turn = 0.0;   ///< largest angle between two of its normals
};

/// The surface as seen from one of its two directions: t goes across the edges, w along them.
struct SectionView {
  const BSplineSurface& s;
  bool along_u;  ///< t is u

  [[nodiscard]] double first() const { return along_u ? s.u_first() : s.v_first(); }
  [[nodiscard]] double last() const { return along_u ? s.u_last() : s.v_last(); }
  [[nodiscard]] std::optional<SectionSample> at(double t, double w) const {
    const SurfaceJet jet = along_u ? s.jet(t, w) : s.jet(w, t);
    const Vec3 cross = jet.du.cross(jet.dv);
    const double length = cross.norm();
    if (!(length > 1e-12 * std::max(jet.du.squaredNorm(), jet.dv.squaredNorm()))) return std::nullopt;
    return SectionSample{t, jet.p, cross / length};
  }
};

/// The section at w, sampled so finely that the normal turns little from one to the next. Empty where the surface has no
/// normal. `closed`: ends with its start, so that a kink at the seam is seen.
[[nodiscard]] FaceSection section_at(const SectionView& view, double w, bool closed);

/// Where the section bends like an edge and turns by at least `turn_deg`, in the order of the parameter. Edges between which there is no
/// side worth the name are one. None where the section wraps round nothing.
[[nodiscard]] std::vector<SectionStretch> edges_of(const FaceSection& section, bool closed, double turn_deg);

/// A shorter side between two edges, as a share of the section's width, belongs to them.
inline constexpr double kLeastSide = 0.1;

}  // namespace flank::internal
