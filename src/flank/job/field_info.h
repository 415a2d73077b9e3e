/// What a field of a job is: its name, unit, range, group and help text; and the ranges that fields have.
#pragma once

#include <concepts>
#include <string_view>
#include <type_traits>

namespace flank::internal {

/// Which values a field takes. `words` says it in messages: "expected a length > 0 mm".
struct Accepted {
  std::string_view words;
  bool (*number)(double) = nullptr;          ///< null: any
  bool (*text)(std::string_view) = nullptr;  ///< null: any
};

/// How a value is written on a command line, if not as it is.
enum class Spelling {
  kPlain,
  kFile,         ///< the name of a file or folder: absolute in job.json
  kFileOrText,   ///< a file if there is one of that name; then as kFile
  kOnOff,        ///< of a bool
  kFlag,         ///< of a bool: the option alone, or nothing
  kSign,         ///< of a side: + or -
  kAutoOrCount,  ///< 0 is "auto"
};

struct FieldInfo {
  std::string_view key;    ///< of job.json, and, by flag_of(), of the option: "axis_length" is --axis-length
  std::string_view unit;   ///< "mm", "mm/min"; empty: none
  std::string_view group;  ///< of the help text; empty: the first
  std::string_view help;
  Accepted accepted{};
  Spelling spelling = Spelling::kPlain;
  std::string_view option{};  ///< not by the rule: "--face", or "PART" for a word without option
  bool always = false;        ///< is given, or shown, even if it has its default value
};

/// T or const T.
template <class Job, class T>
concept Is = std::same_as<std::remove_const_t<Job>, T>;

}  // namespace flank::internal

namespace flank::internal::accepted {

inline bool positive(double x) { return x > 0.0 && x < 1e300; }
/// What is far below an atom counts as nothing.
inline bool length(double x) { return x >= 1e-9 && x < 1e300; }
inline bool not_negative(double x) { return x >= 0.0 && x < 1e300; }
inline constexpr Accepted kAny{};
inline constexpr Accepted kLength{"expected a length > 0 mm", length};
inline constexpr Accepted kDistance{"expected a length >= 0 mm", not_negative};
inline constexpr Accepted kRadius{"expected a radius > 0 mm", length};
inline constexpr Accepted kRate{"expected a rate > 0 mm/min", positive};
inline constexpr Accepted kShare{"expected a share between 0 and 1", [](double x) { return x >= 0.0 && x <= 1.0; }};
inline constexpr Accepted kCoverage{"expected a share above 0 and at most 1",
                                    [](double x) { return x > 0.0 && x <= 1.0; }};
inline constexpr Accepted kPrice{"expected a share from 0 to 1", [](double x) { return x >= 0.0 && x < 1.0; }};
inline constexpr Accepted kSlope{"expected a number between 0 and 1", [](double x) { return x > 0.0 && x < 1.0; }};
inline constexpr Accepted kRatio{"expected a number > 0", positive};
inline constexpr Accepted kProfile{"must be tapered or any", nullptr,
                                   [](std::string_view x) { return x == "tapered" || x == "any"; }};
inline constexpr Accepted kEffort{"must be quick, normal or thorough", nullptr,
                                  [](std::string_view x) { return x == "quick" || x == "normal" || x == "thorough"; }};
inline constexpr Accepted kPassCount{"expected auto or a number from 1 to 64",
                                     [](double x) { return x >= 0.0 && x <= 64.0; }};
inline constexpr Accepted kStrips{"expected a number from 1 to 200", [](double x) { return x >= 1.0 && x <= 200.0; }};
inline constexpr Accepted kFinalists{"expected a number from 1 to 100",
                                     [](double x) { return x >= 1.0 && x <= 100.0; }};
inline constexpr Accepted kSide{"expected + or -", [](double x) { return x == 1.0 || x == -1.0; }};
inline constexpr Accepted kUnit{"expected mm, cm, m or in", nullptr,
                                [](std::string_view x) { return x == "mm" || x == "cm" || x == "m" || x == "in"; }};
inline constexpr Accepted kStrategy{"must be grow or curves", nullptr,
                                    [](std::string_view x) { return x == "grow" || x == "curves"; }};
inline constexpr Accepted kSpeed{"must be feed, constant or optimal", nullptr,
                                 [](std::string_view x) { return x == "feed" || x == "constant" || x == "optimal"; }};
inline constexpr Accepted kOrder{"must be shortest or given", nullptr,
                                 [](std::string_view x) { return x == "shortest" || x == "given"; }};
inline constexpr Accepted kFollow{"must be path or any", nullptr,
                                  [](std::string_view x) { return x == "path" || x == "any"; }};
inline constexpr Accepted kWorkOffset{"expected a number from 1 to 99", [](double x) { return x >= 1.0 && x <= 99.0; }};
inline constexpr Accepted kToolNumber{"expected a number from 1 to 1000000",
                                      [](double x) { return x >= 1.0 && x <= 1e6; }};
inline constexpr Accepted kTurn{"expected an angle above 0 and at most 180 degrees",
                                [](double x) { return x > 0.0 && x <= 180.0; }};
inline constexpr Accepted kTurns{"expected a number > 0", positive};
inline constexpr Accepted kEngagement{"expected an angle above 5 and up to 180 degrees",
                                      [](double x) { return x > 5.0 && x <= 180.0; }};
inline constexpr Accepted kCut{"must be climb or conventional", nullptr,
                               [](std::string_view x) { return x == "climb" || x == "conventional"; }};
inline constexpr Accepted kShank{"must be given, auto or none", nullptr,
                                 [](std::string_view x) { return x == "given" || x == "auto" || x == "none"; }};
inline constexpr Accepted kClamp{"must be any, bottom or bore", nullptr,
                                 [](std::string_view x) { return x == "any" || x == "bottom" || x == "bore"; }};
inline constexpr Accepted kLayers{"expected auto or a number from 1 to 12",
                                  [](double x) { return x >= 0.0 && x <= 12.0; }};
inline constexpr Accepted kCycles{"must be volume, plain or paper", nullptr,
                                  [](std::string_view x) { return x == "volume" || x == "plain" || x == "paper"; }};
inline constexpr Accepted kEntry{"must be auto, open, ramp or plunge", nullptr, [](std::string_view x) {
                                   return x == "auto" || x == "open" || x == "ramp" || x == "plunge";
                                 }};
inline constexpr Accepted kRampAngle{"expected an angle of at least 0.1 and at most 45 degrees",
                                     [](double x) { return x >= 0.1 && x <= 45.0; }};
inline constexpr Accepted kHelix{"expected an angle from 0 to 60 degrees",
                                 [](double x) { return x >= 0.0 && x <= 60.0; }};
inline constexpr Accepted kCopies{"expected a number from 1 to 999", [](double x) { return x >= 1.0 && x <= 999.0; }};
inline constexpr Accepted kCoolant{"must be off, flood or mist", nullptr,
                                   [](std::string_view x) { return x == "off" || x == "flood" || x == "mist"; }};
inline constexpr Accepted kSeeds{"must be grid or shape", nullptr,
                                 [](std::string_view x) { return x == "grid" || x == "shape"; }};

}  // namespace flank::internal::accepted
