#include "flank/job/input_files.h"

#include "flank/job/field_text.h"
#include "flank/job/fields.h"

namespace flank::internal {

std::vector<std::string> input_files(const PlanJob& job) {
  std::vector<std::string> names;
  const auto collect = [&](const FieldInfo& info, const auto& value) {
    if (info.spelling != Spelling::kFile && info.spelling != Spelling::kFileOrText) return;
    for (const std::string& word : field_words(info, value)) names.push_back(word);
  };
  std::visit([&](const auto& plan) { visit_fields(plan, collect); }, job);
  return names;
}

}  // namespace flank::internal
