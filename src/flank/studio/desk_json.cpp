#include "flank/studio/desk_json.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "flank/base/atomic_file.h"
#include "flank/error.h"
#include "flank/job/fields_json.h"
#include "flank/studio/words_json.h"
#include "flank/studio/zip.h"

namespace flank::internal {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

/// Beside a part: its faces.
constexpr const char* kFaces = ".faces.json";

std::string absolute(const std::string& folder) {
  fs::create_directories(folder);
  return fs::canonical(folder).string();
}

/// Of an existing folder, for one studio at a time.
int locked(const std::string& folder) {
  const std::string file = folder + "/.studio.lock";
  const int lock = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (lock < 0) throw InputError(folder + ": cannot be written");
  if (::flock(lock, LOCK_EX | LOCK_NB) != 0) {
    ::close(lock);
    throw InputError(folder + ": another studio uses this folder; give another one");
  }
  return lock;
}

/// Removes what has a name with this beginning.
void remove_begun(const std::string& folder, const std::string& beginning) {
  std::vector<fs::path> begun;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename().string().starts_with(beginning)) begun.push_back(entry.path());
  std::error_code ignored;
  for (const fs::path& path : begun) fs::remove_all(path, ignored);
}

/// The bytes of a file in a folder of ours; links are not followed.
std::string read_in(const std::string& folder, const std::string& name) {
  const fs::path file = fs::path(folder) / name;
  if (!is_plain_name(name) || !fs::is_regular_file(fs::symlink_status(file))) throw InputError("no such file: " + name);
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The last line of what a command complains of, without its name.
std::string complaint(const Said& said) {
  std::string text = said.err;
  while (!text.empty() && text.back() == '\n') text.pop_back();
  const std::size_t at = text.rfind('\n');
  if (at != std::string::npos) text.erase(0, at + 1);
  constexpr std::string_view kName = "flank: ";
  if (text.starts_with(kName)) text.erase(0, kName.size());
  const std::string crash = crash_text(said.exit_code);
  return crash.empty() ? text : crash;
}

Answer told(const Said& said, Json json) {
  json["exit"] = said.exit_code;
  json["said"] = said.out;
  json["complaint"] = said.exit_code == 0 || said.exit_code == 1 ? "" : complaint(said);
  return {json.dump(-1, ' ', false, Json::error_handler_t::replace), "application/json", ""};
}

std::string text_at(const Json& json, const char* key) {
  const auto found = json.is_object() ? json.find(key) : json.end();
  if (!json.is_object() || found == json.end() || !found->is_string()) throw UsageError(key, "expected a text");
  return found->get<std::string>();
}

std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none))
    if (entry.is_regular_file() && is_plain_name(entry.path().filename())) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

using NamedFiles = std::vector<std::pair<std::string, std::string>>;

/// The files of a folder and of those in it, as a wheel has, with their ways in it; links are not followed.
void add_files(const std::string& folder, const std::string& way, NamedFiles& files) {
  for (const std::string& name : names_in(folder)) files.emplace_back(way + name, read_in(folder, name));
  std::vector<std::string> inner;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none))
    if (fs::is_directory(entry.symlink_status())) inner.push_back(entry.path().filename());
  std::sort(inner.begin(), inner.end());
  for (const std::string& name : inner) add_files(folder + "/" + name, way + name + "/", files);
}

}  // namespace

Desk::Desk(const std::string& folder, std::string program)
    : folder_{absolute(folder)}, program_(std::move(program)), lock_(locked(folder_.path)), jobs_(folder_, program_) {
  fs::create_directories(folder_.files());
  // The folder is ours alone: what an earlier studio was in the middle of when it was killed is nobody's.
  remove_begun(folder_.path, kScratch);
  remove_begun(folder_.files(), kHalf);
}

Desk::~Desk() { ::close(lock_); }

Said Desk::ask(const std::vector<std::string>& words) const {
  return run_child(program_, words, folder_.path, {}, ended_);
}

std::string Desk::new_file(const std::string& name) const {
  const fs::path plain = plain_name(name), stem = plain.stem();
  std::string file = plain.string();
  for (int k = 2; fs::exists(fs::path(folder_.files()) / file); ++k)
    file = stem.string() + "-" + std::to_string(k) + plain.extension().string();
  return file;
}

void Desk::look_at(const std::string& part, const std::string& unit) {
  std::vector<std::string> words{"inspect", folder_.files() + "/" + part, "--quiet", "--view",
                                 folder_.files() + "/." + part + kFaces};
  if (!unit.empty()) words.push_back("--unit=" + unit);
  const Said said = ask(words);
  if (said.exit_code != 0) throw InputError(complaint(said));
}

Answer Desk::faces(const std::string& part) const {
  const std::string file = folder_.files() + "/." + part + kFaces;
  if (!is_plain_name(part) || !fs::is_regular_file(file)) throw InputError("no such part: " + part);
  std::ifstream stream(file, std::ios::binary);
  return {{std::istreambuf_iterator<char>(stream), {}}, "application/json", ""};
}

Answer Desk::wheel(const std::string& part) const {
  (void)faces(part);
  const Said said = ask({"inspect", folder_.files() + "/" + part, "--wheel", "--json"});
  if (said.exit_code != 0) throw InputError(complaint(said));
  return {said.out, "application/json", ""};
}

Answer Desk::state() {
  Json json = {{"folder", folder_.path}, {"parts", Json::array()}, {"files", names_in(folder_.files())}};
  for (const std::string& name : names_in(folder_.files()))
    if (fs::exists(folder_.files() + "/." + name + kFaces)) json["parts"].push_back(name);
  json["jobs"] = jobs_.list();
  return {json.dump(-1, ' ', false, Json::error_handler_t::replace), "application/json", ""};
}

Answer Desk::fields(const std::string& command) const { return {fields_json(command), "application/json", ""}; }

Answer Desk::machines() const {
  const Said said = ask({"machine", "--list", "--json"});
  if (said.exit_code != 0) throw InputError(complaint(said));
  return {said.out, "application/json", ""};
}

Answer Desk::defaults(const Json& asked) const {
  const std::string part = text_at(asked, "part");
  (void)read_in(folder_.files(), part);
  std::vector<std::string> words{"fit", folder_.files() + "/" + part, "--dry-run", "--json"};
  for (std::string& word : option_words("fit", asked.value("fields", Json::object()), folder_.files(), {"part"}))
    words.push_back(std::move(word));
  const Said said = ask(words);
  Json json;
  json["defaults"] = said.exit_code == 0 ? Json::parse(said.out, nullptr, false) : Json();
  return told(said, std::move(json));
}

Answer Desk::report(const std::string& job, const std::string& operation) {
  std::string result = jobs_.result(job);
  if (!operation.empty()) {
    result += "/ops/" + operation;
    if (!is_plain_name(operation) || !fs::is_directory(fs::symlink_status(result)))
      throw InputError("no such operation: " + operation);
  }
  const Said said = ask({"report", result, "--quiet"});
  if (said.exit_code != 0) throw InputError(complaint(said));
  return {read_in(result, "report.html"), "text/html; charset=utf-8", ""};
}

Answer Desk::post(const std::string& job, const Json& asked) {
  const std::string machine = text_at(asked.value("fields", Json::object()), "machine");
  const std::string name = plain_name(job + "-" + machine + ".nc");
  const std::string file = jobs_.programs(job) + "/" + name;
  std::vector<std::string> words{"post", jobs_.result(job), "-o", file};
  for (std::string& word : option_words("post", asked.at("fields"), folder_.files(), {"folder", "part"}))
    words.push_back(std::move(word));
  std::vector<std::string> line{"flank", "post", "out"};
  line.insert(line.end(), words.begin() + 4, words.end());
  line.insert(line.end(), {"-o", name});
  const Said said = ask(words);
  return told(said, {{"program", fs::is_regular_file(file) ? Json(name) : Json()}, {"line", shell_line(line)}});
}

Answer Desk::judge(const std::string& job, const Json& asked) {
  const std::string name = text_at(asked, "program"), machine = text_at(asked, "machine");
  (void)read_in(jobs_.programs(job), name);
  std::vector<std::string> words{"verify", jobs_.result(job), "--nc", jobs_.programs(job) + "/" + name};
  for (std::string& word : option_words("verify", {{"machine", machine}}, folder_.files(), {}))
    words.push_back(std::move(word));
  return told(ask(words), Json::object());
}

Answer Desk::sheet(const std::string& job, const Json& asked) {
  const std::string program = text_at(asked, "program"), folder = jobs_.programs(job);
  (void)read_in(folder, program);
  const std::string name = fs::path(program).stem().string() + ".html";
  std::vector<std::string> words{"setup", jobs_.result(job), "--nc", folder + "/" + program, "-o", folder + "/" + name};
  for (std::string& word : option_words("verify", {{"machine", text_at(asked, "machine")}}, folder_.files(), {}))
    words.push_back(std::move(word));
  const Said said = ask(words);
  return told(said, {{"sheet", fs::is_regular_file(folder + "/" + name) ? Json(name) : Json()}});
}

Answer Desk::file(const std::string& job, const std::string& name) {
  return {read_in(jobs_.result(job), name), "application/octet-stream", name};
}

Answer Desk::program(const std::string& job, const std::string& name) {
  return {read_in(jobs_.programs(job), name), "application/octet-stream", name};
}

Answer Desk::zip(const std::string& job) {
  NamedFiles files;
  for (const std::string& folder : {jobs_.result(job), jobs_.programs(job)}) add_files(folder, "", files);
  return {zip_of(files), "application/zip", plain_name("openflank-" + job + ".zip")};
}

}  // namespace flank::internal
