#include "flank/io/text/dxf_dimension.h"

#include <fmt/format.h>

#include <cmath>

namespace flank::internal {
namespace {

/// Ends of the dimension line, the middle of its text, and what it measures.
struct Layout {
  Vec2 from, to, text;
  double length = 0.0;
};

Layout layout(const DxfDimension& d, double height) {
  Layout out;
  if (d.vertical) {
    out.from = {d.line, d.from.y()};
    out.to = {d.line, d.to.y()};
    // Not in the middle, where the centreline runs.
    out.text = {d.line - height, 0.75 * d.from.y() + 0.25 * d.to.y()};
  } else {
    out.from = {d.from.x(), d.line};
    out.to = {d.to.x(), d.line};
    out.text = {0.5 * (d.from.x() + d.to.x()), d.line + height};
  }
  out.length = (out.to - out.from).norm();
  return out;
}

std::string words(const DxfDimension& d, double height) {
  return fmt::format("{}{:.4f}", d.prefix, layout(d, height).length);
}

std::string block_name(std::size_t k) { return fmt::format("*D{}", k + 1); }

void line(DxfText& out, const Vec2& a, const Vec2& b) {
  if (a == b) return;
  out.add(0, "LINE").add(8, kDxfDimensionLayer).point(10, a.x(), a.y()).point(11, b.x(), b.y());
}

/// A filled arrow with its tip at `tip`, looking along `along`.
void arrow(DxfText& out, const Vec2& tip, const Vec2& along, double size) {
  const Vec2 back = tip - size * along, across = size / 6.0 * Vec2(-along.y(), along.x());
  const Vec2 a = back + across, b = back - across;
  out.add(0, "SOLID").add(8, kDxfDimensionLayer).point(10, tip.x(), tip.y());
  out.point(11, a.x(), a.y()).point(12, b.x(), b.y()).point(13, b.x(), b.y());
}

}  // namespace

void dxf_dimension_style(DxfText& out, double height) {
  out.add(0, "TABLE").add(2, "DIMSTYLE").add(70, 1);
  out.add(0, "DIMSTYLE").add(2, "STANDARD").add(70, 0);
  out.add(40, 1.0).add(41, height).add(42, 0.0).add(44, 0.5 * height).add(140, height).add(147, 0.5 * height);
  out.add(0, "ENDTAB");
}

void dxf_dimension_blocks(DxfText& out, const std::vector<DxfDimension>& dimensions, double height) {
  out.add(0, "SECTION").add(2, "BLOCKS");
  for (std::size_t k = 0; k < dimensions.size(); ++k) {
    const DxfDimension& d = dimensions[k];
    const Layout at = layout(d, height);
    out.add(0, "BLOCK").add(8, kDxfDimensionLayer).add(2, block_name(k)).add(70, 1).point(10, 0.0, 0.0);
    out.add(3, block_name(k));
    line(out, d.from, at.from);
    line(out, d.to, at.to);
    line(out, at.from, at.to);
    const Vec2 along = at.length > 0.0 ? Vec2((at.to - at.from) / at.length) : Vec2(1.0, 0.0);
    arrow(out, at.from, -along, height);
    arrow(out, at.to, along, height);
    out.add(0, "TEXT").add(8, kDxfDimensionLayer).point(10, at.text.x(), at.text.y()).add(40, height);
    out.add(1, words(d, height)).add(50, d.vertical ? 90.0 : 0.0).add(72, 4).point(11, at.text.x(), at.text.y());
    out.add(0, "ENDBLK").add(8, kDxfDimensionLayer);
  }
  out.add(0, "ENDSEC");
}

void dxf_dimensions(DxfText& out, const std::vector<DxfDimension>& dimensions, double height) {
  for (std::size_t k = 0; k < dimensions.size(); ++k) {
    const DxfDimension& d = dimensions[k];
    const Layout at = layout(d, height);
    out.add(0, "DIMENSION").add(8, kDxfDimensionLayer).add(2, block_name(k)).add(3, "STANDARD").add(70, 0);
    out.point(10, at.to.x(), at.to.y()).point(11, at.text.x(), at.text.y()).add(1, words(d, height));
    out.point(13, d.from.x(), d.from.y()).point(14, d.to.x(), d.to.y()).add(50, d.vertical ? 90.0 : 0.0);
  }
}

}  // namespace flank::internal
