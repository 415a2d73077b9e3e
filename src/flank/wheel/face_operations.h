/// Operations of the tip sphere on single faces of the blades.
#pragma once

#include <optional>

#include "flank/wheel/wheel_work.h"

namespace flank::internal {

/// Root fillets; leading and trailing edges; what flank and floor have left of the sides. Each by passes along its faces, of one sector or
/// of all, as the work says. Call them in this order: what is finished is not milled again; fillets and sides of which nothing is left that
/// the tip reaches have no operation.
[[nodiscard]] std::optional<WheelOperation> fillet_operation(WheelWork& work);
[[nodiscard]] WheelOperation edge_operation(WheelWork& work);
[[nodiscard]] std::optional<WheelOperation> rest_operation(WheelWork& work);

}  // namespace flank::internal
