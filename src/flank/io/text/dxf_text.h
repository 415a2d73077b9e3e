/// Writing ASCII DXF: group codes and values.
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace flank::internal {

/// Group codes and values, one a line.
class DxfText {
 public:
  DxfText& add(int code, std::string_view value);
  DxfText& add(int code, double value);  ///< exactly, without an exponent
  DxfText& add(int code, int value);
  DxfText& point(int first_code, double x, double y);
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

}  // namespace flank::internal
