#include "flank/job/check_fields.h"

#include "flank/error.h"
#include "flank/job/bound_fields.h"
#include "flank/job/correct_fields.h"
#include "flank/job/design_fields.h"
#include "flank/job/field_text.h"
#include "flank/job/fields.h"
#include "flank/job/redesign_fields.h"
#include "flank/job/wheel_fields.h"

namespace flank::internal {
namespace {

bool is_accepted(const Accepted& accepted, const std::string& value) { return !accepted.text || accepted.text(value); }
bool is_accepted(const Accepted& accepted, double value) { return !accepted.number || accepted.number(value); }
bool is_accepted(const Accepted&, bool) { return true; }
bool is_accepted(const Accepted&, std::uint64_t) { return true; }
bool is_accepted(const Accepted& accepted, int value) { return is_accepted(accepted, static_cast<double>(value)); }
bool is_accepted(const Accepted& accepted, const std::vector<std::string>& values) {
  for (const std::string& value : values)
    if (!is_accepted(accepted, value)) return false;
  return true;
}
template <class T>
bool is_accepted(const Accepted& accepted, const std::optional<T>& value) {
  return !value || is_accepted(accepted, *value);
}

template <class Job>
void check(const Job& job) {
  visit_fields(job, [](const FieldInfo& info, const auto& value) {
    if (is_accepted(info.accepted, value)) return;
    throw UsageError(field_name(info), field_words(info, value).front(), std::string(info.accepted.words));
  });
}

}  // namespace

void check_fields(const FitJob& job) { check(job); }
void check_fields(const CoverJob& job) { check(job); }
void check_fields(const TrochoidJob& job) { check(job); }
void check_fields(const VerifyJob& job) { check(job); }
void check_fields(const PostJob& job) { check(job); }
void check_fields(const DesignJob& job) { check(job); }
void check_fields(const BoundJob& job) { check(job); }
void check_fields(const CorrectJob& job) { check(job); }
void check_fields(const RedesignJob& job) { check(job); }
void check_fields(const WheelRequest& job) { check(job); }

}  // namespace flank::internal
