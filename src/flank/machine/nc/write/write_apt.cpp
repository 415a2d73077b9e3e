#include "flank/machine/nc/write/write_apt.h"

#include <initializer_list>

#include "flank/error.h"
#include "flank/machine/nc/header_text.h"
#include "flank/machine/nc/nc_number.h"

namespace flank::internal {

namespace {

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

void header(std::string& text, const NcProgram& program) {
  const NcHeader& h = program.header;
  const auto print = [&](const std::string& comment) { text += "PPRINT " + comment + '\n'; };
  text += "PARTNO " + safe_comment(h.part.empty() ? "-" : h.part) + '\n';
  // MULTAX: every GOTO has a direction of the tool beside its point.
  text += "UNITS/MM\nMULTAX/ON\n";
  print(safe_comment("PROGRAM " + h.program));
  NcHeader without_part = h;  // PARTNO has it
  without_part.part.clear();
  for (const std::string& comment : header_comments(without_part)) print(comment);
  // APT has no words for these two; our reader and people find them here.
  print("WORK OFFSET " + std::to_string(h.work_offset));
  print(program.join == NcJoin::kGreatCircle ? "JOIN GREAT CIRCLE" : "JOIN AXES");
  text += "LOADTL/" + std::to_string(h.tool.number) + '\n';
  if (h.spindle_rpm <= 0.0) return;  // the header says that it is a dry run
  append_short_decimal(text += "SPINDL/", h.spindle_rpm, 3);
  text += ",CLW\n";
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
    throw UsageError("dialect", "apt", "has tool vectors only; accepted are programs that state them");
  if (program.feed_mode == NcFeedMode::kInverseTime)
    throw UsageError("dialect", "apt", "has no inverse time; accepted is a feed in mm/min");
}

}  // namespace

std::string write_apt(const NcProgram& program, const NcDialect& dialect) {
  refuse_unsayable(program);
  std::string text, feed;
  text.reserve(1000 + kBytesOfMove * program.moves.size());
  header(text, program);
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
  return text + "SPINDL/OFF\nFINI\n";
}

}  // namespace flank::internal
