#include "flank/io/text/dxf_text.h"

#include <fmt/format.h>

#include "flank/io/text/json_input.h"

namespace flank::internal {

DxfText& DxfText::add(int code, std::string_view value) {
  text_ += fmt::format("{:>3}\n{}\n", code, value);
  return *this;
}

DxfText& DxfText::add(int code, double value) { return add(code, std::string_view(exact_decimal(value))); }

DxfText& DxfText::add(int code, int value) { return add(code, std::string_view(fmt::format("{}", value))); }

DxfText& DxfText::point(int first_code, double x, double y) {
  return add(first_code, x).add(first_code + 10, y).add(first_code + 20, 0.0);
}

}  // namespace flank::internal
