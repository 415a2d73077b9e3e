#include "flank/io/tool/tool_dxf_read.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "flank/error.h"
#include "flank/io/tool/profile_arcs.h"
#include "flank/io/tool/tool_dxf.h"
#include "flank/tool/meridian.h"

namespace flank::internal {

namespace {

/// Pairs of a group code and a value, each on a line of its own.
class DxfPairs {
 public:
  DxfPairs(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  /// The next pair; false at the end.
  bool next() {
    std::string_view code;
    if (!line(code)) return false;
    const auto [stop, error] = std::from_chars(code.data(), code.data() + code.size(), code_);
    if (error != std::errc() || stop != code.data() + code.size())
      refuse(line_ == 1 ? "is not an ASCII DXF, which begins with a group code"
                        : fmt::format("\"{}\" is not a group code", std::string(code.substr(0, 40))));
    if (!line(value_)) refuse("the file ends after a group code");
    return true;
  }

  [[nodiscard]] int code() const { return code_; }
  [[nodiscard]] std::string_view value() const { return value_; }
  [[nodiscard]] double number() const {
    double value = 0.0;
    const auto [stop, error] = std::from_chars(value_.data(), value_.data() + value_.size(), value);
    if (error != std::errc() || stop != value_.data() + value_.size() || !std::isfinite(value))
      refuse(fmt::format("\"{}\" is not a finite number", std::string(value_.substr(0, 40))));
    return value;
  }
  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError(fmt::format("{}: line {}: {}", file_, line_, why));
  }

 private:
  /// The next line without blanks around it.
  bool line(std::string_view& out) {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    out = text_.substr(at_, end - at_);
    at_ = end + 1;
    ++line_;
    const std::size_t first = out.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) {
      out = {};
      return at_ < text_.size();  // blank lines at the end are not a pair
    }
    out = out.substr(first, out.find_last_not_of(" \t\r") - first + 1);
    return true;
  }

  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0;
  long line_ = 0;
  int code_ = 0;
  std::string_view value_;
};

/// Of either kind, in the order of the file.
struct Polyline {
  std::string layer;
  std::vector<Vec2> points;
  std::vector<double> bulges;  ///< of what begins at each point; shorter than the points: the rest is straight

  /// A point more in the middle of every segment.
  [[nodiscard]] static std::vector<Vec2> halved(const std::vector<Vec2>& points) {
    std::vector<Vec2> more{points.front()};
    for (std::size_t k = 1; k < points.size(); ++k) {
      more.emplace_back(0.5 * (points[k - 1] + points[k]));
      more.push_back(points[k]);
    }
    return more;
  }
  /// Arcs as fine polygons.
  [[nodiscard]] std::vector<Vec2> polygon() const {
    std::vector<Vec2> all;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const bool arc = k + 1 < points.size() && k < bulges.size() && bulges[k] != 0.0;
      const std::vector<Vec2> part =
          arc ? points_of({points[k], points[k + 1], bulges[k]}, kDxfChordMm) : std::vector{points[k]};
      all.insert(all.end(), part.begin(), part.end());
    }
    if (all.size() < 4 && all.size() >= 2 && !bulges.empty())
      return halved(halved(all));  // a few lines of arcs and lines
    return all;
  }
};

/// Every polyline of the ENTITIES section.
class PolylineReader {
 public:
  PolylineReader(std::string_view text, const std::string& file) : in_(text, file) {}

  std::vector<Polyline> read() {
    std::string entity;
    bool in_entities = false, section_starts = false;
    while (in_.next()) {
      if (in_.code() == 0) {
        entity = std::string(in_.value());
        section_starts = entity == "SECTION";
        if (entity == "ENDSEC") in_entities = false;
        if (in_entities) begin(entity);
      } else if (section_starts && in_.code() == 2) {
        in_entities = in_.value() == "ENTITIES";
        section_starts = false;
      } else if (in_entities) {
        group(entity);
      }
    }
    return std::move(found_);
  }

 private:
  /// A new entity: POLYLINE is followed by VERTEX entities up to SEQEND, LWPOLYLINE holds its points itself.
  void begin(const std::string& entity) {
    if (entity == "POLYLINE" || entity == "LWPOLYLINE") {
      found_.emplace_back();
      open_ = entity == "POLYLINE";
    } else if (entity == "VERTEX" && open_) {
      found_.back().points.emplace_back(0.0, 0.0);
    } else if (entity == "SEQEND") {
      open_ = false;
    }
  }

  /// Codes: 8 layer, 10 and 20 x and y, 42 bulge.
  void group(const std::string& entity) {
    const bool light = entity == "LWPOLYLINE", vertex = entity == "VERTEX" && open_;
    if ((entity == "POLYLINE" || light) && in_.code() == 8) found_.back().layer = std::string(in_.value());
    if (!light && !vertex) return;
    if (in_.code() == 10 && light) found_.back().points.emplace_back(0.0, 0.0);
    if (found_.back().points.empty()) return;
    if (in_.code() == 10) found_.back().points.back().x() = in_.number();
    if (in_.code() == 20) found_.back().points.back().y() = in_.number();
    if (in_.code() != 42) return;
    constexpr double kMostBulge = 1.0;  // a half circle: more of one is no profile of a tool
    if (!(std::abs(in_.number()) <= kMostBulge)) in_.refuse("an arc of more than a half circle");
    found_.back().bulges.resize(found_.back().points.size(), 0.0);
    found_.back().bulges.back() = in_.number();
  }

  DxfPairs in_;
  std::vector<Polyline> found_;
  bool open_ = false;
};

}  // namespace

std::vector<Vec2> profile_from_dxf(std::string_view text, const std::string& file) {
  std::vector<Polyline> all = PolylineReader(text, file).read();
  const auto flank = std::find_if(all.begin(), all.end(), [](const Polyline& p) { return p.layer == "FLANK"; });
  if (flank == all.end() && all.size() != 1)
    throw InputError(fmt::format(
        "{}: {} polylines and none on layer FLANK; accepted is one polyline, or one on that layer", file, all.size()));
  std::vector<Vec2> points = flank != all.end() ? flank->polygon() : all.front().polygon();
  // Drawn from the holder to the tip.
  if (points.size() >= 2 && points.front().x() > points.back().x()) std::reverse(points.begin(), points.end());
  return points;
}

Tool tool_from_dxf(std::string_view text, const std::string& file, std::optional<double> axis_length) {
  const std::vector<Vec2> profile = profile_from_dxf(text, file);
  // Four points per coefficient: the spline smooths the chords of the drawing instead of following them.
  const int coefficients = std::clamp(static_cast<int>(profile.size()) / 4, 4, kDxfCoefficients);
  Tool tool;
  try {
    tool.radial = radial_from_meridian(profile, axis_length, coefficients);
  } catch (const InputError& e) {
    throw InputError(file + ": " + e.what());
  }
  if (const Legitimacy verdict = check_legitimacy(tool.radial); !verdict.legitimate)
    throw InputError(file + ": not a tool, " + verdict.reason);
  return tool;
}

}  // namespace flank::internal
