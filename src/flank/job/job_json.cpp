#include "flank/job/job_json.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "flank/base/file_name.h"
#include "flank/error.h"
#include "flank/job/check_fields.h"
#include "flank/job/fields.h"

namespace flank::internal {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "openflank/job/1";

/// Earlier versions wrote the fields of a fit into the job of a cover, where they mean nothing; `strips` was not the most
/// strips of the cover. They always wrote "avoid", which a cover has not.
constexpr const char* kOnlyInOldCovers = "avoid";
constexpr const char* kIgnoredInOldCovers[] = {"avoid",      "strips",     "start",    "guide",
                                               "radius_min", "radius_max", "slope_max"};

/// A job is run again from another folder: names that are relative to this one would lead elsewhere.
std::string absolute(const std::string& file) { return std::filesystem::absolute(file).lexically_normal().string(); }

/// Names of files may be any bytes, JSON is UTF-8.
bool names_file(const FieldInfo& info) {
  return info.spelling == Spelling::kFile || info.spelling == Spelling::kFileOrText;
}

/// Text that may name a file does if there is such a file. A plain word never does: "free" is a tool, not a file.
bool is_file(const FieldInfo& info, const std::string& value) {
  if (info.spelling == Spelling::kFile) return !value.empty();
  std::error_code none;
  return value.find_first_of("/.") != std::string::npos && std::filesystem::is_regular_file(value, none);
}

Json to_json(const FieldInfo& info, const std::string& value) {
  if (!names_file(info)) return value;
  return text_of_name(is_file(info, value) ? absolute(value) : value);
}
Json to_json(const FieldInfo& info, const std::vector<std::string>& values) {
  Json list = Json::array();
  for (const std::string& value : values) list.push_back(to_json(info, value));
  return list;
}
template <class T>
Json to_json(const FieldInfo&, const T& value) {
  return value;
}

/// What is not set has no key: a reader takes the default then, as the command line does.
template <class T>
bool is_set(const T&) {
  return true;
}
template <class T>
bool is_set(const std::optional<T>& value) {
  return value.has_value();
}
bool is_set(const std::vector<std::string>& values) { return !values.empty(); }

template <class T>
const T& plain(const T& value) {
  return value;
}
template <class T>
const T& plain(const std::optional<T>& value) {
  return *value;
}

/// Back from text_of_name, for fields of files; the last overload is for all other types, which hold no names.
void decode_names(std::string& value) { value = name_of_text(value); }
void decode_names(std::vector<std::string>& values) {
  for (std::string& value : values) value = name_of_text(value);
}
void decode_names(std::optional<std::string>& value) {
  if (value) value = name_of_text(*value);
}
template <class T>
void decode_names(T&) {}

/// Numbers that JSON would round or wrap are refused, too.
template <class T>
void from_json(const Json& json, T& value) {
  if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) {
    const bool fits = json.is_number_integer() && json.get<T>() == json;
    if (!fits) throw InputError("expected a whole number");
  }
  if constexpr (std::is_same_v<T, double>) {
    if (!json.is_number()) throw InputError("expected a number");
  }
  value = json.get<T>();
}
template <class T>
void from_json(const Json& json, std::optional<T>& value) {
  T read{};
  from_json(json, read);
  value = std::move(read);
}

template <class Job>
Job read_job(const Json& json, const std::set<std::string>& ignored) {
  Job job;
  std::set<std::string> known{"schema", "units", "command"};
  visit_fields(job, [&](const FieldInfo& info, auto& value) {
    const std::string key(info.key);
    known.insert(key);
    // Without these a job asks for nothing; every other field has a default.
    const bool needed = key == "part" || key == "faces" || key == "left" || key == "right";
    if (ignored.contains(key) || (!needed && !json.contains(key))) return;
    if (!json.contains(key)) throw InputError(key + ": is missing");
    try {
      from_json(json.at(key), value);
      if (names_file(info)) decode_names(value);
    } catch (const std::exception& e) {
      throw InputError(key + ": " + e.what());
    }
  });
  if (const auto units = json.find("units"); units != json.end() && *units != "mm")
    throw InputError("units: is " + units->dump() + "; expected \"mm\"");
  // A misspelled key would be a demand that is silently not kept.
  for (const auto& [key, value] : json.items())
    if (!known.contains(key) && !ignored.contains(key)) throw InputError(key + ": unknown key");
  check_fields(job);
  return job;
}

PlanJob read_plan(const Json& json) {
  if (!json.is_object() || json.value("schema", "") != kSchema)
    throw InputError(std::string("expected schema \"") + kSchema + "\"");
  // A file that names no command is a job of a fit.
  const std::string command = json.value("command", "fit");
  if (command == "fit") return read_job<FitJob>(json, {});
  if (command == "trochoid") return read_job<TrochoidJob>(json, {});
  if (command != "cover") throw InputError("command \"" + command + "\"; expected fit, cover or trochoid");
  if (!json.contains(kOnlyInOldCovers)) return read_job<CoverJob>(json, {});
  return read_job<CoverJob>(json, {std::begin(kIgnoredInOldCovers), std::end(kIgnoredInOldCovers)});
}

}  // namespace

std::string job_to_json(const PlanJob& job) {
  Json json;
  json["schema"] = kSchema;
  json["units"] = "mm";
  std::visit(
      [&](const auto& plan) {
        json["command"] = command_name(plan);
        visit_fields(plan, [&](const FieldInfo& info, const auto& value) {
          if (is_set(value)) json[std::string(info.key)] = to_json(info, plain(value));
        });
      },
      job);
  // Texts that are no UTF-8 are bent, not refused: names of files have been made UTF-8 above.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

PlanJob job_from_json(const std::string& text, const std::string& file) {
  try {
    return read_plan(Json::parse(text));
  } catch (const nlohmann::json::exception& e) {
    throw InputError(file + ": not a job file: " + e.what());
  } catch (const Error& e) {
    throw InputError(file + ": " + e.what());
  }
}

}  // namespace flank::internal
