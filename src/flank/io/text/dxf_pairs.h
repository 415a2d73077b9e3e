/// Reading ASCII DXF: group codes and values.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace flank::internal {

/// Pairs of a group code and a value, each on a line of its own.
class DxfPairs {
 public:
  DxfPairs(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  /// The next pair; false at the end. Throws InputError, naming file and line, for what is no pair.
  bool next();
  [[nodiscard]] int code() const { return code_; }
  [[nodiscard]] std::string_view value() const { return value_; }
  [[nodiscard]] long line() const { return line_; }
  [[noreturn]] void refuse(const std::string& why) const;

 private:
  bool take_line(std::string_view& out);

  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0;
  long line_ = 0;
  int code_ = 0;
  std::string_view value_;
};

/// An entity of a drawing, or one of the vertices of a POLYLINE, with the values that follow it.
struct DxfRecord {
  std::string name;
  long line = 0;  ///< of the file, counted from 1
  std::vector<std::pair<int, std::string>> groups;

  [[nodiscard]] bool has(int code) const;
  /// The first value of a code, or `missing`.
  [[nodiscard]] std::string text(int code, const std::string& missing = "") const;
};

struct DxfContent {
  std::vector<DxfRecord> entities;  ///< of section ENTITIES, in their order
  double unit_mm = 1.0;             ///< by $INSUNITS; 1 where the file has none
};

/// Section ENTITIES and the unit. Throws InputError as above, and for a unit of which no lengths in mm are known.
[[nodiscard]] DxfContent read_dxf(std::string_view text, const std::string& file);

}  // namespace flank::internal
