/// Linear dimensions of a DXF drawing.
#pragma once

#include <string>
#include <vector>

#include "flank/io/text/dxf_text.h"
#include "flank/vec.h"

namespace flank::internal {

/// What is measured between two points, along x or along y. Millimetres.
struct DxfDimension {
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();
  bool vertical = false;
  double line = 0.0;   ///< where the dimension line is: its x if vertical, else its y
  std::string prefix;  ///< before the number: "%%c" (diameter), "R"
};

inline constexpr const char* kDxfDimensionLayer = "DIMENSION";

/// Table DIMSTYLE with the style of the dimensions, for text of this height.
void dxf_dimension_style(DxfText& out, double height);
/// Section BLOCKS: what each dimension looks like, for readers that draw no dimensions of their own.
void dxf_dimension_blocks(DxfText& out, const std::vector<DxfDimension>& dimensions, double height);
/// The DIMENSION entities; they refer to the blocks.
void dxf_dimensions(DxfText& out, const std::vector<DxfDimension>& dimensions, double height);

}  // namespace flank::internal
