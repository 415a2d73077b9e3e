/// The table of fields (flank/job/fields.h) as options of a command.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

#include "flank/job/more_fields.h"
#include "help.h"

namespace flank::cli {

/// What messages of the library call a field -> how the command line calls it: "tolerance_mm" -> "--tolerance".
using FlagNames = std::map<std::string, std::string>;

template <class T>
struct IsList : std::false_type {};
template <>
struct IsList<std::vector<std::string>> : std::true_type {};

template <class Member>
CLI::Option* add_option(CLI::App& app, const std::string& flag, const internal::FieldInfo& info, Member& member) {
  const std::string help(info.help);
  if constexpr (IsList<Member>::value) {
    const auto read = [info, &member](const std::vector<std::string>& words) {
      member.clear();
      for (const std::string& word : words) internal::read_word(info, word, member);
    };
    // An option takes one word and may be given again; words without an option are all that are left.
    return app.add_option_function<std::vector<std::string>>(flag, read, help)
        ->allow_extra_args(!flag.starts_with('-'));
  } else if constexpr (std::is_same_v<Member, bool>) {
    if (info.spelling == internal::Spelling::kFlag) return app.add_flag(flag, member, help);
    return app.add_option_function<std::string>(
        flag, [info, &member](const std::string& word) { internal::read_word(info, word, member); }, help);
  } else {
    return app.add_option_function<std::string>(
        flag, [info, &member](const std::string& word) { internal::read_word(info, word, member); }, help);
  }
}

template <class Member>
std::string type_name(const internal::FieldInfo& info, const Member&) {
  if (info.unit == "mm") return "MM";
  if (info.unit == "mm/min") return "MM/MIN";
  constexpr bool kNumber = std::is_arithmetic_v<Member> || std::is_same_v<Member, std::optional<double>> ||
                           std::is_same_v<Member, std::optional<std::uint64_t>>;
  return kNumber && info.spelling == internal::Spelling::kPlain ? "NUMBER" : "TEXT";
}

/// Whether --help shows the option; the others are shown by --help-all.
inline bool is_basic(const internal::FieldInfo& info, const std::string& command) {
  // Beside the fields of a form: what names the part, and what is asked for most often.
  constexpr std::array kAlways{"part",  "folder", "faces",  "skin",     "left",
                               "right", "unit",   "strips", "coverage", "fixtures"};
  const std::vector<std::string>& basic = internal::basic_fields(command);
  if (basic.empty()) return info.group.empty();
  return info.always || std::find(kAlways.begin(), kAlways.end(), info.key) != kAlways.end() ||
         std::find(basic.begin(), basic.end(), info.key) != basic.end();
}

/// Adds an option for every field of the job, which must outlive the parsing, and --shank-diameter where it has obstacles. Words that are no
/// value throw UsageError while they are parsed.
template <class Job>
FlagNames add_job_options(CLI::App& app, Job& job) {
  FlagNames names;
  CLI::Option* diameter = nullptr;
  internal::visit_fields(job, [&](const internal::FieldInfo& info, auto& member) {
    const std::string flag = internal::flag_of(info);
    CLI::Option* option = add_option(app, flag, info, member);
    const std::vector<std::string> usual = internal::field_words(info, member);
    const bool needed = info.always && (usual.empty() || usual.front().empty());
    option->required(needed);
    const bool flag_alone = info.spelling == internal::Spelling::kFlag;
    if (!flag_alone) option->type_name(type_name(info, member));
    if (!flag_alone && usual.size() == 1 && !usual.front().empty()) option->default_str(usual.front());
    option->group(is_basic(info, std::string(internal::command_name(job))) ? kBasicGroup
                  : info.group.empty()                                     ? kMoreGroup
                                                                           : std::string(info.group));
    if constexpr (requires { job.obstacles; }) {
      if (info.key == "shank_length")
        diameter = app.add_option_function<double>(
                          "--shank-diameter", [&job](double value) { job.obstacles.shank_radius_mm = 0.5 * value; },
                          "Shank diameter. Default: that of the flank's upper end")
                       ->group(option->get_group())
                       ->type_name("MM");
      if (info.key == "shank_radius") option->excludes(diameter);
    }
    names[internal::field_name(info)] = flag;
  });
  return names;
}

}  // namespace flank::cli
