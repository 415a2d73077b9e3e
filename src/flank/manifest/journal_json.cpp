#include "flank/manifest/journal_json.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "flank/error.h"

namespace flank::internal {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "openflank/resume/1";
/// JSON has no infinite numbers.
constexpr const char *kInfinite = "inf", *kMinusInfinite = "-inf";

Json to_json(double number) {
  if (std::isfinite(number)) return number;
  return number > 0.0 ? kInfinite : kMinusInfinite;
}

Json to_json(const JournalStep& step) {
  Json numbers = Json::array();
  for (const double number : step.result.numbers) numbers.push_back(to_json(number));
  return {{"name", step.name}, {"inputs", step.inputs}, {"numbers", std::move(numbers)}, {"texts", step.result.texts}};
}

double number_of(const Json& json) {
  if (json == kInfinite) return std::numeric_limits<double>::infinity();
  if (json == kMinusInfinite) return -std::numeric_limits<double>::infinity();
  if (!json.is_number()) throw InputError("expected a number, not " + json.dump().substr(0, 20));
  return json.get<double>();
}

std::string hash_of(const Json& json) {
  constexpr std::size_t kDigits = 64;
  auto text = json.get<std::string>();
  if (text.size() != kDigits || text.find_first_not_of("0123456789abcdef") != std::string::npos)
    throw InputError("expected 64 hexadecimal digits");
  return text;
}

void require_size(const Json& object, std::size_t size) {
  if (object.size() != size) throw InputError("unknown keys");
}

JournalStep step_of(const Json& json) {
  JournalStep step{json.at("name").get<std::string>(), hash_of(json.at("inputs")), {}};
  const Json& numbers = json.at("numbers");
  if (!numbers.is_array()) throw InputError("\"numbers\": expected a list");
  step.result.numbers.reserve(numbers.size());
  for (const Json& number : numbers) step.result.numbers.push_back(number_of(number));
  step.result.texts = json.at("texts").get<std::vector<std::string>>();
  require_size(json, 4);
  return step;
}

Journal read(const Json& json, const std::string& file) {
  if (json.at("schema").get<std::string>() != kSchema)
    throw InputError(std::string("expected schema \"") + kSchema + "\"");
  JournalKey key{json.at("version").get<std::string>(), hash_of(json.at("job")), hash_of(json.at("part"))};
  const Json& all = json.at("steps");
  if (!all.is_array()) throw InputError("\"steps\": expected a list");
  std::vector<JournalStep> steps;
  for (const Json& step : all) {
    try {
      steps.push_back(step_of(step));
    } catch (const std::exception& error) {
      throw InputError("step " + std::to_string(steps.size() + 1) + ": " + error.what());
    }
  }
  require_size(json, 5);
  return {std::move(key), std::move(steps), file};
}

}  // namespace

std::string journal_to_json(const Journal& journal) {
  const JournalKey key = journal.key().value();
  Json json = {
      {"schema", kSchema}, {"version", key.version}, {"job", key.job}, {"part", key.part}, {"steps", Json::array()}};
  for (const JournalStep& step : journal.steps()) json["steps"].push_back(to_json(step));
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Journal journal_from_json(std::string_view text, const std::string& file) {
  try {
    return read(Json::parse(text), file);
  } catch (const nlohmann::json::exception& error) {
    throw InputError(file + ": not the steps of a run: " + error.what());
  } catch (const InputError& error) {
    throw InputError(file + ": " + error.what());
  }
}

}  // namespace flank::internal
