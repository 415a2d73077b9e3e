#include "flank/io/path/path_cls_read.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <set>
#include <vector>

#include "flank/error.h"
#include "flank/io/path/path_cls.h"
#include "flank/path_file.h"

namespace flank::internal {

namespace {

/// Motion or a change of frame that a list of points cannot hold.
constexpr std::array<std::string_view, 11> kRefused = {"CIRCLE", "CYCLE", "GODLTA", "TRACUT", "COPY",  "GOFWD",
                                                       "GOLFT",  "GORGT", "GOBACK", "ORIGIN", "MOVARC"};

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string_view::npos ? std::string() : std::string(text.substr(first, last - first + 1));
}

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// Statements of an APT text: `$` at the end of a line continues it, `$$` starts a comment.
class Statements {
 public:
  Statements(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  /// The next statement that is not empty; false at the end.
  bool next() {
    statement_.clear();
    bool open = false;
    while (at_ < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', at_), text_.size());
      std::string_view line = text_.substr(at_, end - at_);
      at_ = end + 1;
      ++line_;
      // A binary file given by mistake.
      if (line.find('\0') != std::string_view::npos) refuse("is not text");
      line = line.substr(0, line.find("$$"));
      std::string piece = trimmed(line);
      const bool goes_on = !piece.empty() && piece.back() == '$';
      if (goes_on) piece = trimmed(std::string_view(piece).substr(0, piece.size() - 1));
      statement_ += piece;
      open = goes_on;
      if (!goes_on && !statement_.empty()) return true;
    }
    if (open) refuse("the file ends within a statement");
    return !statement_.empty();
  }

  /// The word before the slash (or the first blank), in capitals.
  [[nodiscard]] std::string word() const {
    return upper(trimmed(statement_.substr(0, statement_.find_first_of("/ \t"))));
  }
  /// What follows the word.
  [[nodiscard]] std::string rest() const {
    const std::size_t end = statement_.find_first_of("/ \t");
    if (end == std::string::npos) return {};
    const std::string after = trimmed(std::string_view(statement_).substr(end));
    return after.front() == '/' ? trimmed(std::string_view(after).substr(1)) : after;
  }

  [[nodiscard]] std::vector<double> numbers() const {
    std::vector<double> values;
    const std::string list = rest();
    for (std::size_t at = 0; at <= list.size();) {
      const std::size_t end = std::min(list.find(',', at), list.size());
      std::string item = trimmed(std::string_view(list).substr(at, end - at));
      if (!item.empty() && item.front() == '+') item.erase(0, 1);
      double value = 0.0;
      const char* last = item.data() + item.size();
      const auto [stop, error] = std::from_chars(item.data(), last, value);
      if (error != std::errc() || stop != last || !std::isfinite(value))
        refuse(fmt::format("\"{}\" is not a finite number", item));
      values.push_back(value);
      at = end + 1;
    }
    return values;
  }

  /// Names the line where the statement ends.
  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError(fmt::format("{}: line {}: {}", file_, line_, why));
  }

 private:
  std::string_view text_;
  std::string file_, statement_;
  std::size_t at_ = 0;
  long line_ = 0;
};

/// The state of a cutter-location file: unit, whether a rapid move is under way, and the strip that is open.
class Reader {
 public:
  Reader(std::string_view text, const std::string& file) : in_(text, file), file_(file) {}

  Path read() {
    while (in_.next() && in_.word() != "FINI") take();
    // A strip may be named and hold nothing, e.g. where all of its moves are rapid.
    std::erase_if(path_.strips, [](const Strip& s) { return s.poses.empty(); });
    if (!seen_motion_) throw InputError(file_ + ": contains no GOTO; expected an APT cutter-location file");
    return std::move(path_);
  }

 private:
  /// Words that are not listed (FEDRAT, SPINDL, LOADTL, ...) do not move the tool.
  void take() {
    const std::string word = in_.word();
    if (word == "GOTO")
      take_motion();
    else if (word == "RAPID")
      rapid_ = true;
    else if (word == "UNITS")
      take_units();
    else if (word == "PPRINT")
      take_print();
    else if (std::find(kRefused.begin(), kRefused.end(), word) != kRefused.end())
      in_.refuse(word + " is not supported; expected points, GOTO/x,y,z,i,j,k");
  }

  void take_units() {
    const std::string unit = upper(in_.rest());
    if (unit == "MM")
      scale_ = 1.0;
    else if (unit == "INCHES" || unit == "INCH" || unit == "IN")
      scale_ = 25.4;
    else
      in_.refuse(fmt::format("UNITS/{}: expected MM or INCHES", unit));
  }

  /// PPRINT STRIP id kind face
  void take_print() {
    std::vector<std::string> words;
    const std::string rest = in_.rest();
    for (std::size_t at = 0; at < rest.size();) {
      const std::size_t end = std::min(rest.find(' ', at), rest.size());
      if (end > at) words.push_back(rest.substr(at, end - at));
      at = end + 1;
    }
    if (words.size() < 3 || words[0] != "STRIP") return;
    int id = 0;
    const char* last = words[1].data() + words[1].size();
    if (const auto [stop, error] = std::from_chars(words[1].data(), last, id); error != std::errc() || stop != last)
      in_.refuse(fmt::format("pass number (STRIP) \"{}\" is not a whole number", words[1]));
    // Reports name strips by these numbers.
    if (!ids_.insert(id).second) in_.refuse(fmt::format("pass {} (STRIP) occurs twice", id));
    path_.strips.push_back({id, words[2], words.size() > 3 ? words[3] : "", {}});
    named_ = true;
  }

  /// Without names, what lies between two rapid moves is a strip.
  void take_motion() {
    seen_motion_ = true;
    const std::vector<double> v = in_.numbers();
    if (v.size() != 3 && v.size() != 6) in_.refuse("GOTO has 3 or 6 numbers");
    Pose pose{scale_ * Vec3(v[0], v[1], v[2]), Vec3::UnitZ()};
    if (!pose.tip.allFinite()) in_.refuse("the point is not finite in millimetres");
    if (v.size() == 6) pose.axis = Vec3(v[3], v[4], v[5]);
    const double length = pose.axis.norm();
    if (!(std::abs(length - 1.0) <= kAxisLengthRounded))
      in_.refuse(fmt::format("the axis vector i, j, k has length {}; must be 1", length));
    if (std::abs(length - 1.0) > kAxisLengthExact) pose.axis /= length;
    // RAPID holds for one motion.
    const bool link = rapid_;
    rapid_ = false;
    // Our own files name their links, whose rapid moves belong to the path; in others a rapid move is the way between
    // two strips.
    const bool keeps_links = named_ && !path_.strips.empty() && path_.strips.back().kind == "link";
    if (link && !keeps_links) {
      open_ = false;
      return;
    }
    if (!named_ && !open_) {
      const int id = static_cast<int>(path_.strips.size()) + 1;
      ids_.insert(id);
      path_.strips.push_back({id, "flank", "", {}});
    }
    open_ = true;
    path_.strips.back().poses.push_back(pose);
  }

  Statements in_;
  std::string file_;
  Path path_;
  std::set<int> ids_;
  double scale_ = 1.0;
  bool rapid_ = false, named_ = false, open_ = false, seen_motion_ = false;
};

}  // namespace

Path path_from_cls(std::string_view text, const std::string& file) { return Reader(text, file).read(); }

}  // namespace flank::internal
