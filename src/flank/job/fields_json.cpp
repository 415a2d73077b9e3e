#include "flank/job/fields_json.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "flank/job.h"
#include "flank/job/design_fields.h"
#include "flank/job/field_text.h"
#include "flank/job/fields.h"
#include "flank/job/wheel_fields.h"

namespace flank::internal {
namespace {

using Json = nlohmann::ordered_json;

const char* name_of(FieldKind kind) {
  switch (kind) {
    case FieldKind::kText:
      return "text";
    case FieldKind::kTexts:
      return "texts";
    case FieldKind::kNumber:
      return "number";
    case FieldKind::kCount:
      return "count";
    case FieldKind::kAutoOrCount:
      return "auto or count";
    case FieldKind::kSign:
      return "sign";
    case FieldKind::kSwitch:
      return "switch";
  }
  return "text";
}

/// What the table knows of a field beyond what a user of the library needs.
struct Written {
  std::string key;
  bool names_file = false, may_name_file = false;
  bool flag = false;  ///< the option stands alone
};

template <class Job>
std::map<std::string, Written> written() {
  std::map<std::string, Written> all;
  const Job usual;
  visit_fields(usual, [&](const FieldInfo& info, const auto&) {
    all[field_name(info)] = {std::string(info.key), info.spelling == Spelling::kFile,
                             info.spelling == Spelling::kFileOrText, info.spelling == Spelling::kFlag};
  });
  return all;
}

std::map<std::string, Written> written_of(const std::string& command) {
  if (command == "cover") return written<CoverJob>();
  if (command == "trochoid") return written<TrochoidJob>();
  if (command == "verify") return written<VerifyJob>();
  if (command == "post") return written<PostJob>();
  if (command == "design") return written<DesignJob>();
  if (command == "wheel") return written<WheelRequest>();
  return written<FitJob>();
}

Json to_json(const JobField& field, const Written& words, const std::vector<std::string>& basic) {
  const auto place = std::find(basic.begin(), basic.end(), words.key);
  Json json = {
      {"name", field.name},          {"key", words.key},     {"option", field.option},       {"unit", field.unit},
      {"kind", name_of(field.kind)}, {"group", field.group}, {"basic", place != basic.end()}};
  if (place != basic.end()) json["place"] = place - basic.begin() + 1;
  json["needed"] = field.needed;
  json["default"] = field.usual ? Json(*field.usual) : Json();
  json["file"] = words.names_file ? Json(true) : words.may_name_file ? Json("or text") : Json(false);
  if (words.flag) json["flag"] = true;
  json["help"] = field.help;
  json["accepted"] = field.accepted;
  if (const auto choices = choices_of(field.accepted); !choices.empty()) json["choices"] = choices;
  return json;
}

}  // namespace

const std::vector<std::string>& basic_fields(const std::string& command) {
  static const std::map<std::string, std::vector<std::string>> kBasic = {
      {"fit", {"tolerance", "side", "tool", "axis_length", "effort", "shank_length", "holder", "clearance"}},
      {"cover", {"tool", "tolerance", "side", "axis_length", "strips", "shank_length", "holder", "clearance"}},
      {"trochoid", {"tolerance", "tool", "axis_length", "max_engagement", "cut", "entry", "shank_length", "holder"}},
      {"verify", {"tolerance", "nc", "machine", "setup"}},
      {"design", {"tolerance", "tools", "source", "shape", "axis_length", "tool_change"}},
      {"wheel", {"tolerance", "coverage", "effort", "tool", "holder", "rough", "edges", "blank"}},
      {"post", {"machine", "spindle", "feed", "speed", "order", "setup", "tool_length", "dry"}}};
  static const std::vector<std::string> kNone;
  const auto found = kBasic.find(command);
  return found == kBasic.end() ? kNone : found->second;
}

std::vector<std::string> choices_of(const std::string& accepted) {
  constexpr std::string_view kBegin = "must be ", kOr = " or ";
  if (!accepted.starts_with(kBegin)) return {};
  std::string rest = accepted.substr(kBegin.size());
  const std::size_t last = rest.rfind(kOr);
  if (last == std::string::npos) return {};
  rest.replace(last, kOr.size(), ", ");
  std::vector<std::string> choices;
  for (std::size_t at = 0; at != std::string::npos;) {
    const std::size_t end = rest.find(", ", at);
    choices.push_back(rest.substr(at, end == std::string::npos ? end : end - at));
    at = end == std::string::npos ? end : end + 2;
  }
  return choices;
}

std::string fields_json(const std::string& command) {
  const std::vector<JobField> fields = job_fields(command);
  const std::map<std::string, Written> words = written_of(command);
  Json list = Json::array();
  for (const JobField& field : fields) list.push_back(to_json(field, words.at(field.name), basic_fields(command)));
  return Json{{"schema", "openflank/fields/1"}, {"command", command}, {"fields", std::move(list)}}.dump(2) + "\n";
}

}  // namespace flank::internal
