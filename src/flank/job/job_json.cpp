#include "flank/job/job_json.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "flank/error.h"

namespace flank::internal {
namespace {

constexpr const char* kSchema = "openflank/job/1";

template <typename T>
void put(nlohmann::ordered_json& json, const char* key, const std::optional<T>& value) {
  if (value) json[key] = *value;
}

template <typename T>
std::optional<T> take(const nlohmann::json& json, const char* key) {
  if (!json.contains(key)) return std::nullopt;
  return json.at(key).get<T>();
}

void put_clearance(nlohmann::ordered_json& json, const ClearanceJob& job) {
  put(json, "shank_radius", job.shank_radius_mm);
  put(json, "shank_length", job.shank_length_mm);
  put(json, "holder", job.holder);
  put(json, "clearance", job.required_mm);
  for (const std::string& file : job.fixtures)
    json["fixtures"].push_back(std::filesystem::absolute(file).lexically_normal().string());
}

ClearanceJob take_clearance(const nlohmann::json& json) {
  ClearanceJob job;
  job.shank_radius_mm = take<double>(json, "shank_radius");
  job.shank_length_mm = take<double>(json, "shank_length");
  job.holder = take<std::string>(json, "holder");
  job.required_mm = take<double>(json, "clearance");
  if (json.contains("fixtures")) job.fixtures = json.at("fixtures").get<std::vector<std::string>>();
  return job;
}

}  // namespace

std::string job_to_json(const FitJob& job) {
  nlohmann::ordered_json json;
  json["schema"] = kSchema;
  json["units"] = "mm";
  json["command"] = job.command;
  json["part"] = std::filesystem::absolute(job.part).lexically_normal().string();
  put(json, "unit", job.unit);
  json["faces"] = job.faces;
  put(json, "side", job.side);
  json["tool"] = job.tool;
  put(json, "start", job.start);
  put(json, "guide", job.guide);
  json["strips"] = job.strips;
  json["tolerance"] = job.tolerance_mm;
  put(json, "axis_length", job.axis_length_mm);
  put(json, "radius_min", job.radius_min_mm);
  put(json, "radius_max", job.radius_max_mm);
  json["slope_max"] = job.slope_max;
  json["coverage"] = job.least_coverage;
  put(json, "sample", job.sample_mm);
  put(json, "reach_radius", job.reach_radius_mm);
  put(json, "check_faces", job.check.only);
  put(json, "ignore_faces", job.check.ignored);
  json["avoid"] = job.avoid;
  put_clearance(json, job.clearance);
  return json.dump(2) + "\n";
}

FitJob job_from_json(const std::string& text, const std::string& file) {
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    if (json.value("schema", "") != kSchema) throw InputError(file + ": schema \"" + kSchema + "\" is needed");
    FitJob job;
    job.command = json.value("command", job.command);
    job.part = json.at("part").get<std::string>();
    job.unit = take<std::string>(json, "unit");
    job.faces = json.at("faces").get<std::string>();
    job.side = take<int>(json, "side");
    job.tool = json.value("tool", job.tool);
    job.start = take<std::string>(json, "start");
    job.guide = take<std::string>(json, "guide");
    job.strips = json.value("strips", job.strips);
    job.tolerance_mm = json.at("tolerance").get<double>();
    job.axis_length_mm = take<double>(json, "axis_length");
    job.radius_min_mm = take<double>(json, "radius_min");
    job.radius_max_mm = take<double>(json, "radius_max");
    job.slope_max = json.value("slope_max", job.slope_max);
    job.least_coverage = json.value("coverage", job.least_coverage);
    job.sample_mm = take<double>(json, "sample");
    job.reach_radius_mm = take<double>(json, "reach_radius");
    job.check = {take<std::string>(json, "check_faces"), take<std::string>(json, "ignore_faces")};
    job.avoid = json.value("avoid", job.avoid);
    job.clearance = take_clearance(json);
    return job;
  } catch (const nlohmann::json::exception& e) {
    throw InputError(file + ": not a job file: " + e.what());
  }
}

}  // namespace flank::internal
