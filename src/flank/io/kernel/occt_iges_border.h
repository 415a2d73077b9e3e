/// The borders of trimmed IGES surfaces are in the file twice, in space and in the surface's parameters; the kernel makes edges of one of
/// them. Private to io: no Open CASCADE type leaves this folder and io/cad.
#pragma once

#include <IGESData_IGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <TopoDS_Shape.hxx>

namespace flank::internal {

/// How far the curves in space of a trimmed surface's border are from the edges of what the kernel `made` of it, or how much longer one is than the
/// other, mm; 0 where that is no more than programs leave, and for what is no trimmed surface or has no such curves.
[[nodiscard]] double iges_border_gap(const Handle(IGESData_IGESModel) & model,
                                     const Handle(IGESData_IGESEntity) & entity, const TopoDS_Shape& made);

}  // namespace flank::internal
