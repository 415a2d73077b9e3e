#include "flank/machine/nc/read/read_apt.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "flank/machine/nc/nc_number.h"
#include "flank/machine/nc/read/program_builder.h"

namespace flank::internal {

namespace {

constexpr std::string_view kName = "APT";
constexpr double kInch = 25.4;
/// Statements that move nothing and change no meaning of what follows.
constexpr std::array<std::string_view, 7> kIgnored = {"CUTTER", "COOLNT", "MACHIN", "INTOL",
                                                      "OUTTOL", "REMARK", "MULTAX"};

class AptReader {
 public:
  AptReader(const std::string& file, const NcDialect& dialect) : builder_(file, dialect) {
    // A cutter location states a direction and no machine: between two of them only the great circle is the same for
    // every machine. "PPRINT JOIN AXES" says otherwise.
    builder_.join(NcJoin::kGreatCircle);
    // GOTO is about the tool's point from the first statement on.
    builder_.tool_centre(true);
    builder_.change_at_call(true);  // LOADTL changes the tool
    // Without MULTAX, and until a GOTO states a vector, the tool stands along Z.
    for (std::size_t i = 0; i < 3; ++i) axis_[i] = i == 2 ? 1.0 : 0.0;
  }

  NcProgram read(std::string_view text) {
    NcLines lines(text);
    while (lines.next()) {
      const std::string_view line = trimmed(lines.line());
      // Complaints about a statement name its first line.
      if (statement_.empty()) builder_.at(lines.number());
      // Texts hold what they like; other statements end at "$$" and go on behind "$".
      if (statement_.empty() && text_statement(line)) continue;
      std::string_view code = trimmed(line.substr(0, line.find("$$")));
      const bool continues = code.ends_with('$');
      if (continues) code.remove_suffix(1);
      statement_ += upper_case(trimmed(code));
      if (continues) continue;
      if (!statement_.empty()) statement();
      statement_.clear();
    }
    if (!statement_.empty()) builder_.place().refuse("the statement goes on, and the file ends");
    return builder_.finish();
  }

 private:
  /// Takes PARTNO, PPRINT and REMARK, whose text begins in column 7 and may hold any sign that ends or splits others.
  bool text_statement(std::string_view line) {
    const std::string upper = upper_case(line.substr(0, 6));
    if (upper != "PARTNO" && upper != "PPRINT" && upper != "REMARK") return false;
    if (builder_.ended()) builder_.place().refuse("a statement after FINI");
    const std::string_view text = trimmed(line.substr(6));
    // "-" is what our own writer puts where the part has no name.
    if (upper == "PARTNO" && text != "-") builder_.header().part = text;
    if (upper == "PPRINT") print(text);
    return true;
  }

  /// PPRINT carries what APT has no word for: the work offset, the way in which blocks are joined, and our comments.
  void print(std::string_view text) {
    constexpr std::string_view kOffset = "WORK OFFSET ";
    const auto number = text.starts_with(kOffset) ? leading_number(text.substr(kOffset.size())) : std::nullopt;
    // With more behind it, it is the comment of a header.
    const bool alone = number && kOffset.size() + number->length == text.size();
    if (alone && number->value >= 1.0 && number->value <= 99.0)
      builder_.work_offset(static_cast<int>(number->value));
    else if (text == "JOIN AXES")
      builder_.join(NcJoin::kAxes);
    else if (text != "JOIN GREAT CIRCLE")
      builder_.comment(text);
  }

  /// "WORD/a,b,c" into the word and its parameters.
  void statement() {
    if (builder_.ended()) builder_.place().refuse("a statement after FINI");
    const std::string_view all = statement_;
    const std::size_t slash = std::min(all.find('/'), all.size());
    const std::string_view word = trimmed(all.substr(0, slash));
    parameters_.clear();
    for (std::size_t at = slash + 1; at <= all.size();) {
      const std::size_t comma = std::min(all.find(',', at), all.size());
      parameters_.push_back(trimmed(all.substr(at, comma - at)));
      at = comma + 1;
    }
    perform(word);
  }

  void perform(std::string_view word) {
    if (word == "GOTO" || word == "FROM") {
      go_to(word == "FROM");
    } else if (word == "RAPID") {
      rapid_ = true;
    } else if (word == "GOHOME") {
      builder_.to_reference();
      builder_.end_block();
    } else if (word == "FEDRAT") {
      feed_rate();
    } else if (word == "UNITS") {
      units();
    } else if (word == "SPINDL") {
      spindle();
    } else if (word == "LOADTL") {
      const double number = parameters_.empty() ? -1.0 : value(parameters_[0]);
      if (number < 0.0 || number > 1e6) refuse(statement_);
      builder_.call_tool(static_cast<int>(number));
    } else if (word == "FINI") {
      builder_.end_program();
    } else if (std::find(kIgnored.begin(), kIgnored.end(), word) == kIgnored.end()) {
      refuse(word);
    }
  }

  /// Names the word, or a whole statement, as none of the subset.
  [[noreturn]] void refuse(std::string_view word) const { builder_.place().refuse_word(word, kName); }

  [[nodiscard]] double value(std::string_view parameter) const {
    const auto number = leading_number(parameter);
    if (!number || number->length != parameter.size()) refuse(parameter);
    return number->value;
  }

  void go_to(bool from) {
    if (parameters_.size() != 3 && parameters_.size() != 6)
      builder_.place().refuse("a point has three coordinates, and three components of the tool vector under MULTAX");
    for (std::size_t i = 0; i < 3; ++i) builder_.linear(i, value(parameters_[i]));
    if (parameters_.size() == 6)
      for (std::size_t i = 0; i < 3; ++i) axis_[i] = value(parameters_[3 + i]);
    for (std::size_t i = 0; i < 3; ++i) builder_.vector(i, axis_[i]);
    // Every GOTO cuts, unless RAPID stands before it: RAPID is for one motion only. FROM says where the tool
    // is, and cuts nothing.
    builder_.motion(NcKind::kFeed);
    if (rapid_ || from) builder_.rapid();
    rapid_ = false;
    builder_.end_block();
  }

  void feed_rate() {
    double feed = 0.0;
    for (const std::string_view p : parameters_) {
      if (p == "MMPM" || p == "IPM") {
        // The builder knows one unit, which it applies to coordinates and feeds alike.
        if ((p == "IPM") != (unit_ == kInch))
          builder_.place().refuse("the feed and the coordinates have different units");
      } else {
        feed = value(p);
      }
    }
    builder_.feed(feed);
    builder_.end_block();
  }

  void units() {
    const std::string_view name = parameters_.empty() ? std::string_view{} : parameters_[0];
    if (name != "MM" && name != "INCHES" && name != "INCH") refuse(statement_);
    unit_ = name == "MM" ? 1.0 : kInch;
    builder_.unit(unit_);
  }

  void spindle() {
    for (const std::string_view p : parameters_) {
      // The number may stand before or behind the words.
      if (p == "OFF") return builder_.spindle_turns(false);
      builder_.spindle_turns(true);
      if (p == "CLW" || p == "CCLW" || p == "ON" || p == "RPM") continue;
      if (const double speed = value(p); speed >= 0.0) builder_.spindle_speed(speed);
    }
  }

  ProgramBuilder builder_;
  std::string statement_;
  std::vector<std::string_view> parameters_;
  std::array<double, 3> axis_{};
  double unit_ = 1.0;
  bool rapid_ = false;
};

}  // namespace

NcProgram read_apt(std::string_view text, const std::string& file, const NcDialect& dialect) {
  return AptReader(file, dialect).read(text);
}

}  // namespace flank::internal
