/// One NURBS face prepared for footpoints: its extended surface in polynomial cells, its smooth zones, seams and poles.
#pragma once

#include <array>
#include <vector>

#include "flank/geom/bspline_extend.h"
#include "flank/geom/trim.h"
#include "flank/surface/nurbs/nurbs_newton.h"
#include "flank/target.h"

namespace flank::internal {

/// Immutable after construction; safe to use from many threads. Lengths in mm, parameters those of the face's surface.
class NurbsFace {
 public:
  /// side: +1 machines the side that the face's outward normal points to.
  NurbsFace(const Face& face, int side, const ExtensionOptions& options);

  /// The locally closest point on the extended face, descending from the parameters (u, v) zone by zone.
  [[nodiscard]] Footpoint track(const Vec3& p, double u, double v, bool& ok) const;

  /// Unit normal towards the machining side. At a pole, where the derivatives vanish, that of a point close by.
  [[nodiscard]] Vec3 normal(const SurfaceJet& jet, double u, double v) const;

  /// Footpoint with signed distance and curvatures of a point of the face. `along_normal` false: p - point need not be
  /// along the normal, the distance is |p - point| with the sign of that product.
  [[nodiscard]] Footpoint footpoint(const Vec3& p, double u, double v, const SurfaceJet& jet, bool along_normal,
                                    Location location) const;

  /// The extended surface, cell by cell.
  [[nodiscard]] const BSplinePatches& patches() const { return patches_; }
  /// Parameter rectangle of the face itself (of its trims), without extension.
  [[nodiscard]] const ParameterBox& domain() const { return domain_; }
  /// The same with its extensions.
  [[nodiscard]] const ParameterBox& extended() const { return extended_; }
  /// Whether the parameters are inside the trims (even-odd rule).
  [[nodiscard]] bool inside(double u, double v) const { return trim_.inside(u, v); }
  /// Whether the face is all of its domain.
  [[nodiscard]] bool whole() const { return trim_.whole(); }
  [[nodiscard]] const TrimRegion& trim() const { return trim_; }
  /// Point and derivatives at parameters of the domain, on its borders and a little past them by the polynomials of its
  /// own cells.
  [[nodiscard]] SurfaceJet jet_within(double u, double v) const;
  /// Length scale of convergence: the diagonal of the face, mm.
  [[nodiscard]] double size() const { return size_; }
  /// Whether the borders u = u0 and u = u1 (v = v0 and v = v1) are one curve: a seam.
  [[nodiscard]] bool closed_u() const { return closed_u_; }
  [[nodiscard]] bool closed_v() const { return closed_v_; }
  /// Parameters within the domain across which the surface is not smooth.
  [[nodiscard]] std::vector<double> creases_u() const { return within(ends_u_, domain_.u0, domain_.u1); }
  [[nodiscard]] std::vector<double> creases_v() const { return within(ends_v_, domain_.v0, domain_.v1); }
  /// Whether the border u = u0, u = u1, v = v0, v = v1 (in this order) is a single point.
  [[nodiscard]] bool pole(int border) const { return pole_[static_cast<std::size_t>(border)]; }
  /// The part of the domain or its extension between creases that holds (u, v).
  [[nodiscard]] const ParameterBox& zone_at(double u, double v) const { return zone(zone_u(u), zone_v(v)); }

 private:
  static std::vector<double> within(const std::vector<double>& ends, double low, double high);
  /// Finds seams and poles.
  void find_borders(const BSplineSurface& surface);
  /// How far to extend past each border, in parameters.
  [[nodiscard]] ParameterMargins margins(const BSplineSurface& surface, const ExtensionOptions& options) const;
  void find_zones(const BSplineSurface& surface);
  /// Index of the zone that holds a parameter.
  [[nodiscard]] int zone_u(double u) const;
  [[nodiscard]] int zone_v(double v) const;
  [[nodiscard]] const ParameterBox& zone(int i, int j) const {
    return zones_[static_cast<std::size_t>(i) * (ends_v_.size() - 1) + static_cast<std::size_t>(j)];
  }
  /// Goes on in the neighbouring zone if the descent was held at their common end and the gradient leads across.
  bool hop_u(const Vec3& p, int& zone_i, int zone_j, Descent& x) const;
  bool hop_v(const Vec3& p, int zone_i, int& zone_j, Descent& x) const;
  [[nodiscard]] bool at_pole(double u, double v) const;

  TrimRegion trim_;
  BSplinePatches patches_;
  ParameterBox domain_, extended_;
  std::vector<double> ends_u_, ends_v_;  ///< ends of the zones
  std::vector<ParameterBox> zones_;
  /// sign_: of S_u x S_v towards the machining side.
  double sign_ = 1.0, size_ = 0.0;
  bool closed_u_ = false, closed_v_ = false;
  std::array<bool, 4> pole_{};
};

}  // namespace flank::internal
