/// An NC program without its dialect: what stands between a machine and the text of a program.
///
/// Lengths are in millimetres and rotary values in degrees, as programs state them (an inch program is converted when it
/// is read). Nothing here knows a machine's kinematics: what a rotary value or a joint coordinate means is the machine's.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "flank/vec.h"

namespace flank::internal {

/// What the words of a move state.
enum class NcPositions : std::uint8_t {
  kTipRotary,  ///< tool-centre control: the controlled point in the frame of the part, and the two rotary axes
  kTipVector,  ///< tool-centre control: the controlled point and the unit vector towards the holder, in that frame
  kJoint,      ///< no tool-centre control and no length compensation: the joints themselves, linear and rotary
};

/// How the control joins two blocks. The controlled point (joint coordinates: the linear joints) always runs straight.
enum class NcJoin : std::uint8_t {
  kAxes,         ///< the rotary axes run linearly
  kGreatCircle,  ///< the tool axis turns in the plane of the two vectors, at constant speed of its angle
};

enum class NcFeedMode : std::uint8_t {
  kPerMinute,    ///< mm/min of the controlled point
  kInverseTime,  ///< 1/min: a block takes 1/F minutes; stated on every feed move
};

/// The tool as the header names it; what is not known is 0 or empty.
struct NcTool {
  int number = 1;
  std::string name = {};
  double diameter = 0.0;  ///< largest, mm
  double length = 0.0;    ///< from the gauge line to the controlled point, mm
  /// From the controlled point along the axis to the axis point s = 0, mm: 0 where the controlled point is the centre of
  /// the tip's sphere, r(0) where it is the tool's lowest point.
  double tip_offset = 0.0;
};

/// What comments say of the set-up that a program was made for, apart from its words: those decide what the control does, and
/// may have been changed since.
struct NcStated {
  std::optional<int> work_offset, tool;
  std::string tool_name = {};
  bool dry_run = false;            ///< it is to be run without the spindle
  std::string contradiction = {};  ///< two comments that say different things, for a message; empty: none
};

/// Of a program of several operations: which of them this is. Each begins from any state of the control, so that it can be entered
/// by itself.
struct NcOperation {
  int number = 1, count = 1;
  int copy = 1, copies = 1;  ///< run turned by (copy - 1) / copies of a turn about an axis of the part
  std::string name = {};     ///< for people
  bool operator==(const NcOperation&) const = default;
};

/// Facts that a header states. No dates: the same program is the same bytes.
struct NcHeader {
  std::string program = "FLANK";  ///< name of the program
  int number = 1;                 ///< where programs have numbers (Fanuc), 1 to 9999
  std::string part = {};          ///< file of the part
  std::string machine = {};       ///< the machine that it is for
  std::string setup = {};         ///< where the part sits, "x,y,z,a,b,c" (work_setup.h); empty: not known
  std::string origin = {};        ///< what the work offset holds for that, "X5 Y-8 Z60"; empty: not known
  NcTool tool;
  std::optional<NcOperation> operation = {};  ///< none: the program is one operation
  std::string copy_axis = {};                 ///< "x,y,z,x,y,z" in the part's frame, of an operation of several copies
  double spindle_rpm = 0.0;                   ///< 0: the spindle is not started
  std::string coolant = {};                   ///< "flood" or "mist"; empty: off. Not read back
  bool dry_run = false;                       ///< written as a comment: the spindle is not to turn
  std::vector<std::string> shortfalls =
      {};                                  ///< why the program does not meet its request, for its header. Not read back
  std::vector<std::string> cautions = {};  ///< what its verdict says nothing about, likewise
  int work_offset = 1;                     ///< 1 is G54 (or the first preset)
  NcStated stated = {};                    ///< of a program that was read
};

/// What holds beside the position when a move is made.
struct NcModes {
  std::optional<int> work_offset;  ///< none: no word has set one
  std::optional<int> tool;         ///< in the spindle; none: no word has called one by number
  std::string tool_name = {};      ///< likewise, where tools are called by name
  std::optional<int> length;       ///< the tool whose length is switched on, 0: of none; none: no word says it
  std::optional<int> edge;         ///< Siemens: D
  bool spindle = false;            ///< it turns
  bool operator==(const NcModes&) const = default;
};

/// What moves belong to; ids and kinds as in Path.
struct NcStrip {
  int id = 1;
  std::string kind = "flank", face = {};
};

enum class NcKind : std::uint8_t { kRapid, kFeed };

/// One block that moves.
struct NcMove {
  NcKind kind = NcKind::kFeed;
  /// False where the machine comes from its reference position and not from the move before: always so of the first
  /// move, and of the first one after tool-centre control was off.
  bool joined = true;
  std::int32_t strip = -1;  ///< index into NcProgram::strips; -1: none
  std::int32_t line = 0;    ///< line of the text that it was read from, from 1; 0: made here
  Vec3 position = Vec3::Zero();
  /// Rotary values in the order of NcProgram::rotary (degrees, third component 0), or the unit vector towards the holder.
  Vec3 orientation = Vec3::Zero();
  double feed = 0.0;        ///< as the feed mode has it, > 0 of a feed move; 0 of a rapid
  std::int32_t modes = -1;  ///< index into NcProgram::modes; -1: made here
};

/// A program. No rapid turns a rotary axis under tool-centre control: the tip would be held while the linear axes run after
/// it as fast as they can. Every move states position and orientation in full; which words a text leaves out is the dialect's.
struct NcProgram {
  NcHeader header;
  NcPositions positions = NcPositions::kTipRotary;
  NcJoin join = NcJoin::kAxes;
  NcFeedMode feed_mode = NcFeedMode::kPerMinute;
  std::string rotary = "AC";  ///< letters of the two rotary axes, in the machine's order
  /// Where the rotary axes stand before tool-centre control is switched on, degrees. Of programs with vectors it decides
  /// which of its solutions the control begins with; of others it is the first move's unless it is stated.
  std::optional<Vec2> start_rotary;
  /// Where they are sent when all is done, in the air and without tool-centre control; none: they stay. Not read back.
  std::optional<Vec2> end_rotary;
  std::vector<NcStrip> strips;
  std::vector<NcMove> moves;
  std::vector<NcModes> modes;  ///< of a program that was read, in the order in which they come into force
};

}  // namespace flank::internal
