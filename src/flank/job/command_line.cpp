#include "flank/job/command_line.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "flank/job/bound_fields.h"
#include "flank/job/correct_fields.h"
#include "flank/job/design_fields.h"
#include "flank/job/field_text.h"
#include "flank/job/fields.h"
#include "flank/job/redesign_fields.h"
#include "flank/job/wheel_fields.h"

namespace flank::internal {
namespace {

/// A field and its value as the command line has it: no words where nothing is set.
struct FieldWords {
  FieldInfo info;
  std::vector<std::string> words;
};

template <class Job>
std::vector<FieldWords> words_of(const Job& job) {
  std::vector<FieldWords> all;
  visit_fields(job, [&](const FieldInfo& info, const auto& value) { all.push_back({info, field_words(info, value)}); });
  return all;
}

/// The fields that differ from their defaults, and those that are always shown.
template <class Job>
std::vector<FieldWords> told_fields(const Job& job) {
  const std::vector<FieldWords> usual = words_of(Job{});
  std::vector<FieldWords> told;
  // Both lists come from the same table, in the same order.
  std::size_t k = 0;
  for (FieldWords& field : words_of(job)) {
    if (field.info.always || field.words != usual[k].words) told.push_back(std::move(field));
    ++k;
  }
  return told;
}

/// The command that asks for this job, from the table of fields alone: it cannot forget an option.
template <class Job>
std::vector<std::string> arguments(const Job& job) {
  std::vector<std::string> all{std::string(command_name(job))};
  for (const FieldWords& field : told_fields(job)) {
    const std::string flag = flag_of(field.info);
    for (const std::string& word : field.words) {
      if (!flag.starts_with('-')) {
        all.push_back(word);
      } else if (field.info.spelling == Spelling::kFlag) {
        all.push_back(flag);
      } else if (word.starts_with('-') || word.empty()) {
        // A value that begins with a minus could be taken for an option.
        all.push_back(flag + "=" + word);
      } else {
        all.insert(all.end(), {flag, word});
      }
    }
  }
  return all;
}

template <class Job>
std::string command(const Job& job) {
  std::string text = "flank " + std::string(command_name(job));
  for (const FieldWords& field : told_fields(job)) {
    const std::string flag = flag_of(field.info);
    // Fields without a flag are words by their place ("PART").
    for (const std::string& word : field.words) {
      if (!flag.starts_with('-')) {
        text += " " + shell_quoted(word);
      } else if (field.info.spelling == Spelling::kFlag) {
        text += " " + flag;
      } else {
        // A value that begins with a minus could be taken for an option.
        text += " " + flag + (word.starts_with('-') || word.empty() ? "=" : " ") + shell_quoted(word);
      }
    }
  }
  return text;
}

std::string file_name(const std::string& path) { return std::filesystem::path(path).filename().string(); }

/// Cuts the folder off; the last overload is for fields that name no files.
void cut_folder(std::string& value) {
  if (value.find('/') != std::string::npos) value = file_name(value);
}
void cut_folder(std::optional<std::string>& value) {
  if (value) cut_folder(*value);
}
void cut_folder(std::vector<std::string>& values) {
  for (std::string& value : values) cut_folder(value);
}
template <class T>
void cut_folder(T&) {}

}  // namespace

std::string shell_quoted(const std::string& word) {
  constexpr std::string_view kPlain = "_-./:=,+@%";
  const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [&](unsigned char c) {
    return (c < 128 && std::isalnum(c)) || kPlain.find(static_cast<char>(c)) != std::string_view::npos;
  });
  if (plain) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string command_line(const FitJob& job) { return command(job); }
std::string command_line(const CoverJob& job) { return command(job); }
std::string command_line(const TrochoidJob& job) { return command(job); }
std::string command_line(const VerifyJob& job) { return command(job); }
std::string command_line(const PostJob& job) { return command(job); }
std::string command_line(const DesignJob& job) { return command(job); }
std::string command_line(const BoundJob& job) { return command(job); }
std::string command_line(const CorrectJob& job) { return command(job); }
std::string command_line(const RedesignJob& job) { return command(job); }
std::string command_line(const WheelRequest& job) { return command(job); }
std::string command_line(const PlanJob& job) {
  return std::visit([](const auto& plan) { return command(plan); }, job);
}

std::vector<std::string> command_words(const PlanJob& job) {
  return std::visit([](const auto& plan) { return arguments(plan); }, job);
}

PlanJob without_folders(const PlanJob& job) {
  PlanJob shown = job;
  const auto cut = [](const FieldInfo& info, auto& value) {
    if (info.spelling == Spelling::kFile || info.spelling == Spelling::kFileOrText) cut_folder(value);
  };
  std::visit([&](auto& plan) { visit_fields(plan, cut); }, shown);
  return shown;
}

std::vector<std::string> asked_for(const PlanJob& job) {
  std::vector<std::string> lines;
  const auto tell = [&](const FieldWords& field) {
    // The line above says them already (summary_text).
    for (const std::string_view key : {"part", "faces", "left", "right"})
      if (field.info.key == key) return;
    std::string name(field.info.key);
    std::replace(name.begin(), name.end(), '_', ' ');
    for (const std::string& word : field.words)
      lines.push_back(name + " " + word + (field.info.unit.empty() ? "" : " " + std::string(field.info.unit)));
  };
  std::visit(
      [&](const auto& plan) {
        for (const FieldWords& field : told_fields(plan)) tell(field);
      },
      job);
  return lines;
}

}  // namespace flank::internal
