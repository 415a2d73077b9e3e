/// An Open CASCADE face as values. Private to io: no Open CASCADE type leaves this folder.
#pragma once

#include <TopoDS_Face.hxx>
#include <string>
#include <vector>

#include "flank/face.h"
#include "flank/io/cad/read_cad.h"

namespace flank::internal {

/// How a parameter of the file's surface becomes the parameter of the B-spline that is exactly the same surface.
/// Circular sections become rational arcs, whose parameter is not the angle: on an arc of half angle h about its middle
/// m,
///   t = m + h tan((angle - m) / 2) / tan(h / 2)
/// (standard rational quadratic, Piegl and Tiller 7.3). Empty breaks: the parameters are the same.
struct ParameterMap {
  std::vector<double> breaks;  ///< the angles where the arcs join, ascending
  [[nodiscard]] bool identity() const { return breaks.empty(); }
  [[nodiscard]] double value(double t) const;
  [[nodiscard]] double derivative(double t) const;
};

struct OcctFace {
  Face face;         ///< id, solid and of_solid are not set
  std::string type;  ///< plane, cylinder, cone, sphere, torus, Bezier, B-spline, revolution, extrusion, offset, other
  ParameterMap map_u, map_v;
  std::vector<std::string> notes;
};

/// Converts surface and trims. `name` (file and face) begins every message. Throws InputError for a face without a
/// finite surface or with trims that cannot be had.
[[nodiscard]] OcctFace convert_occt_face(const TopoDS_Face& face, const std::string& name);

}  // namespace flank::internal
