#include "flank/machine/nc/dialects/apt.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <vector>

#include "flank/error.h"
#include "flank/machine/nc/header_text.h"
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

  std::vector<NcProgram> read(std::string_view text) {
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

/// As read_nc, for a text that was not recognised as one of another language.
std::vector<NcProgram> read_apt(std::string_view text, const std::string& file, const NcDialect& dialect) {
  return AptReader(file, dialect).read(text);
}

constexpr std::size_t kWidth = 72;  // of a line, as on cards; "$" continues it
constexpr std::size_t kBytesOfMove = 90;

/// Numbers after a word, over as many lines as they need.
class Statement {
 public:
  Statement(std::string& text, std::string_view word) : text_(text), begin_(text.size()) { (text_ += word) += '/'; }
  void add(double value, int decimals) {
    const std::size_t at = text_.size();
    if (!first_) text_ += ',';
    append_decimal(text_, value, decimals);
    // The number went over the end, with two characters kept for " $": it moves to a line of its own, indented by
    // two.
    if (text_.size() - begin_ + 2 > kWidth) {
      const std::size_t value_at = at + (first_ ? 0 : 1);
      text_.insert(value_at, " $\n  ");
      begin_ = value_at + 3;
    }
    first_ = false;
  }

 private:
  std::string& text_;
  std::size_t begin_;
  bool first_ = true;
};

void go_to(std::string& text, const NcMove& move, const NcDialect& dialect) {
  Statement statement(text, "GOTO");
  for (int i = 0; i < 3; ++i) statement.add(move.position[i], dialect.length_decimals);
  for (int i = 0; i < 3; ++i) statement.add(move.orientation[i], dialect.vector_decimals);
  text += '\n';
}

/// Before the first operation.
void opening(std::string& text, const NcHeader& h) {
  text += "PARTNO " + safe_comment(h.part.empty() ? "-" : h.part) + '\n';
  // MULTAX: every GOTO has a direction of the tool beside its point.
  text += "UNITS/MM\nMULTAX/ON\n";
  text += "PPRINT " + safe_comment("PROGRAM " + h.program) + '\n';
}

void header(std::string& text, const NcProgram& program) {
  const NcHeader& h = program.header;
  const auto print = [&](const std::string& comment) { text += "PPRINT " + comment + '\n'; };
  NcHeader without_part = h;  // PARTNO has it
  without_part.part.clear();
  for (const std::string& comment : header_comments(without_part)) print(comment);
  // APT has no words for these two; our reader and people find them here.
  print("WORK OFFSET " + std::to_string(h.work_offset));
  print(program.join == NcJoin::kGreatCircle ? "JOIN GREAT CIRCLE" : "JOIN AXES");
  text += "LOADTL/" + std::to_string(h.tool.number) + '\n';
  if (h.spindle_rpm > 0.0) {  // else the header says that it is a dry run
    append_short_decimal(text += "SPINDL/", h.spindle_rpm, 3);
    text += ",CLW\n";
  }
  if (!h.coolant.empty()) text += h.coolant == "mist" ? "COOLNT/MIST\n" : "COOLNT/FLOOD\n";
}

/// A feed where it changes, or after a rapid, which is for one motion.
void feed_of(std::string& text, std::string& last, const NcMove& move, const NcDialect& dialect) {
  std::string feed = "FEDRAT/";
  append_decimal(feed, move.feed, nc_feed_decimals(NcFeedMode::kPerMinute, move.feed, dialect));
  feed += ",MMPM\n";
  if (feed == last) return;
  text += feed;
  last = std::move(feed);
}

/// A cutter location is a point and a vector: rotary axes are of a machine, which another postprocessor chooses.
void refuse_unsayable(const NcProgram& program) {
  if (program.positions != NcPositions::kTipVector)
    throw UsageError("dialect", "apt", "has tool vectors only; expected programs that state them");
  if (program.feed_mode == NcFeedMode::kInverseTime)
    throw UsageError("dialect", "apt", "has no inverse time; expected a feed in mm/min");
}

/// One operation: GOTO with the tool vector. No rotary axes, no inverse time.
void write_operation(std::string& text, const NcProgram& program, const NcDialect& dialect) {
  header(text, program);
  std::string feed;
  std::int32_t strip = -1;
  for (std::size_t i = 0; i < program.moves.size(); ++i) {
    const NcMove& m = program.moves[i];
    if (m.strip != strip)
      (text += "PPRINT ") +=
          (m.strip < 0 ? std::string(kEndOfStrip) : strip_comment(program.strips[static_cast<std::size_t>(m.strip)])) +
          '\n';
    strip = m.strip;
    // By its reference position: what lies between the two moves is no straight join.
    if (!m.joined && i > 0) text += "GOHOME\n";
    if (m.kind == NcKind::kRapid)
      text += "RAPID\n";
    else
      feed_of(text, feed, m, dialect);
    go_to(text, m, dialect);
  }
  if (!program.header.coolant.empty()) text += "COOLNT/OFF\n";
  text += "SPINDL/OFF\n";
}

/// As write_nc, for operations that passed its checks.
std::string write_apt(std::span<const NcProgram> operations, const NcDialect& dialect) {
  std::string text;
  opening(text, operations.front().header);
  for (const NcProgram& operation : operations) {
    refuse_unsayable(operation);
    text.reserve(text.size() + 1000 + kBytesOfMove * operation.moves.size());
    // The tool is changed where the machine does that.
    if (&operation != &operations.front()) text += "GOHOME\n";
    write_operation(text, operation, dialect);
  }
  return text + "FINI\n";
}

}  // namespace

constexpr NcLanguageRow kAptRow{
    .language = NcLanguage::kApt,
    .name = "apt",
    .title = kName,
    .read = read_apt,
    .write = write_apt,
    .first = {"PARTNO", "UNITS/", "MULTAX", "GOTO/", "FEDRAT/", "LOADTL/"},
};

}  // namespace flank::internal
