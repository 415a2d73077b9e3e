#include "flank/verify/stock/dexel_field.h"

#include <algorithm>
#include <cmath>

namespace flank::internal::verify {

namespace {

/// Of a line without material.
constexpr float kNowhere = 1e30F;

}  // namespace

DexelField::DexelField(int axis, const Box3& box, double cell_mm)
    : axis_(axis), across_((axis + 1) % 3), up_((axis + 2) % 3), cell_(cell_mm), low_(box.low) {
  const Vec3 size = box.high - box.low;
  const auto count = [&](int k) { return std::max(1, static_cast<int>(std::ceil(size[k] / cell_ - 1e-9))); };
  width_ = count(across());
  depth_ = count(axis_);
  rows_.resize(static_cast<std::size_t>(count(up())));
  const std::size_t lines = index(rows(), 0);
  lows_.assign(lines, static_cast<float>(box.low[axis_]));
  highs_.assign(lines, static_cast<float>(box.high[axis_]));
  gap_lows_ = highs_, gap_highs_ = lows_;
  chains_.assign(lines, -1);
}

int DexelField::Row::add(const Link& link) {
  int place = free;
  if (place >= 0) {
    free = links[static_cast<std::size_t>(place)].next;
    links[static_cast<std::size_t>(place)] = link;
  } else {
    place = static_cast<int>(links.size());
    links.push_back(link);
  }
  return place;
}

double DexelField::subtract(int row, int line, double low, double high) {
  const auto from = static_cast<float>(low), to = static_cast<float>(high);
  if (!(from < to)) return 0.0;
  const std::size_t k = index(row, line);
  Row& r = rows_[static_cast<std::size_t>(row)];
  if (chains_[k] >= 0) return subtract_from_chain(r, k, from, to);
  float &first = lows_[k], &last = highs_[k];
  const float a = std::max(first, from), b = std::min(last, to);
  if (!(a < b)) return 0.0;
  const double removed = static_cast<double>(b) - static_cast<double>(a);
  if (first < a && b < last) {
    chains_[k] = r.add({{first, a}, r.add({{b, last}, -1})});
    ++r.chains;
    gap_lows_[k] = a, gap_highs_[k] = b;
    return removed;
  }
  if (first < a)
    last = a;
  else if (b < last)
    first = b;
  else
    first = kNowhere, last = -kNowhere;
  gap_lows_[k] = last, gap_highs_[k] = first;
  return removed;
}

double DexelField::subtract_from_chain(Row& row, std::size_t k, float from, float to) {
  double removed = 0.0;
  for (int n = chains_[k]; n >= 0;) {
    const Link link = row.links[static_cast<std::size_t>(n)];
    DexelSpan span = link.span;
    const float a = std::max(span.low, from), b = std::min(span.high, to);
    if (a < b) {
      removed += static_cast<double>(b) - static_cast<double>(a);
      int next = link.next;
      if (span.low < a && b < span.high) next = row.add({{b, span.high}, next});
      (span.low < a ? span.high : span.low) = span.low < a ? a : b;
      row.links[static_cast<std::size_t>(n)] = {span, next};
    }
    n = link.next;
  }
  if (removed > 0.0) settle_chain(row, k);
  return removed;
}

void DexelField::settle_chain(Row& row, std::size_t k) {
  float first = kNowhere, last = -kNowhere, gap_low = last, gap_high = first, widest = -1.0F;
  int count = 0;
  for (int* at = &chains_[k]; *at >= 0;) {
    const int n = *at;
    Link& link = row.links[static_cast<std::size_t>(n)];
    if (link.span.low < link.span.high) {
      if (count == 0) first = link.span.low;
      if (count > 0 && link.span.low - last > widest) {
        widest = link.span.low - last;
        gap_low = last, gap_high = link.span.low;
      }
      last = link.span.high;
      ++count;
      at = &link.next;
    } else {
      *at = link.next;
      link.next = row.free;
      row.free = n;
    }
  }
  lows_[k] = first, highs_[k] = last;
  gap_lows_[k] = count > 1 ? gap_low : last, gap_highs_[k] = count > 1 ? gap_high : first;
  if (count > 1) return;
  --row.chains;
  if (count == 0) return;
  row.links[static_cast<std::size_t>(chains_[k])].next = row.free;
  row.free = chains_[k];
  chains_[k] = -1;
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
