/// Writing ASCII DXF: group codes and values.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

#include "flank/io/json_input.h"

namespace flank {

/// Group codes and values, one a line.
class DxfText {
 public:
  DxfText& add(int code, std::string_view value) {
    text_ += fmt::format("{:>3}\n{}\n", code, value);
    return *this;
  }
  DxfText& add(int code, double value) { return add(code, exact_decimal(value)); }
  DxfText& add(int code, int value) { return add(code, fmt::format("{}", value)); }
  DxfText& point(int first_code, double x, double y) {
    return add(first_code, x).add(first_code + 10, y).add(first_code + 20, 0.0);
  }
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

}  // namespace flank
