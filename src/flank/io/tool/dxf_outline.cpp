#include "flank/io/tool/dxf_outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "flank/error.h"

namespace flank::internal {
namespace {

using Chain = std::vector<ProfileArc>;

constexpr double kMeetMm = 2e-3;       ///< ends that are no farther apart are one: drawings are rounded
constexpr double kDxfCornerRad = 0.1;  ///< a flank that bends by more at one point ends there

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

ProfileArc reversed(const ProfileArc& piece) { return {piece.to, piece.from, -piece.bulge}; }

bool has_word(std::string text, std::initializer_list<std::string_view> words) {
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return text.find(word) != std::string::npos; });
}

bool is_centreline(const DxfCurve& curve) {
  return curve.entity == "LINE" &&
         (has_word(curve.line_type, {"CENTER", "CENTRE", "MITTE", "DASHDOT", "STRICHPUNKT"}) ||
          has_word(curve.layer, {"CENTER", "CENTRE", "AXIS", "MITTE", "ACHSE"}));
}

/// Is it part of what is drawn of the body?
bool is_outline(const DxfCurve& curve) {
  return !is_centreline(curve) && !has_word(curve.layer, {"DIM", "TEXT", "TITLE", "FRAME", "HIDDEN", "DEFPOINTS"});
}

/// The axis as a frame: `along` towards +x, or +y of a vertical axis.
struct Axis {
  Vec2 origin = Vec2::Zero(), along = Vec2(1.0, 0.0);
  [[nodiscard]] Vec2 in_plane(const Vec2& p) const { return {along.dot(p - origin), cross(along, p - origin)}; }
};

Axis axis_of(const std::vector<DxfCurve>& curves) {
  double longest = 0.0;
  Axis axis;
  Vec2 low(1e300, 1e300), high(-1e300, -1e300);
  for (const DxfCurve& curve : curves) {
    if (is_centreline(curve)) {
      const Vec2 line = curve.pieces.front().to - curve.pieces.front().from;
      if (line.norm() <= longest) continue;
      longest = line.norm();
      const bool back = std::abs(line.x()) > 1e-6 * longest ? line.x() < 0.0 : line.y() < 0.0;
      axis.along = (back ? -1.0 : 1.0) * line / longest;
      // z counts from the drawing's own origin, as far as there is one on the axis.
      axis.origin = curve.pieces.front().from - axis.along.dot(curve.pieces.front().from) * axis.along;
    }
    if (!is_outline(curve)) continue;
    for (const ProfileArc& piece : curve.pieces)
      for (const Vec2& p : {piece.from, piece.to}) low = low.cwiseMin(p), high = high.cwiseMax(p);
  }
  if (longest > 0.0) return axis;
  const bool tall = high.y() - low.y() > high.x() - low.x();
  const bool one_side = low.x() >= -kMeetMm || high.x() <= kMeetMm;
  const bool whole = std::abs(low.x() + high.x()) <= kMeetMm;
  if (tall && (one_side || whole)) return {Vec2::Zero(), Vec2(0.0, 1.0)};
  return {};
}

/// The part of a line or arc with rho >= 0: halves of it until they are on one side or tiny.
void add_upper(const ProfileArc& piece, int depth, Chain& out) {
  const bool from = piece.from.y() >= -kMeetMm, to = piece.to.y() >= -kMeetMm;
  const Vec2 chord = piece.to - piece.from;
  const Vec2 middle = 0.5 * (piece.from + piece.to) + 0.5 * piece.bulge * Vec2(chord.y(), -chord.x());
  if (from && to && middle.y() >= -kMeetMm) {
    // What is left on the axis of a piece below it is none.
    const bool nothing = depth > 0 && std::abs(piece.from.y()) <= kMeetMm && std::abs(piece.to.y()) <= kMeetMm;
    if (!nothing) out.push_back(piece);
    return;
  }
  if ((!from && !to && middle.y() < -kMeetMm) || depth > 40) return;
  // Half of an arc has the tangent of half of the quarter angle.
  const double bulge = std::tan(0.5 * std::atan(piece.bulge));
  add_upper({piece.from, middle, bulge}, depth + 1, out);
  add_upper({middle, piece.to, bulge}, depth + 1, out);
}

double length_of(const Chain& chain) {
  double sum = 0.0;
  for (const ProfileArc& piece : chain) sum += (piece.to - piece.from).norm();
  return sum;
}

/// Lines and arcs of the better drawn side, in (z, rho). What lies on the axis only closes an outline.
Chain half_of(const std::vector<const DxfCurve*>& curves, const Axis& axis) {
  Chain above, below;
  for (const DxfCurve* curve : curves)
    for (const ProfileArc& piece : curve->pieces) {
      const Vec2 a = axis.in_plane(piece.from), b = axis.in_plane(piece.to);
      if (std::abs(a.y()) < kMeetMm && std::abs(b.y()) < kMeetMm && piece.bulge == 0.0) continue;
      add_upper({a, b, piece.bulge}, 0, above);
      add_upper({{a.x(), -a.y()}, {b.x(), -b.y()}, -piece.bulge}, 0, below);
    }
  return length_of(below) > (1.0 + 1e-6) * length_of(above) ? below : above;
}

bool meet(const Vec2& a, const Vec2& b) { return (a - b).norm() <= kMeetMm; }

/// How many ends of other pieces are at a point.
int company(const Chain& all, std::size_t self, const Vec2& at) {
  int count = 0;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (k != self) count += (meet(all[k].from, at) ? 1 : 0) + (meet(all[k].to, at) ? 1 : 0);
  return count;
}

/// The chain that begins with a piece; where several go on, the one whose end is farther from the axis: lines across the body
/// end on it.
Chain chain_from(const Chain& all, std::size_t first, bool back, std::vector<bool>& used) {
  Chain chain{back ? reversed(all[first]) : all[first]};
  used[first] = true;
  for (;;) {
    const Vec2 at = chain.back().to;
    std::size_t next = all.size();
    bool turned = false;
    double best = -1.0;
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (used[k]) continue;
      const bool forth = meet(all[k].from, at), other = !forth && meet(all[k].to, at);
      const double rho = (other ? all[k].from : all[k].to).y();
      if ((forth || other) && rho > best) best = rho, next = k, turned = other;
    }
    if (next == all.size()) return chain;
    used[next] = true;
    chain.push_back(turned ? reversed(all[next]) : all[next]);
    chain.back().from = at;
  }
}

/// The longest chain of pieces that meet.
Chain longest_chain(const Chain& all) {
  Chain best;
  std::vector<bool> done(all.size(), false);
  for (std::size_t k = 0; k < all.size(); ++k) {
    // Begins where nothing else ends; a closed one has no such place once its line on the axis is left out.
    const bool open_from = company(all, k, all[k].from) == 0, open_to = company(all, k, all[k].to) == 0;
    if (done[k] || (!open_from && !open_to)) continue;
    std::vector<bool> used(all.size(), false);
    Chain chain = chain_from(all, k, !open_from, used);
    for (std::size_t j = 0; j < all.size(); ++j) done[j] = done[j] || used[j];
    if (length_of(chain) > length_of(best)) best = std::move(chain);
  }
  return best;
}

bool on_axis(const Vec2& p) { return std::abs(p.y()) <= kMeetMm; }

/// How many pieces from the beginning lie on one circle about the axis, as a ball end does; 0: none. Chords of a polygon count by
/// their ends.
std::size_t ball_pieces(const Chain& chain) {
  if (chain.empty() || !on_axis(chain.front().from)) return 0;
  const double pole = chain.front().from.x();
  std::size_t found = 0;
  for (std::size_t n = 0; n < chain.size(); ++n) {
    const Vec2 end = chain[n].to - Vec2(pole, 0.0);
    if (!(std::abs(end.x()) > kMeetMm)) continue;          // beside the pole any circle fits
    const double r = end.squaredNorm() / (2.0 * end.x());  // of the circle about the axis through pole and end
    bool same = true;
    for (std::size_t k = 0; k <= n && same; ++k) {
      const ProfileArc& piece = chain[k];
      const Vec2 chord = piece.to - piece.from;
      const Vec2 middle = 0.5 * (piece.from + piece.to) + 0.5 * piece.bulge * Vec2(chord.y(), -chord.x());
      const auto off = [&](const Vec2& p) { return std::abs((p - Vec2(pole + r, 0.0)).norm() - std::abs(r)); };
      same = off(piece.to) < 2e-4 && (piece.bulge == 0.0 || off(middle) < 2e-4);
    }
    // One line through the pole lies on some circle, too.
    if (same && (n >= 2 || chain[n].bulge != 0.0)) found = n + 1;
  }
  return found;
}

Chain turned(const Chain& chain) {
  Chain back;
  for (std::size_t k = chain.size(); k-- > 0;) back.push_back(reversed(chain[k]));
  return back;
}

/// z the other way round: a mirror image, in which what turns left turns right.
Chain mirrored(Chain chain) {
  for (ProfileArc& piece : chain)
    piece = {{-piece.from.x(), piece.from.y()}, {-piece.to.x(), piece.to.y()}, -piece.bulge};
  return chain;
}

/// The first radius that the outline has at its beginning, beyond what lies across the axis there.
double end_radius(const Chain& chain) {
  for (const ProfileArc& piece : chain)
    if (std::abs(piece.to.x() - piece.from.x()) > kMeetMm) return piece.from.y();
  return 0.0;
}

/// From the tip to the holder, z growing.
Chain from_the_tip(Chain chain) {
  const Chain back = turned(chain);
  const std::size_t ball = ball_pieces(chain), other = ball_pieces(back);
  bool turn = chain.front().from.x() > chain.back().to.x();
  if ((ball > 0) != (other > 0))
    turn = other > 0;
  else if (ball == 0 && on_axis(chain.front().from) && on_axis(chain.back().to) &&
           std::abs(end_radius(chain) - end_radius(back)) > 1e-2 * end_radius(chain))
    turn = end_radius(back) < end_radius(chain);
  if (turn) chain = back;
  const bool falls = chain.front().from.x() > chain.back().to.x();
  return falls ? mirrored(chain) : chain;
}

Vec2 tangent(const ProfileArc& piece, bool at_end) {
  const Vec2 chord = (piece.to - piece.from).normalized();
  const double half = 2.0 * std::atan(piece.bulge) * (at_end ? 1.0 : -1.0);
  return {std::cos(half) * chord.x() - std::sin(half) * chord.y(),
          std::sin(half) * chord.x() + std::cos(half) * chord.y()};
}

bool corner_between(const ProfileArc& a, const ProfileArc& b) {
  const Vec2 s = tangent(a, true), t = tangent(b, false);
  return std::abs(std::atan2(cross(s, t), s.dot(t))) > kDxfCornerRad;
}

/// Is it part of a flat end or of its corner radius? Lines across the axis, and arcs outside which the axis lies.
bool of_the_end(const ProfileArc& piece) {
  const Vec2 chord = piece.to - piece.from;
  if (piece.bulge == 0.0) return chord.x() <= 0.3 * chord.y();
  if (piece.bulge > 0.0) return false;
  const double length = chord.norm(), b = piece.bulge;
  const Vec2 left(-chord.y() / length, chord.x() / length);
  const Vec2 centre = 0.5 * (piece.from + piece.to) + length * (1.0 - b * b) / (4.0 * b) * left;
  return centre.y() > -kMeetMm;
}

/// Tip, flank and shank of an outline from its tip on.
ToolOutline split(const Chain& chain) {
  ToolOutline outline;
  std::size_t at = ball_pieces(chain);
  if (on_axis(chain.front().from)) {
    double bottom = chain.front().from.x();
    for (const ProfileArc& piece : chain) bottom = std::min({bottom, piece.from.x(), piece.to.x()});
    outline.bottom = bottom;
    outline.ball = at > 0;
    while (at < chain.size() && of_the_end(chain[at])) ++at;
  }
  while (at < chain.size() && (outline.flank.empty() || !corner_between(chain[at - 1], chain[at])))
    outline.flank.push_back(chain[at++]);
  Chain shank(chain.begin() + static_cast<long>(at), chain.end());
  while (!shank.empty() && on_axis(shank.back().to) && std::abs(shank.back().to.x() - shank.back().from.x()) < kMeetMm)
    shank.pop_back();  // the closing line at the upper end
  outline.shank = profile_points(shank);
  return outline;
}

std::vector<const DxfCurve*> on_layer(const std::vector<DxfCurve>& curves, std::string_view layer) {
  std::vector<const DxfCurve*> found;
  for (const DxfCurve& curve : curves)
    if (curve.layer == layer && !curve.pieces.empty()) found.push_back(&curve);
  return found;
}

/// z of no point is below that of the point before it, or there is no body of revolution.
std::vector<Vec2> rising(std::vector<Vec2> profile, const std::string& file, const char* what) {
  if (profile.size() > 1 && profile.front().x() > profile.back().x()) std::reverse(profile.begin(), profile.end());
  for (std::size_t k = 1; k < profile.size(); ++k) {
    if (profile[k].x() < profile[k - 1].x() - kMeetMm)
      throw InputError(
          fmt::format("{}: the {} has an undercut at z {:.4g}; z must not decrease", file, what, profile[k].x()));
    profile[k].x() = std::max(profile[k].x(), profile[k - 1].x());
  }
  return profile;
}

/// Layers FLANK, SHANK and HOLDER say what is what: x grows towards the holder, and the tip is not drawn but stated.
ToolOutline labelled(const std::vector<DxfCurve>& curves, const Axis& axis, const std::string& file) {
  ToolOutline outline;
  outline.flank = longest_chain(half_of(on_layer(curves, "FLANK"), axis));
  if (!outline.flank.empty() && outline.flank.front().from.x() > outline.flank.back().to.x())
    outline.flank = turned(outline.flank);
  const auto profile = [&](const char* layer, const char* what) {
    return rising(profile_points(longest_chain(half_of(on_layer(curves, layer), axis))), file, what);
  };
  outline.shank = profile("SHANK", "shank");
  outline.holder = profile("HOLDER", "holder");
  return outline;
}

Chain drawn_chain(const std::vector<DxfCurve>& curves, const std::string& file) {
  std::vector<const DxfCurve*> drawn;
  for (const DxfCurve& curve : curves)
    if (is_outline(curve) && !curve.pieces.empty()) drawn.push_back(&curve);
  if (drawn.empty())
    throw InputError(file + ": no lines, arcs, polylines or splines of a tool's outline; blocks must be exploded");
  const Chain chain = longest_chain(half_of(drawn, axis_of(curves)));
  if (chain.empty()) throw InputError(file + ": its lines do not join to one open outline of half a tool");
  return from_the_tip(chain);
}

}  // namespace

ToolOutline outline_of_drawing(const std::vector<DxfCurve>& curves, const std::string& file) {
  if (!on_layer(curves, "FLANK").empty()) return labelled(curves, axis_of(curves), file);
  ToolOutline outline = split(drawn_chain(curves, file));
  outline.shank = rising(outline.shank, file, "shank");
  return outline;
}

std::vector<Vec2> holder_of_drawing(const std::vector<DxfCurve>& curves, const std::string& file) {
  std::vector<const DxfCurve*> drawn = on_layer(curves, "HOLDER");
  std::vector<Vec2> profile =
      profile_points(drawn.empty() ? drawn_chain(curves, file) : longest_chain(half_of(drawn, axis_of(curves))));
  profile = rising(std::move(profile), file, "holder");
  if (profile.size() < 2) throw InputError(file + ": no outline of a holder");
  const double lowest = profile.front().x();
  for (Vec2& p : profile) p.x() -= lowest;
  return profile;
}

}  // namespace flank::internal
