/// A tool taken away from the lines of one row of a stock.
#pragma once

#include "flank/verify/stock/dexel_field.h"
#include "flank/verify/stock/line_weights.h"
#include "flank/verify/stock/tool_solid.h"

namespace flank::internal::verify {

/// A place among `count` of them, or one beside.
[[nodiscard]] int clipped(double x, int count);

/// Takes the tool at a pose away from a row of lines; returns the length that was material, mm times the cells that lines stand for.
double cut_row(DexelField& field, const LineWeights& weights, const ToolSolid& tool, const Pose& pose, int row);

}  // namespace flank::internal::verify
