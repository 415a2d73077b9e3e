#include "flank/verify/stock/dexel_field.h"

#include <algorithm>
#include <cmath>

namespace flank::internal::verify {

DexelField::DexelField(int axis, const Box3& box, double cell_mm) : axis_(axis), cell_(cell_mm), low_(box.low) {
  const Vec3 size = box.high - box.low;
  const auto count = [&](int k) { return std::max(1, static_cast<int>(std::ceil(size[k] / cell_ - 1e-9))); };
  width_ = count(across());
  rows_.resize(static_cast<std::size_t>(count(up())));
  const DexelSpan full{static_cast<float>(box.low[axis_]), static_cast<float>(box.high[axis_])};
  for (Row& row : rows_) row.nodes.assign(static_cast<std::size_t>(width_), Node{full, -1});
}

double DexelField::subtract(int row, int line, double low, double high) {
  Row& r = rows_[static_cast<std::size_t>(row)];
  const auto from = static_cast<float>(low), to = static_cast<float>(high);
  if (!(from < to)) return 0.0;
  double removed = 0.0;
  for (int k = line; k >= 0;) {
    Node& node = r.nodes[static_cast<std::size_t>(k)];
    const int next = node.next;
    DexelSpan& span = node.span;
    const float a = std::max(span.low, from), b = std::min(span.high, to);
    if (a < b) {
      removed += static_cast<double>(b) - static_cast<double>(a);
      if (span.low < a && b < span.high) {
        const Node rest{{b, span.high}, next};
        span.high = a;
        int place = r.free;
        if (place >= 0)
          r.free = r.nodes[static_cast<std::size_t>(place)].next;
        else
          place = static_cast<int>(r.nodes.size());
        node.next = place;  // before the vector may move
        if (place == static_cast<int>(r.nodes.size()))
          r.nodes.push_back(rest);
        else
          r.nodes[static_cast<std::size_t>(place)] = rest;
      } else if (span.low < a) {
        span.high = a;
      } else {
        span.low = b;
      }
    }
    k = next;
  }
  // Chained nodes that are empty now are given back.
  for (int before = line; before >= 0;) {
    const int k = r.nodes[static_cast<std::size_t>(before)].next;
    if (k < 0) break;
    Node& node = r.nodes[static_cast<std::size_t>(k)];
    if (node.span.low < node.span.high) {
      before = k;
      continue;
    }
    r.nodes[static_cast<std::size_t>(before)].next = node.next;
    node.next = r.free;
    r.free = k;
  }
  return removed;
}

bool DexelField::meets(int row, int line, double& low, double& high) const {
  double from = high, to = low;
  visit(row, line, [&](const DexelSpan& span) {
    if (!(span.low < high && span.high > low)) return;
    from = std::min(from, std::max(low, static_cast<double>(span.low)));
    to = std::max(to, std::min(high, static_cast<double>(span.high)));
  });
  low = from;
  high = to;
  return from < to;
}

bool DexelField::holds(int row, int line, double place) const {
  bool found = false;
  visit(row, line, [&](const DexelSpan& span) { found = found || (span.low <= place && place <= span.high); });
  return found;
}

}  // namespace flank::internal::verify
