#include "flank/io/path/path_csv.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <vector>

#include "flank/error.h"
#include "flank/io/text/json_input.h"
#include "flank/path_file.h"

namespace flank::internal {

namespace {

constexpr std::string_view kHead = "strip,kind,face,x,y,z,i,j,k";
constexpr std::size_t kColumns = 9;

/// Quoted if it has to be (RFC 4180): quotes inside are doubled.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

/// Reads one record at a time; counts lines.
class Records {
 public:
  Records(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  /// Fields of the next record that is not empty; nothing at the end.
  std::optional<std::vector<std::string>> next() {
    while (at_ < text_.size()) {
      line_ = next_line_;
      std::vector<std::string> fields = record();
      // Empty lines, at the end above all, are no records.
      if (fields.size() > 1 || !fields.front().empty()) return fields;
    }
    return std::nullopt;
  }

  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError(fmt::format("{}: line {}: {}", file_, line_, why));
  }

  [[nodiscard]] double number(const std::string& text) const {
    double value = 0.0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end || !std::isfinite(value))
      refuse(fmt::format("\"{}\" is not a finite number", text));
    return value;
  }

 private:
  /// One record; a quoted field may contain line breaks, so records and lines are counted apart.
  std::vector<std::string> record() {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      next_line_ += c == '\n';
      if (quoted) {
        if (c != '"') {
          fields.back() += c;
        } else if (at_ + 1 < text_.size() && text_[at_ + 1] == '"') {
          fields.back() += '"';
          ++at_;
        } else {
          quoted = false;
        }
      } else if (c == '\n') {
        ++at_;
        return fields;
      } else if (c == '"') {
        quoted = true;
      } else if (c == ',') {
        fields.emplace_back();
      } else if (c != '\r') {
        fields.back() += c;
      }
    }
    if (quoted) refuse("a quote is not closed");
    return fields;
  }

  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0;
  long line_ = 1, next_line_ = 1;
};

/// Columns x, y, z, i, j, k. An axis with rounded digits is normalised, as in path.json.
Pose pose_from(const Records& in, const std::vector<std::string>& f) {
  Pose pose{{in.number(f[3]), in.number(f[4]), in.number(f[5])}, {in.number(f[6]), in.number(f[7]), in.number(f[8])}};
  const double length = pose.axis.norm();
  if (!(std::abs(length - 1.0) <= kAxisLengthRounded))
    in.refuse(fmt::format("the axis vector i, j, k has length {}; must be 1", length));
  if (std::abs(length - 1.0) > kAxisLengthExact) pose.axis /= length;
  return pose;
}

}  // namespace

std::string path_to_csv(const Path& path) {
  std::string text = fmt::format("{}\n", kHead);
  for (const Strip& strip : path.strips) {
    const std::string head = fmt::format("{},{},{}", strip.id, field(strip.kind), field(strip.face));
    for (const Pose& p : strip.poses)
      text += fmt::format("{},{},{},{},{},{},{}\n", head, exact_number(p.tip.x()), exact_number(p.tip.y()),
                          exact_number(p.tip.z()), exact_number(p.axis.x()), exact_number(p.axis.y()),
                          exact_number(p.axis.z()));
  }
  return text;
}

Path path_from_csv(std::string_view text, const std::string& file) {
  Records in(text, file);
  const auto head = in.next();
  // The columns are read by their place: another order would be read as other numbers.
  if (!head || fmt::format("{}", fmt::join(*head, ",")) != kHead) in.refuse(fmt::format("must be \"{}\"", kHead));
  Path path;
  std::set<int> ids;
  while (const auto fields = in.next()) {
    if (fields->size() != kColumns) in.refuse(fmt::format("has {} columns; must have {}", fields->size(), kColumns));
    const double number = in.number((*fields)[0]);
    // Compared after the cast: 1.5 and 1e300 are no whole numbers.
    const int id = std::abs(number) < 1e9 ? static_cast<int>(number) : 0;
    if (id != number) in.refuse("the number of a pass must be a whole number");
    if (path.strips.empty() || path.strips.back().id != id) {
      // A strip in two parts would be joined across what lies between.
      if (!ids.insert(id).second) in.refuse(fmt::format("pass {} continues after another one", id));
      path.strips.push_back({id, (*fields)[1], (*fields)[2], {}});
    }
    path.strips.back().poses.push_back(pose_from(in, *fields));
  }
  return path;
}

}  // namespace flank::internal
