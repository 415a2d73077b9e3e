// The built command as a server, asked as a stranger would: over the network of this machine.
#include <gtest/gtest.h>
#include <httplib.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/process.h"
#include "temporary_folder.h"

namespace flank::internal {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

/// `flank studio` with a folder, and a client that has its token.
class Studio {
 public:
  explicit Studio(const fs::path& folder) {
    const std::string out = folder.string() + ".out";
    std::ofstream(out).close();
    std::vector<std::string> words{FLANK_BINARY, "studio", "-o", folder.string(), "--no-browser", "--json"};
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, 1, out.c_str(), O_WRONLY | O_TRUNC, 0);
    posix_spawn_file_actions_addopen(&files, 2, (folder.string() + ".err").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    EXPECT_EQ(posix_spawn(&process_, FLANK_BINARY, &files, nullptr, argv.data(), environ), 0);
    posix_spawn_file_actions_destroy(&files);
    for (int k = 0; k < 1000 && url_.empty(); ++k) {
      const Json said = Json::parse(cli::read_file(out), nullptr, false);
      if (said.is_object()) url_ = said.at("url");
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    if (url_.empty()) return;
    const std::size_t begin = std::string("http://").size(), slash = url_.find('/', begin);
    host_ = url_.substr(begin, slash - begin);
    port_ = std::stoi(host_.substr(host_.find(':') + 1));
    token_ = url_.substr(slash + 1, 32);
  }
  ~Studio() { end(SIGINT); }
  Studio(const Studio&) = delete;
  Studio& operator=(const Studio&) = delete;

  int end(int signal) {
    if (process_ == 0) return 0;
    ::kill(process_, signal);
    int status = 0;
    ::waitpid(process_, &status, 0);
    process_ = 0;
    return status;
  }
  [[nodiscard]] httplib::Client client() const {
    httplib::Client client("127.0.0.1", port_);
    client.set_read_timeout(60);
    return client;
  }
  [[nodiscard]] std::string at(const std::string& path) const { return "/" + token_ + "/api/" + path; }
  /// The status of an answer.
  [[nodiscard]] int get(const std::string& path, const httplib::Headers& headers = {}) const {
    const auto answer = client().Get(path, headers);
    return answer ? answer->status : -1;
  }
  [[nodiscard]] Json json(const std::string& path) const {
    const auto answer = client().Get(at(path));
    return answer && answer->status == 200 ? Json::parse(answer->body) : Json();
  }
  [[nodiscard]] httplib::Result post(const std::string& path, const std::string& body) const {
    return client().Post(at(path), body, "application/json");
  }
  /// Waits until a job is in a state.
  [[nodiscard]] Json wait(const std::string& job, const std::function<bool(const Json&)>& there) const {
    Json told;
    for (int k = 0; k < 1200; ++k) {
      told = json("jobs/" + job);
      if (told.is_object() && there(told)) return told;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    ADD_FAILURE() << told.dump(1);
    return told;
  }

  std::string url_, host_, token_;
  int port_ = 0;
  pid_t process_ = 0;
};

class StudioServer : public TemporaryFolder {
 protected:
  StudioServer() : TemporaryFolder("studio_server") {}
  /// The name of an example in the studio.
  std::string part(const Studio& studio, const std::string& example) const {
    const std::string file = (root_ / (example + ".step")).string();
    EXPECT_EQ(cli::run_program(FLANK_BINARY, {"example", example, "-o", file}, root_).exit_code, 0);
    const auto answer = studio.client().Post(studio.at("parts?name=" + example + ".step"), cli::read_file(file),
                                             "application/octet-stream");
    EXPECT_TRUE(answer && answer->status == 200) << (answer ? answer->body : "no answer");
    return answer && answer->status == 200 ? Json::parse(answer->body).at("name").get<std::string>() : "";
  }
};

TEST_F(StudioServer, RefusesStrangers) {
  const Studio studio(root_ / "studio");
  ASSERT_FALSE(studio.url_.empty());
  EXPECT_EQ(studio.get("/" + studio.token_ + "/"), 200);
  EXPECT_EQ(studio.get(studio.at("state")), 200);
  std::string wrong = studio.token_;
  wrong[0] = wrong[0] == '0' ? '1' : '0';
  EXPECT_EQ(studio.get("/" + wrong + "/api/state"), 403);
  EXPECT_EQ(studio.get("/"), 403);
  EXPECT_EQ(studio.get(studio.at("state"), {{"Host", "evil.example"}}), 403);
  EXPECT_EQ(studio.get(studio.at("state"), {{"Origin", "http://evil.example"}}), 403);
  EXPECT_EQ(studio.get(studio.at("state"), {{"Sec-Fetch-Site", "cross-site"}}), 403);
  const auto refused = studio.client().Post("/" + wrong + "/api/jobs", "{}", "application/json");
  EXPECT_TRUE(refused && refused->status == 403);
}

TEST_F(StudioServer, GivesNothingFromOutsideItsFolder) {
  const Studio studio(root_ / "studio");
  std::ofstream(root_ / "secret.txt") << "secret";
  const std::string name = part(studio, "envelope-cone-1");
  fs::create_symlink(root_ / "secret.txt", root_ / "studio/parts/link.step");
  for (const char* path : {"parts/..%2Fsecret.txt", "parts/%2Fetc%2Fpasswd", "jobs/..%2F..%2Fsecret.txt/zip",
                           "jobs/0001/files/..%2Fstudio.json", "jobs/%2E%2E/report", "parts/link.step",
                           "parts/.envelope-cone-1.step.faces.json", "../../secret.txt", "nothing"})
    EXPECT_GE(studio.get(studio.at(path)), 400) << path;
  for (const char* asked :
       {R"({"command":"fit","part":"../secret.txt","fields":{}})",
        R"({"command":"fit","part":"/etc/passwd","fields":{}})",
        R"({"command":"inspect","part":"envelope-cone-1.step","fields":{}})",
        R"({"command":"fit","part":"envelope-cone-1.step","fields":{"tool":"../secret.txt"}})",
        R"({"command":"fit","part":"envelope-cone-1.step","fields":{"guide":"/etc/passwd"}})", "no json", "[]", "{}"}) {
    const auto answer = studio.post("jobs", asked);
    EXPECT_TRUE(answer && answer->status == 400) << asked << (answer ? answer->body : "");
  }
  EXPECT_EQ(studio.json("state").at("jobs").size(), 0u);
}

TEST_F(StudioServer, BoundsWhatIsSent) {
  const Studio studio(root_ / "studio");
  // Only said to be huge: it is refused before it is read.
  auto client = studio.client();
  const auto huge = client.Post(studio.at("parts?name=huge.step"), {{"Content-Length", "9000000000"}}, "x",
                                "application/octet-stream");
  EXPECT_TRUE(!huge || huge->status == 413 || huge->status == 400) << huge->status;
  const auto question = studio.post("jobs", std::string(3 << 20, ' '));
  EXPECT_TRUE(question && question->status == 413);
  const auto empty = studio.client().Post(studio.at("parts?name=empty.step"), "", "application/octet-stream");
  EXPECT_TRUE(empty && empty->status == 400);
  const auto strange =
      studio.client().Post(studio.at("parts?name=strange.step"), "no part", "application/octet-stream");
  ASSERT_TRUE(strange && strange->status == 400);
  EXPECT_NE(strange->body.find("strange.step"), std::string::npos) << strange->body;
  EXPECT_EQ(studio.json("state").at("files").size(), 0u) << "what is no part is not kept";
  EXPECT_EQ(studio.get("/" + studio.token_ + "/" + std::string(7000, 'a')), 403);
}

TEST_F(StudioServer, OneFolderHasOneStudio) {
  const Studio first(root_ / "studio");
  const cli::Outcome second =
      cli::run_program(FLANK_BINARY, {"studio", "-o", (root_ / "studio").string(), "--no-browser"}, root_);
  EXPECT_EQ(second.exit_code, 3);
  EXPECT_NE(second.err.find("another studio uses this folder"), std::string::npos) << second.err;
}

TEST_F(StudioServer, AKilledStudioLosesNothing) {
  const fs::path folder = root_ / "studio";
  std::string id, waiting;
  {
    Studio studio(folder);
    const std::string name = part(studio, "envelope-cone-1");
    const Json asked{{"command", "fit"}, {"part", name}, {"fields", {{"tolerance_mm", "0.05"}, {"effort", "quick"}}}};
    id = Json::parse(studio.post("jobs", asked.dump())->body).at("id");
    waiting = Json::parse(studio.post("jobs", asked.dump())->body).at("id");
    (void)studio.wait(id, [](const Json& job) { return job.at("state") == "running"; });
    studio.end(SIGKILL);
  }
  const Studio again(folder);
  const auto done = [](const Json& job) { return job.at("state") == "done"; };
  const Json first = again.wait(id, done), second = again.wait(waiting, done);
  EXPECT_EQ(first.at("exit"), 0) << first.dump(1);
  EXPECT_EQ(second.at("exit"), 0) << second.dump(1);
  EXPECT_EQ(again.client().Get(again.at("jobs/" + id + "/files/tool.json"))->body,
            again.client().Get(again.at("jobs/" + waiting + "/files/tool.json"))->body);
  EXPECT_EQ(cli::read_file(folder / "jobs" / id / "result/path.json"),
            again.client().Get(again.at("jobs/" + id + "/files/path.json"))->body);
}

TEST_F(StudioServer, EndsItsChildrenWithItself) {
  const fs::path folder = root_ / "studio";
  Studio studio(folder);
  const std::string name = part(studio, "twisted-blade");
  const Json asked{{"command", "fit"}, {"part", name}, {"fields", {{"tolerance_mm", "0.005"}}}};
  const std::string id = Json::parse(studio.post("jobs", asked.dump())->body).at("id");
  // Before there is a best a stop leaves nothing to go on from.
  (void)studio.wait(id, [](const Json& job) {
    const Json& told = job.at("progress");
    return std::any_of(told.begin(), told.end(),
                       [](const Json& line) { return !line.value("best", Json()).is_null(); });
  });
  EXPECT_EQ(studio.end(SIGINT), 0);
  const Json kept = Json::parse(cli::read_file(folder / "jobs" / id / "studio.json"));
  EXPECT_EQ(kept.at("state"), "done");
  EXPECT_TRUE(fs::exists(folder / "jobs" / id / "result/resume.json")) << "it can go on";
}

TEST_F(StudioServer, AStopIsHeardHoweverEarlyItComes) {
  const Studio studio(root_ / "studio");
  const std::string name = part(studio, "envelope-cone-1");
  const Json asked{{"command", "fit"}, {"part", name}, {"fields", {{"tolerance_mm", "0.05"}, {"effort", "quick"}}}};
  const auto done = [](const Json& job) { return job.at("state") == "done"; };
  std::string id;
  for (int k = 0; k < 5; ++k) {
    id = Json::parse(studio.post("jobs", asked.dump())->body).at("id");
    (void)studio.wait(id, [](const Json& job) { return job.at("state") == "running"; });
    (void)studio.post("jobs/" + id + "/stop", "");
    const Json stopped = studio.wait(id, done);
    EXPECT_EQ(stopped.at("exit"), 1) << "not ended by the signal: " << stopped.dump(1);
    EXPECT_EQ(stopped.at("crash"), "");
    EXPECT_EQ(stopped.at("resumable"), true) << "it had nothing yet, and can be begun again";
  }
  (void)studio.post("jobs/" + id + "/resume", "");
  EXPECT_EQ(studio.wait(id, [&](const Json& job) { return done(job) && job.at("exit") == 0; }).at("resumable"), false);
}

TEST_F(StudioServer, ClearsWhatAKilledOneWasInTheMiddleOf) {
  const fs::path folder = root_ / "studio";
  fs::create_directories(folder / "parts");
  fs::create_directories(folder / ".said-AbCdEf");
  std::ofstream(folder / ".said-AbCdEf/out") << "half";
  std::ofstream(folder / "parts/.half-7") << "half";
  std::ofstream(folder / "parts/kept.step") << "whole";
  const Studio studio(folder);
  EXPECT_FALSE(fs::exists(folder / ".said-AbCdEf"));
  EXPECT_FALSE(fs::exists(folder / "parts/.half-7"));
  EXPECT_TRUE(fs::exists(folder / "parts/kept.step"));
}

}  // namespace
}  // namespace flank::internal
