#include "flank/io/tool/dxf_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "flank/error.h"
#include "flank/io/text/dxf_pairs.h"

namespace flank::internal {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;

/// An entity whose values are numbers when they are asked for.
class Entity {
 public:
  Entity(const DxfRecord& record, const std::string& file) : record_(record), file_(file) {}

  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError(fmt::format("{}: line {}: {}: {}", file_, record_.line, record_.name, why));
  }
  [[nodiscard]] double number(const std::string& text) const {
    double value = 0.0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    // Far beyond any drawing: what is this large overflows when it is squared.
    if (error != std::errc() || stop != text.data() + text.size() || !(std::abs(value) < 1e12))
      refuse(fmt::format("\"{}\" is not a finite number", text.substr(0, 40)));
    return value;
  }
  [[nodiscard]] double number(int code, double missing) const {
    return record_.has(code) ? number(record_.text(code)) : missing;
  }
  [[nodiscard]] double needed(int code) const {
    if (!record_.has(code)) refuse(fmt::format("group {} is missing", code));
    return number(record_.text(code));
  }
  [[nodiscard]] Vec2 point(int x) const { return {needed(x), needed(x + 10)}; }
  [[nodiscard]] std::vector<double> all(int code) const {
    std::vector<double> values;
    for (const auto& [group, text] : record_.groups)
      if (group == code) values.push_back(number(text));
    return values;
  }
  [[nodiscard]] const DxfRecord& record() const { return record_; }

 private:
  const DxfRecord& record_;
  const std::string& file_;
};

/// Corners of a polyline, with the bulge of what begins at each.
struct Corner {
  Vec2 at = Vec2::Zero();
  double bulge = 0.0;
};

std::vector<ProfileArc> pieces_of(const std::vector<Corner>& corners, bool closed, const Entity& entity) {
  constexpr double kMostBulge = 1.0;  // a half circle: more of one is no profile of a tool
  std::vector<ProfileArc> pieces;
  const std::size_t count = corners.size();
  for (const Corner& corner : corners)
    if (!(std::abs(corner.bulge) <= kMostBulge)) entity.refuse("an arc of more than a half circle");
  for (std::size_t k = 0; k + (closed ? 0 : 1) < count; ++k) {
    const Corner &from = corners[k], &to = corners[(k + 1) % count];
    if (from.at != to.at) pieces.push_back({from.at, to.at, from.bulge});
  }
  return pieces;
}

std::vector<ProfileArc> light_polyline(const Entity& entity) {
  std::vector<Corner> corners;
  for (const auto& [code, text] : entity.record().groups) {
    if (code == 10) corners.push_back({{entity.number(text), 0.0}, 0.0});
    if (corners.empty()) continue;
    if (code == 20) corners.back().at.y() = entity.number(text);
    if (code == 42) corners.back().bulge = entity.number(text);
  }
  return pieces_of(corners, (static_cast<int>(entity.number(70, 0.0)) & 1) != 0, entity);
}

std::vector<ProfileArc> arc(const Entity& entity) {
  const Vec2 centre = entity.point(10);
  const double radius = entity.needed(40), from = entity.needed(50) * kRadians;
  double turn = std::fmod(entity.needed(51) * kRadians - from, 2.0 * std::numbers::pi);
  if (turn <= 0.0) turn += 2.0 * std::numbers::pi;
  if (!(radius > 0.0)) entity.refuse("the radius must be > 0");
  // Halves: a bulge of more than a half circle is hard to work with.
  std::vector<ProfileArc> pieces;
  const auto at = [&](double angle) -> Vec2 { return centre + radius * Vec2(std::cos(angle), std::sin(angle)); };
  const int count = turn > 0.9 * std::numbers::pi ? 2 : 1;
  for (int k = 0; k < count; ++k)
    pieces.push_back({at(from + turn * k / count), at(from + turn * (k + 1) / count), std::tan(0.25 * turn / count)});
  return pieces;
}

/// A rational B-spline as the file states it.
struct Spline {
  int degree = 0;
  std::vector<double> knots;
  std::vector<std::array<double, 3>> points;  ///< weighted: w x, w y, w

  /// By de Boor's algorithm, in the knot span [knots[span], knots[span + 1]].
  [[nodiscard]] Vec2 at(double t, std::size_t span) const {
    const auto p = static_cast<std::size_t>(degree);
    std::vector<std::array<double, 3>> d(points.begin() + static_cast<long>(span - p),
                                         points.begin() + static_cast<long>(span + 1));
    for (std::size_t r = 1; r <= p; ++r)
      for (std::size_t j = p; j >= r; --j) {
        const double low = knots[j + span - p], high = knots[j + 1 + span - r];
        const double a = high > low ? (t - low) / (high - low) : 0.0;
        for (std::size_t k = 0; k < 3; ++k) d[j][k] = (1.0 - a) * d[j - 1][k] + a * d[j][k];
      }
    return Vec2(d[p][0], d[p][1]) / d[p][2];
  }
};

Spline spline_of(const Entity& entity) {
  Spline spline;
  spline.degree = static_cast<int>(entity.number(71, 0.0));
  spline.knots = entity.all(40);
  const std::vector<double> x = entity.all(10), y = entity.all(20), w = entity.all(41);
  constexpr int kMostDegree = 11;
  if (x.empty()) entity.refuse("has fit points only; expected control points");
  if (spline.degree < 1 || spline.degree > kMostDegree || x.size() != y.size() ||
      spline.knots.size() != x.size() + static_cast<std::size_t>(spline.degree) + 1 ||
      x.size() <= static_cast<std::size_t>(spline.degree))
    entity.refuse("degree, knots and control points do not belong together");
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double weight = k < w.size() ? w[k] : 1.0;
    if (!(weight > 0.0)) entity.refuse("a weight must be > 0");
    spline.points.push_back({weight * x[k], weight * y[k], weight});
  }
  for (std::size_t k = 1; k < spline.knots.size(); ++k)
    if (spline.knots[k] < spline.knots[k - 1]) entity.refuse("its knots fall");
  return spline;
}

std::vector<ProfileArc> spline_pieces(const Entity& entity) {
  const Spline spline = spline_of(entity);
  std::vector<Vec2> points;
  for (auto k = static_cast<std::size_t>(spline.degree); k < spline.points.size(); ++k) {
    const double low = spline.knots[k], high = spline.knots[k + 1];
    if (!(high > low)) continue;
    for (int i = points.empty() ? 0 : 1; i <= kSplinePieces; ++i)
      points.push_back(spline.at(low + (high - low) * i / kSplinePieces, k));
  }
  std::vector<ProfileArc> pieces;
  for (std::size_t k = 1; k < points.size(); ++k)
    if (points[k] != points[k - 1]) pieces.push_back({points[k - 1], points[k], 0.0});
  return pieces;
}

std::string capitals(std::string text) {
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

/// Units to mm, and what an extrusion along -z mirrors. The coordinates of lines and splines are those of the world.
void place(const DxfRecord& record, double unit, std::vector<ProfileArc>& pieces, const Entity& entity) {
  const bool flat = record.name != "LINE" && record.name != "SPLINE";
  const double side = flat && entity.number(230, 1.0) < 0.0 ? -1.0 : 1.0;
  for (ProfileArc& piece : pieces) {
    piece.from = {side * unit * piece.from.x(), unit * piece.from.y()};
    piece.to = {side * unit * piece.to.x(), unit * piece.to.y()};
    piece.bulge *= side;
  }
}

/// The lines and arcs of the entity at `at`; a POLYLINE's vertices follow it, and `at` goes on to the last of them.
std::vector<ProfileArc> entity_pieces(const DxfContent& content, std::size_t& at, const std::string& file) {
  const Entity entity(content.entities[at], file);
  const std::string& name = entity.record().name;
  if (name == "LINE") return {{entity.point(10), entity.point(11), 0.0}};
  if (name == "ARC") return arc(entity);
  if (name == "LWPOLYLINE") return light_polyline(entity);
  if (name == "SPLINE") return spline_pieces(entity);
  if (name == "ELLIPSE") entity.refuse("draw the profile with lines, arcs, polylines or splines");
  if (name != "POLYLINE") return {};
  std::vector<Corner> corners;
  while (at + 1 < content.entities.size() && content.entities[at + 1].name == "VERTEX") {
    const Entity vertex(content.entities[++at], file);
    corners.push_back({{vertex.number(10, 0.0), vertex.number(20, 0.0)}, vertex.number(42, 0.0)});
  }
  return pieces_of(corners, (static_cast<int>(entity.number(70, 0.0)) & 1) != 0, entity);
}

}  // namespace

std::vector<DxfCurve> read_dxf_curves(std::string_view text, const std::string& file) {
  const DxfContent content = read_dxf(text, file);
  std::vector<DxfCurve> curves;
  for (std::size_t k = 0; k < content.entities.size(); ++k) {
    const DxfRecord& record = content.entities[k];
    const Entity entity(record, file);
    std::vector<ProfileArc> pieces = entity_pieces(content, k, file);
    if (record.text(67, "0") == "1") continue;  // the paper's frame and title block
    if (pieces.empty() && record.name != "POLYLINE" && record.name != "LWPOLYLINE") continue;
    place(record, content.unit_mm, pieces, entity);
    curves.push_back({record.name, record.text(8), capitals(record.text(6)), std::move(pieces)});
  }
  return curves;
}

}  // namespace flank::internal
