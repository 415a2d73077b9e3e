#include "flank/studio/job_file_json.h"

#include <fstream>

#include "flank/error.h"

namespace flank::internal {
namespace {

using Json = nlohmann::json;

constexpr const char* kSchema = "openflank/studio/1";

JobState state_of(const std::string& name) {
  for (const JobState state : {JobState::kWaiting, JobState::kRunning})
    if (name == name_of(state)) return state;
  return JobState::kDone;
}

}  // namespace

const char* name_of(JobState state) {
  switch (state) {
    case JobState::kWaiting:
      return "waiting";
    case JobState::kRunning:
      return "running";
    case JobState::kDone:
      return "done";
  }
  return "done";
}

Json to_json(const StudioJob& job) {
  Json json = {{"schema", kSchema},
               {"id", job.id},
               {"command", job.command},
               {"part", job.part},
               {"fields", job.fields},
               {"words", job.words},
               {"line", job.line},
               {"state", name_of(job.state)},
               {"resume", job.resume},
               {"stopping", job.stopping},
               {"process", job.child.process},
               {"process_begun", job.child.begun},
               {"seconds", job.seconds},
               {"begun", job.begun}};
  json["exit"] = job.exit_code ? Json(*job.exit_code) : Json();
  return json;
}

StudioJob job_from(const Json& json, const std::string& file) {
  try {
    if (json.at("schema") != kSchema) throw InputError(file + ": is not a job of the studio");
    StudioJob job;
    json.at("id").get_to(job.id);
    json.at("command").get_to(job.command);
    json.at("part").get_to(job.part);
    job.fields = json.at("fields");
    json.at("words").get_to(job.words);
    json.at("line").get_to(job.line);
    job.state = state_of(json.at("state").get<std::string>());
    json.at("resume").get_to(job.resume);
    json.at("stopping").get_to(job.stopping);
    json.at("process").get_to(job.child.process);
    json.at("process_begun").get_to(job.child.begun);
    json.at("seconds").get_to(job.seconds);
    json.at("begun").get_to(job.begun);
    if (!json.at("exit").is_null()) job.exit_code = json.at("exit").get<int>();
    return job;
  } catch (const Json::exception&) {
    throw InputError(file + ": is not a job of the studio");
  }
}

ProgressLines read_progress(const std::string& file, std::size_t from, std::size_t most) {
  ProgressLines read;
  read.next = from;
  std::ifstream stream(file, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(from));
  if (!stream) return read;
  for (std::string line; read.next < from + most && std::getline(stream, line) && !stream.eof();) {
    read.next += line.size() + 1;
    Json one = Json::parse(line, nullptr, false);
    if (one.is_object())
      read.lines.push_back(std::move(one));
    else if (!line.empty())
      read.message = line;
  }
  return read;
}

}  // namespace flank::internal
