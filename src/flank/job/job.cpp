#include "flank/job.h"

#include <algorithm>
#include <numeric>
#include <type_traits>

#include "flank/error.h"
#include "flank/job/design_fields.h"
#include "flank/job/field_text.h"
#include "flank/job/fields.h"
#include "flank/job/wheel_fields.h"

namespace flank {
using namespace internal;
namespace {

/// The kind of a member's values, however it is wrapped.
template <class T>
FieldKind kind_of(const FieldInfo& info, const T&) {
  if (info.spelling == Spelling::kAutoOrCount) return FieldKind::kAutoOrCount;
  if (info.spelling == Spelling::kSign) return FieldKind::kSign;
  if constexpr (std::is_same_v<T, bool>) return FieldKind::kSwitch;
  if constexpr (std::is_same_v<T, std::vector<std::string>>) return FieldKind::kTexts;
  if constexpr (std::is_floating_point_v<T>) return FieldKind::kNumber;
  if constexpr (std::is_integral_v<T>) return FieldKind::kCount;
  return FieldKind::kText;
}
template <class T>
FieldKind kind_of(const FieldInfo& info, const std::optional<T>&) {
  return kind_of(info, T{});
}

template <class Job>
std::vector<JobField> fields_of() {
  std::vector<JobField> fields;
  const Job usual;
  visit_fields(usual, [&](const FieldInfo& info, const auto& value) {
    JobField field{.name = field_name(info),
                   .option = flag_of(info),
                   .unit = std::string(info.unit),
                   .group = std::string(info.group),
                   .help = std::string(info.help),
                   .accepted = std::string(info.accepted.words),
                   .kind = kind_of(info, value),
                   .needed = false,
                   .usual = {}};
    const std::vector<std::string> words = field_words(info, value);
    field.needed = info.always && (words.empty() || words.front().empty());
    if (words.size() == 1 && !words.front().empty()) field.usual = words.front();
    fields.push_back(std::move(field));
  });
  return fields;
}

/// In how many letters two words differ: changed, left out, or too many.
std::size_t letters_apart(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t before = row[0];
    row[0] = i;
    for (std::size_t k = 1; k <= b.size(); ++k) {
      const std::size_t changed = before + (a[i - 1] == b[k - 1] ? 0 : 1);
      before = row[k];
      row[k] = std::min({changed, row[k] + 1, row[k - 1] + 1});
    }
  }
  return row[b.size()];
}

/// "; did you mean tolerance_mm" of a name that forgets its unit or is misspelt; empty if none is near.
std::string meant(const std::string& name, const std::vector<std::string>& known) {
  constexpr std::size_t kMostApart = 2;
  const auto score = [&](const std::string& one) { return one.starts_with(name + "_") ? 0 : letters_apart(name, one); };
  const auto best = std::min_element(known.begin(), known.end(),
                                     [&](const std::string& a, const std::string& b) { return score(a) < score(b); });
  // Of a short word two letters are most of it.
  const bool near = best != known.end() && score(*best) <= std::min(kMostApart, name.size() / 3);
  return near ? "; did you mean " + *best : "";
}

template <class Job>
void set(Job& job, const std::string& name, const std::vector<std::string>& words) {
  bool known = false;
  std::string names;
  std::vector<std::string> all;
  visit_fields(job, [&](const FieldInfo& info, auto& member) {
    const std::string own = field_name(info);
    names += (names.empty() ? "" : ", ") + own;
    all.push_back(own);
    if (own != name) return;
    known = true;
    if constexpr (std::is_same_v<std::remove_reference_t<decltype(member)>, std::vector<std::string>>)
      member.clear();
    else if (words.size() != 1)
      throw UsageError(name, "expected one value");
    for (const std::string& word : words) read_word(info, word, member);
  });
  if (!known)
    throw UsageError(name,
                     "is not a field of " + std::string(command_name(job)) + meant(name, all) + "; expected " + names);
}

}  // namespace

std::vector<JobField> job_fields(const std::string& command) {
  if (command == command_name(FitJob{})) return fields_of<FitJob>();
  if (command == command_name(CoverJob{})) return fields_of<CoverJob>();
  if (command == command_name(TrochoidJob{})) return fields_of<TrochoidJob>();
  if (command == command_name(VerifyJob{})) return fields_of<VerifyJob>();
  if (command == command_name(PostJob{})) return fields_of<PostJob>();
  if (command == command_name(DesignJob{})) return fields_of<DesignJob>();
  if (command == command_name(WheelRequest{})) return fields_of<WheelRequest>();
  throw UsageError("command", command, "must be fit, cover, trochoid, verify, post, design or wheel");
}

void set_field(FitJob& job, const std::string& name, const std::vector<std::string>& words) { set(job, name, words); }
void set_field(CoverJob& job, const std::string& name, const std::vector<std::string>& words) { set(job, name, words); }
void set_field(TrochoidJob& job, const std::string& name, const std::vector<std::string>& words) {
  set(job, name, words);
}
void set_field(VerifyJob& job, const std::string& name, const std::vector<std::string>& words) {
  set(job, name, words);
}
void set_field(PostJob& job, const std::string& name, const std::vector<std::string>& words) { set(job, name, words); }

}  // namespace flank
