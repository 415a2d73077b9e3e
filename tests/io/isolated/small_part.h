/// A part with something in every field that goes through bytes.
#pragma once

#include "flank/part.h"

namespace flank::internal {

inline Part small_part() {
  Part part;
  part.file = "a\xff.step", part.format = "STEP", part.unit = "in", part.millimetres_per_unit = 25.4;
  part.solids = 1;
  part.box.add(Vec3(0, 0, 0));
  part.box.add(Vec3(1, 2, 3));
  Face face;
  face.id = "F1", face.reversed = true, face.of_solid = true, face.solid = 0;
  BSplineSurface& s = face.surface;
  s.degree_u = s.degree_v = 1, s.count_u = s.count_v = 2;
  s.knots_u = s.knots_v = {0, 0, 1, 1};
  s.poles = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 1e-17}};
  s.weights = {1, 2, 3, 4};
  BSplineCurve2 edge;
  edge.degree = 1, edge.knots = {0, 0, 1, 1};
  edge.poles.resize(2, 2);
  edge.poles << 0, 1, 0, 0.1;
  face.loops.resize(1);
  face.loops[0].edges = {edge};
  part.faces = {face, Face{}};
  part.faces[1].id = "F2";
  part.surface_types = {"B-spline", "unknown"};
  part.left_out[1] = "why";
  part.repairs = {"sewn", ""};
  return part;
}

}  // namespace flank::internal
