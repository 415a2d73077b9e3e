// Programs for the tests of the dialects: a small one for the golden files, random ones, and what printing leaves of one.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "flank/base/random.h"
#include "flank/machine/nc/dialect.h"

namespace flank::internal {

/// A dialect with what it can state.
struct NcCase {
  std::string name;
  NcDialect dialect;
  NcPositions positions = NcPositions::kTipRotary;
  NcJoin join = NcJoin::kAxes;
  NcFeedMode feed_mode = NcFeedMode::kPerMinute;
};

inline std::vector<NcCase> nc_cases() {
  using L = NcLanguage;
  using P = NcPositions;
  constexpr NcJoin kAxes = NcJoin::kAxes, kCircle = NcJoin::kGreatCircle;
  constexpr NcFeedMode kMinute = NcFeedMode::kPerMinute, kInverse = NcFeedMode::kInverseTime;
  NcDialect linuxcnc{.language = L::kLinuxCnc}, switched = linuxcnc, joint = linuxcnc;
  switched.tcp_on = "M428";
  switched.tcp_off = "M429";
  switched.smoothing_mm = 0.001;
  joint.positions = P::kJoint;
  const NcDialect fanuc{.language = L::kFanuc, .smoothing_mm = 0.01};
  NcDialect siemens{.language = L::kSiemens, .smoothing_mm = 0.01, .smoothing_deg = 0.1}, numbered = siemens;
  numbered.line_numbers = true;
  NcDialect m128{.language = L::kHeidenhain, .smoothing_mm = 0.02, .smoothing_deg = 0.05}, tcpm = m128;
  tcpm.function_tcpm = true;
  tcpm.decimal_comma = false;
  const NcDialect apt{.language = L::kApt};
  return {{"linuxcnc_tcp", linuxcnc, P::kTipRotary, kAxes, kMinute},
          {"linuxcnc_switched", switched, P::kTipRotary, kAxes, kInverse},
          {"linuxcnc_joint", joint, P::kJoint, kAxes, kInverse},
          {"fanuc_g434", fanuc, P::kTipRotary, kAxes, kMinute},
          {"fanuc_g435", fanuc, P::kTipVector, kAxes, kMinute},
          {"fanuc_joint", {.language = L::kFanuc}, P::kJoint, kAxes, kInverse},
          {"siemens_oriaxes", siemens, P::kTipRotary, kAxes, kMinute},
          {"siemens_orivect", numbered, P::kTipVector, kCircle, kInverse},
          {"siemens_joint", {.language = L::kSiemens}, P::kJoint, kAxes, kInverse},
          {"heidenhain_m128", m128, P::kTipRotary, kAxes, kMinute},
          {"heidenhain_tcpm", tcpm, P::kTipRotary, kCircle, kMinute},
          {"heidenhain_ln", tcpm, P::kTipVector, kAxes, kMinute},
          {"apt", apt, P::kTipVector, kCircle, kMinute}};
}

inline NcHeader sample_header() {
  NcHeader h;
  h.program = "BLADE";
  h.number = 12;
  h.part = "blade.step";
  h.machine = "sample";
  h.tool = {.number = 3, .name = "BARREL 10", .diameter = 10.0, .length = 62.5, .tip_offset = 2.25};
  h.spindle_rpm = 5000.0;
  return h;
}

/// Two strips with a link between them, nine moves; upright at both ends, wound up by two turns.
inline NcProgram sample_program(const NcCase& c) {
  NcProgram p;
  p.header = sample_header();
  p.positions = c.positions;
  p.join = c.join;
  p.feed_mode = c.feed_mode;
  p.strips = {{1, "flank", "F1"}, {2, "flank", "F1,F3"}};
  const bool vector = c.positions == NcPositions::kTipVector;
  if (vector) p.start_rotary = Vec2(0.0, 45.0);
  p.end_rotary = Vec2(0.0, -360.0);
  const double feed = c.feed_mode == NcFeedMode::kInverseTime ? 12.5 : 800.0;
  const auto add = [&](NcKind kind, int strip, Vec3 position, Vec2 rotary, Vec3 axis, double f) {
    NcMove m{.kind = kind, .joined = !p.moves.empty(), .strip = strip};
    m.position = position;
    m.orientation = vector ? axis : Vec3(rotary.x(), rotary.y(), 0.0);
    m.feed = f;
    p.moves.push_back(m);
  };
  const Vec3 tilted(0.6, 0.0, 0.8), upright(0.0, 0.0, 1.0);
  add(NcKind::kRapid, -1, {10.0, -20.0, 80.0}, {0.0, 45.0}, upright, 0.0);
  add(NcKind::kFeed, -1, {10.0, -20.0, 60.0}, {-30.0, 45.0}, tilted, 4.0 * feed);
  add(NcKind::kFeed, 0, {10.0, -20.0, 12.5}, {-30.0, 45.0}, tilted, feed);
  add(NcKind::kFeed, 0, {12.0625, -18.0, 12.25}, {-29.5, 47.12345}, tilted, feed);
  add(NcKind::kFeed, 0, {14.0, -16.0, 12.0}, {0.0, 50.0}, upright, 1.5 * feed);
  add(NcKind::kRapid, -1, {14.0, -16.0, 80.0}, {0.0, 50.0}, upright, 0.0);
  add(NcKind::kRapid, 1, {-5.0, 0.0, 80.0}, {0.0, 50.0}, upright, 0.0);
  add(NcKind::kFeed, 1, {-5.5, 0.0001, -0.5}, {0.5, -361.0}, {0.0, 0.6, 0.8}, 1.5 * feed);
  add(NcKind::kFeed, -1, {-5.5, 0.0, 80.0}, {0.0, -361.0}, upright, 4.0 * feed);
  return p;
}

inline double rounded(double value, int decimals) {
  const double scale = std::pow(10.0, decimals);
  const double r = std::round(value * scale) / scale;
  return r == 0.0 ? 0.0 : r;
}

/// What remains of a program once it is printed: its decimals, and what the dialect does not say.
inline NcProgram printed(NcProgram p, const NcDialect& d) {
  for (NcMove& m : p.moves) {
    for (int i = 0; i < 3; ++i) {
      m.position[i] = rounded(m.position[i], d.length_decimals);
      m.orientation[i] =
          rounded(m.orientation[i], p.positions == NcPositions::kTipVector ? d.vector_decimals : d.angle_decimals);
    }
    if (p.positions == NcPositions::kTipVector) m.orientation.normalize();
    if (m.kind == NcKind::kFeed) m.feed = rounded(m.feed, nc_feed_decimals(p.feed_mode, m.feed, d));
  }
  if (p.start_rotary)
    for (int i = 0; i < 2; ++i) (*p.start_rotary)[i] = rounded((*p.start_rotary)[i], d.angle_decimals);
  else if (p.positions != NcPositions::kTipVector)
    p.start_rotary = p.moves.front().orientation.head<2>();
  if (d.language == NcLanguage::kApt) p.start_rotary.reset();
  if (d.language != NcLanguage::kFanuc) p.header.number = 1;
  return p;
}

inline NcProgram random_program(Random& random, const NcCase& c, int count) {
  NcProgram p = sample_program(c);
  p.moves.clear();
  p.strips = {{1, "flank", "F1"}, {2, "link", ""}, {7, "entry", "F2,F3"}};
  p.end_rotary.reset();
  const bool pieces = c.dialect.language != NcLanguage::kLinuxCnc || !c.dialect.tcp_on.empty();
  const auto between = [&](double low, double high) { return random.uniform(low, high); };
  int strip = -1;
  for (int i = 0; i < count; ++i) {
    if (random.uniform() < 0.1) strip = static_cast<int>(between(-1.0, 2.999));
    NcMove m{.kind = random.uniform() < 0.8 && i > 0 ? NcKind::kFeed : NcKind::kRapid, .joined = i > 0, .strip = strip};
    if (pieces && i > 0 && random.uniform() < 0.05) m.joined = false;
    m.position = Vec3(between(-300, 300), between(-1, 1) * 1e-3, between(-1e4, 1e4));
    m.orientation = c.positions == NcPositions::kTipVector
                        ? Vec3(Vec3(between(-1, 1), between(-1, 1), between(0.1, 1)).normalized())
                        : Vec3(between(-120, 120), between(-4e4, 4e4), 0.0);
    if (m.kind == NcKind::kFeed) m.feed = std::pow(10.0, between(-3, 5));
    // A rapid turns nothing under tool-centre control.
    else if (i > 0 && c.positions != NcPositions::kJoint && (m.joined || c.positions == NcPositions::kTipVector))
      m.orientation = p.moves.back().orientation;
    p.moves.push_back(m);
  }
  return p;
}

}  // namespace flank::internal
