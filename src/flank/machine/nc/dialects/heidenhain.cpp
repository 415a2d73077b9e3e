#include "flank/machine/nc/dialects/heidenhain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "flank/machine/nc/nc_number.h"
#include "flank/machine/nc/read/program_builder.h"
#include "flank/machine/nc/without_effect.h"
#include "flank/machine/nc/write/write_heidenhain.h"

namespace flank::internal {

namespace {

constexpr std::string_view kName = "Heidenhain";
constexpr double kInch = 25.4;

using Words = std::vector<std::string_view>;

/// Words between spaces; a comment, from a semicolon on, is none of them.
void split_words(std::string_view line, Words& words) {
  words.clear();
  line = line.substr(0, line.find(';'));
  for (std::size_t i = line.find_first_not_of(" \t"); i != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(" \t", i), line.size());
    words.push_back(line.substr(i, end - i));
    i = line.find_first_not_of(" \t", end);
  }
}

bool is_number(std::string_view word) {
  return !word.empty() && std::all_of(word.begin(), word.end(), [](char c) { return c >= '0' && c <= '9'; });
}

class HeidenhainReader {
 public:
  HeidenhainReader(const std::string& file, const NcDialect& dialect) : builder_(file, dialect), dialect_(dialect) {
    builder_.change_at_call(true);  // TOOL CALL changes the tool
    // The control always compensates the tool's length: without M128 or TCPM its coordinates are neither joints nor
    // the tip.
    builder_.allow_joint(false);
  }

  std::vector<NcProgram> read(std::string_view text) {
    NcLines lines(text);
    while (lines.next()) {
      builder_.at(lines.number());
      const std::size_t comment = lines.line().find(';');
      if (comment != std::string_view::npos) builder_.comment(lines.line().substr(comment + 1));
      joined_.clear();
      split_words(lines.upper(), words_);
      if (words_.size() > kMostNcWords) builder_.place().refuse("a block of more than 100 words");
      // "~" continues a cycle's definition on the next line: its parameters stand one by one in lines of their own.
      const bool continued = continues_;
      continues_ = !words_.empty() && words_.back().ends_with('~');
      if (continues_) drop_tilde();
      // The block's number; a continued line has none, and a number in it would be a value.
      if (!continued && !words_.empty() && is_number(words_.front())) words_.erase(words_.begin());
      if (skips()) continue;
      // "* - text" is a headline of the program's structure, for people.
      if (words_.empty() || words_.front().starts_with('*')) continue;
      if (continued)
        cycle_parameters(0);
      else
        block(lines.line());
    }
    return builder_.finish();
  }

 private:
  /// A block that begins with / may be left out, and is accepted where that is the same.
  bool skips() {
    if (words_.empty() || words_.front().front() != '/') return false;
    words_.front().remove_prefix(1);
    if (words_.front().empty()) words_.erase(words_.begin());
    for (const std::string_view w : words_)
      if (w != "STOP" && w != "M0" && w != "M1" && w != "M8" && w != "M9" && !is_ignored(w))
        builder_.place().refuse(quoted(w) +
                                " stands in a block that may be skipped (/); only words without effect on "
                                "the motion may stand there");
    return true;
  }

  /// Whether the machine's file says that a word moves nothing.
  [[nodiscard]] bool is_ignored(std::string_view w) const {
    if (is_without_effect(dialect_, w)) return true;
    const auto number = w.size() > 1 ? leading_number(w.substr(1), true) : std::nullopt;
    return number && number->length + 1 == w.size() && is_without_effect(dialect_, w[0], number->value);
  }

  /// Whether it says so of the whole block, as of "PLANE RESET STAY".
  [[nodiscard]] bool is_block_ignored() const {
    std::string text;
    for (const std::string_view w : words_) (text += text.empty() ? "" : " ") += w;
    return is_without_effect(dialect_, text);
  }

  void drop_tilde() {
    words_.back().remove_suffix(1);
    if (words_.back().empty()) words_.pop_back();
  }

  [[noreturn]] void refuse(std::string_view word) const { builder_.place().refuse_word(word, kName); }
  [[nodiscard]] std::string_view word(std::size_t i) const {
    return i < words_.size() ? words_[i] : std::string_view{};
  }

  /// The number that a word consists of behind its address.
  [[nodiscard]] double value(std::string_view word, std::size_t address) const {
    const auto number = leading_number(word.substr(address), true);
    if (!number || address + number->length != word.size()) refuse(word);
    return number->value;
  }
  [[nodiscard]] int whole(std::string_view word, std::size_t address) const {
    const double v = value(word, address);
    if (v < 0.0 || v > 1e6 || v != std::floor(v)) refuse(word);
    return static_cast<int>(v);
  }

  /// One block by its first word. `line` is as it was written, for names in their own letters.
  void block(std::string_view line) {
    const std::string_view first = word(0);
    if (finished_) builder_.place().refuse("a block after the end of the program");
    if (first == "BEGIN" || first == "END") return frame(line);
    if (!begun_) builder_.place().refuse(quoted(first) + " before BEGIN PGM");
    // Behind M2 or M30 only END PGM may follow; behind END PGM nothing.
    if (builder_.ended()) builder_.place().refuse("a block after the end of the program");
    if (first == "TOOL")
      tool(line);
    else if (first == "CYCL")
      cycle();
    else if (first == "FUNCTION")
      function();
    else if (first == "L" || first == "LN" || first.starts_with('M'))
      motion();
    else if (first != "BLK" && first != "STOP" && !is_block_ignored())
      refuse(first);
  }

  /// BEGIN PGM NAME MM ... END PGM NAME MM.
  void frame(std::string_view line) {
    if (word(1) != "PGM") refuse(word(0));
    if (word(0) == "END") {
      builder_.end_program();
      finished_ = true;
      return;
    }
    if (begun_) builder_.place().refuse("BEGIN PGM a second time");
    if (word(3) != "MM" && word(3) != "INCH") builder_.place().refuse("BEGIN PGM needs a name, and MM or INCH");
    begun_ = true;
    builder_.unit(word(3) == "MM" ? 1.0 : kInch);
    // The name in its own letters: words_ is in upper case, and may have lost its block number.
    Words as_written;
    split_words(line, as_written);
    const auto name = std::find(words_.begin(), words_.end(), "PGM") - words_.begin() + 1;
    builder_.header().program = as_written[as_written.size() - words_.size() + static_cast<std::size_t>(name)];
  }

  /// TOOL CALL by number or by name in quotes, with its spindle speed; TOOL DEF only readies the next tool.
  void tool(std::string_view line) {
    if (word(1) == "DEF") return;
    if (word(1) != "CALL") refuse(word(0));
    std::size_t i = 2;
    if (word(2).starts_with('"')) {
      const std::size_t from = line.find('"') + 1, to = line.find('"', from);
      if (to == std::string_view::npos) builder_.place().refuse("a name is not closed");
      // What is called, not what a comment says, is the program's tool.
      builder_.header().tool.name = line.substr(from, to - from);
      builder_.call_tool(line.substr(from, to - from));
      // A name with spaces was split into words: all up to the closing quote belong to it.
      while (i < words_.size() && !words_[i++].ends_with('"')) {
      }
    } else if (is_number(word(2))) {
      builder_.call_tool(whole(word(2), 0));
      i = 3;
    }
    for (; i < words_.size(); ++i) tool_word(words_[i]);
  }

  /// Oversizes of the tool move its point; a program that has them means another tool than it names.
  void tool_word(std::string_view w) {
    if (w.starts_with('S'))
      builder_.spindle_speed(std::max(0.0, value(w, 1)));
    else if (w.starts_with("DL") || w.starts_with("DR")) {
      if (value(w, 2) != 0.0) builder_.place().refuse(quoted(w) + " is an oversize of the tool; expected none");
    } else if (w != "Z" && !w.starts_with('F'))
      refuse(w);  // among them another axis of the tool, which would turn the program's coordinate system
  }

  /// Cycle 247 presets the datum, cycle 32 bounds the control's own smoothing; any other would move or cut.
  void cycle() {
    if (word(1) != "DEF") refuse(word(1).empty() ? word(0) : word(1));
    const std::string_view number = word(2);
    if (number == "247")
      cycle_parameters(3);
    else if (!number.starts_with("32."))
      refuse(number);
  }

  /// Parameters of the cycle that presets the datum; its words in a language of the operator say nothing.
  void cycle_parameters(std::size_t from) {
    for (std::size_t i = from; i < words_.size(); ++i)
      if (words_[i].starts_with("Q339=")) {
        const int preset = whole(words_[i], 5);
        if (preset < 1) refuse(words_[i]);
        builder_.work_offset(preset);
      } else if (words_[i].starts_with('Q')) {
        refuse(words_[i]);
      }
  }

  void function() {
    if (word(1) == "RESET" && word(2) == "TCPM" && words_.size() == 3) return builder_.tool_centre(false);
    if (word(1) != "TCPM") refuse(word(1).empty() ? word(0) : word(1));
    const auto one_of = [&](std::size_t i, std::string_view key, std::string_view a, std::string_view b) {
      if (word(i) != key || (word(i + 1) != a && word(i + 1) != b))
        builder_.place().refuse("FUNCTION TCPM is accepted as F TCP AXIS POS|SPAT PATHCTRL AXIS|VECTOR REFPNT TIP-TIP");
      return word(i + 1) == a;
    };
    // F TCP: the feed is that of the controlled point; the other setting, F CONT, counts the rotary axes in.
    (void)one_of(2, "F", "TCP", "TCP");
    // With SPAT, angles of L blocks are of the coordinate system, not of the machine's axes: harmless with LN,
    // refused there.
    spatial_ = !one_of(4, "AXIS", "POS", "SPAT");
    builder_.join(one_of(6, "PATHCTRL", "AXIS", "VECTOR") ? NcJoin::kAxes : NcJoin::kGreatCircle);
    // Another reference point (the ball's centre) would shift every position by the tip's radius.
    if (words_.size() > 8) (void)one_of(8, "REFPNT", "TIP-TIP", "TIP-TIP");
    if (words_.size() > 10) refuse(word(10));
    builder_.tool_centre(true);
  }

  /// M128 holds from the beginning of its block, M129 and the end of the program from its end.
  void motion() {
    const bool switches = std::find(words_.begin(), words_.end(), "M128") != words_.end();
    if (switches) {
      builder_.join(NcJoin::kAxes);
      spatial_ = false;
      builder_.tool_centre(true);
    }
    // L always runs at a feed; FMAX makes it rapid for its block alone (motion_word).
    builder_.motion(NcKind::kFeed);
    join_blanks();
    bool off = false, end = false, of_m128 = false;
    for (std::size_t i = word(0).starts_with('M') ? 0 : 1; i < words_.size(); ++i) {
      const std::string_view w = words_[i];
      if (w == "M128") {
        of_m128 = true;
      } else if (w == "M129") {
        off = true;
      } else if (w == "M2" || w == "M30" || w == "M02") {
        end = true;
      } else if (of_m128 && w.starts_with('F')) {
        of_m128 = false;  // the largest feed of the control's own compensation
      } else {
        motion_word(w);
      }
    }
    builder_.end_block();
    if (off) builder_.tool_centre(false);
    if (end) builder_.end_program();
  }

  /// "X -16,3" is one word to the control: an address without its number takes the next one.
  void join_blanks() {
    for (std::size_t i = 1; i + 1 < words_.size(); ++i) {
      const std::string_view w = words_[i], next = words_[i + 1];
      const bool address = (w.size() == 1 && std::string_view("XYZABCF").find(w[0]) != std::string_view::npos) ||
                           (w.size() == 2 && (w[0] == 'T' || w[0] == 'N') && w[1] >= 'X' && w[1] <= 'Z');
      if (!address || !leading_number(next, true)) continue;
      joined_.emplace_back(std::string(w) + std::string(next));
      words_[i] = joined_.back();
      words_.erase(words_.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    }
  }

  void motion_word(std::string_view w) {
    const char c = w[0];
    if (c == 'M') {
      miscellaneous(w);
    } else if (c >= 'X' && c <= 'Z') {
      builder_.linear(static_cast<std::size_t>(c - 'X'), value(w, 1));
    } else if (c >= 'A' && c <= 'C') {
      if (spatial_ && word(0) == "L") builder_.place().refuse(quoted(w) + " is a spatial angle; expected AXIS POS");
      builder_.rotary(c, value(w, 1));
    } else if ((c == 'T' || c == 'N') && word(0) == "LN" && w.size() > 2 && w[1] >= 'X' && w[1] <= 'Z') {
      const double v = value(w, 2);  // normals matter to a radius compensation only
      if (c == 'T') builder_.vector(static_cast<std::size_t>(w[1] - 'X'), v);
    } else if (w == "FMAX") {
      builder_.rapid();
    } else if (c == 'F') {
      builder_.feed(value(w, 1));
    } else if (w != "R0") {
      refuse(w);
    }
  }

  /// M words that move nothing, and those whose coordinates are the machine's (M91, M92) or that retract to its limit
  /// (M140 MB MAX).
  void miscellaneous(std::string_view w) {
    if (w == "MB") return;
    if (w == "MAX") {
      // "MB MAX" are two words here; the second means something behind M140 only.
      if (std::find(words_.begin(), words_.end(), "M140") == words_.end()) refuse(w);
      return;
    }
    switch (whole(w, 1)) {
      case 3:
      case 4:
      case 13:
      case 14:
        builder_.spindle_turns(true);
        break;
      case 5:
        builder_.spindle_turns(false);
        break;
      case 0:
      case 1:
      case 7:
      case 8:
      case 9:
      case 126:
      case 127:
        break;
      case 91:
      case 92:
      case 140:
        builder_.to_reference();
        break;
      default:
        if (!is_ignored(w)) refuse(w);
    }
  }

  ProgramBuilder builder_;
  const NcDialect& dialect_;
  Words words_;
  std::deque<std::string> joined_;  ///< of the present block: words that stood apart
  bool begun_ = false, finished_ = false, continues_ = false, spatial_ = false;
};

/// As read_nc, for a text that was not recognised as one of another language.
std::vector<NcProgram> read_heidenhain(std::string_view text, const std::string& file, const NcDialect& dialect) {
  return HeidenhainReader(file, dialect).read(text);
}

}  // namespace

constexpr NcLanguageRow kHeidenhainRow{
    .language = NcLanguage::kHeidenhain,
    .name = "heidenhain",
    .title = kName,
    .read = read_heidenhain,
    .write = write_heidenhain,
    .first = {"BEGIN PGM"},
    .anywhere = {"TOOL CALL", "FUNCTION TCPM", "FMAX", "M128"},
    .inverse_time = false,
};

}  // namespace flank::internal
