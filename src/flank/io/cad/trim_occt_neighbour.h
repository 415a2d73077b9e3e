/// Borders of a face with another surface, moved to where that surface meets the neighbours. Private to io: no Open CASCADE type leaves this
/// folder.
#pragma once

#include <Geom_BSplineSurface.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <memory>
#include <optional>

#include "flank/io/cad/new_surface.h"

namespace flank::internal {

/// How a border was led over.
struct LedBorder {
  double off_mm = 0.0;    ///< between the border in space and the new surface, or the neighbour, at most
  double moved_mm = 0.0;  ///< between the old border and the new one, at most
};

/// Leads all borders of `face`, edges of `shape`, over to a surface, and its neighbours with them.
class BorderMove {
 public:
  /// Finds the new corners: an edge of two neighbours that ends at a corner of the face ends at the surface now. Where it would have to
  /// be longer, or where several end, the corner stays. The edges' ranges change at once.
  BorderMove(const TopoDS_Shape& shape, const TopoDS_Face& face, const NewSurface& wanted);
  ~BorderMove();
  BorderMove(const BorderMove&) = delete;
  BorderMove& operator=(const BorderMove&) = delete;

  /// Gives the edge the curve in which the surface meets the neighbour, as a trim of both. Along a neighbour that ends before somewhere, or
  /// goes on smoothly, the old border stays whole, and an edge tolerance covers the gap. None where it runs past the surface, or where no
  /// curve goes through.
  [[nodiscard]] std::optional<LedBorder> lead_over(const TopoDS_Edge& edge,
                                                   const Handle(Geom_BSplineSurface) & surface);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace flank::internal
