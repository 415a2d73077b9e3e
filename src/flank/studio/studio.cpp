// The network of the studio; what is answered is made in desk_json.cpp.
#include "flank/studio/studio.h"

#include <fmt/format.h>
#include <httplib.h>
#include <sys/socket.h>

#include <atomic>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <memory>
#include <thread>
#include <vector>

#include "flank/base/atomic_file.h"
#include "flank/error.h"
#include "flank/report.h"
#include "flank/report/page_template.h"
#include "flank/studio/desk_json.h"
#include "flank/studio/guard.h"
#include "flank/studio/words_json.h"
#include "flank/version.h"

namespace flank::internal {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr const char* kLoopback = "127.0.0.1";
constexpr std::size_t kMostUpload = std::size_t{512} << 20, kMostQuestion = std::size_t{1} << 20, kMostPath = 1000;
constexpr std::chrono::milliseconds kLook{100};
constexpr std::time_t kSilent = 2;    // seconds
constexpr std::size_t kThreads = 24;  // most of them wait for a child
constexpr int kRefused = 403, kUnknown = 404, kWrong = 400, kTooLarge = 413, kFault = 500;

std::vector<std::string> segments(const std::string& path) {
  std::vector<std::string> all;
  for (std::size_t at = 1; at <= path.size();) {
    const std::size_t end = std::min(path.find('/', at), path.size());
    all.push_back(path.substr(at, end - at));
    at = end + 1;
  }
  return all;
}

/// "/api/jobs/0001/stop" as the way "jobs/*/stop" and the names in it; empty for what is none of ours.
struct Way {
  std::string pattern;
  std::vector<std::string> names;
};

Way way_of(const std::string& path) {
  const std::vector<std::string> parts = segments(path);
  if (parts.size() < 2 || parts.front() != "api") return {};
  Way way;
  // Every second word is a name.
  for (std::size_t k = 1; k < parts.size(); ++k) {
    const bool name = k % 2 == 0;
    if (name && !is_plain_name(parts[k])) return {};
    if (name) way.names.push_back(parts[k]);
    way.pattern += (k == 1 ? "" : "/") + (name ? "*" : parts[k]);
  }
  return way;
}

void say(httplib::Response& response, Answer answer) {
  response.status = 200;
  if (!answer.name.empty()) {
    std::string name;
    for (const char c : answer.name) name += c == '"' || static_cast<unsigned char>(c) > 126 ? '_' : c;
    response.set_header("Content-Disposition", "attachment; filename=\"" + name + "\"");
  }
  // A file of a result is no page of ours, whatever is in it.
  const bool page = answer.type.starts_with("text/html");
  response.set_header("Content-Security-Policy",
                      page ? "frame-ancestors 'self'" : "default-src 'none'; sandbox; frame-ancestors 'none'");
  // As a whole the library would pack it as tightly as it can, which takes seconds, and the way is a short one.
  const auto body = std::make_shared<const std::string>(std::move(answer.body));
  if (body->empty()) return response.set_content("", answer.type);
  response.set_content_provider(body->size(), answer.type,
                                [body](std::size_t from, std::size_t size, httplib::DataSink& sink) {
                                  return sink.write(body->data() + from, size);
                                });
}

void refuse(httplib::Response& response, int status, const std::string& why) {
  response.status = status;
  response.set_content(Json{{"error", why}}.dump(-1, ' ', false, Json::error_handler_t::replace), "application/json");
}

/// Calls work(), and says what goes wrong.
template <class Work>
void answered(httplib::Response& response, const Work& work) {
  try {
    work();
  } catch (const UsageError& e) {
    refuse(response, kWrong, e.what());
  } catch (const InputError& e) {
    refuse(response, kWrong, e.what());
  } catch (const Json::exception&) {
    refuse(response, kWrong, "unknown request");
  } catch (const std::exception& e) {
    refuse(response, kFault, e.what());
  }
}

class Server {
 public:
  Server(Desk& desk, std::string first_part) : desk_(desk), first_part_(std::move(first_part)), token_(new_token()) {}

  /// The address of the page.
  std::string bind(int port) {
    server_.set_socket_options([](socket_t socket) {
      const int on = 1;
      // Not SO_REUSEPORT, with which another process could listen at the same place.
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    });
    port_ = port > 0 ? (server_.bind_to_port(kLoopback, port) ? port : -1) : server_.bind_to_any_port(kLoopback);
    if (port_ <= 0) throw InputError("port " + std::to_string(port) + " is taken; give another one, or none");
    server_.set_payload_max_length(kMostUpload);
    // A refused question is not read to its end: nothing may follow it on the same line.
    server_.set_keep_alive_max_count(1);
    // Browsers open connections ahead, and say nothing on them: each holds a thread for as long.
    server_.set_keep_alive_timeout(kSilent);
    server_.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
    server_.set_default_headers({{"X-Content-Type-Options", "nosniff"},
                                 {"Referrer-Policy", "no-referrer"},
                                 {"Cross-Origin-Resource-Policy", "same-origin"},
                                 {"Cross-Origin-Opener-Policy", "same-origin"},
                                 {"Cache-Control", "no-store"}});
    server_.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      return at_the_door(request, response);
    });
    server_.Post(".*", [this](const httplib::Request& request, httplib::Response& response,
                              const httplib::ContentReader& reader) {
      answered(response, [&] { post(request, response, reader); });
    });
    return fmt::format("http://{}:{}/{}/", kLoopback, port_, token_);
  }

  void serve(const std::function<bool()>& cancelled) {
    std::atomic<bool> ended{false};
    std::thread watch([&] {
      while (!ended && !cancelled()) std::this_thread::sleep_for(kLook);
      // A judge may take minutes, and the server waits for whoever answers.
      desk_.end();
      server_.stop();
    });
    server_.listen_after_bind();
    ended = true;
    watch.join();
  }

 private:
  using Handled = httplib::Server::HandlerResponse;

  Handled at_the_door(const httplib::Request& request, httplib::Response& response) {
    const std::string path = path_of(request);
    if (path.empty()) {
      refuse(response, kRefused, "wrong key in the address; the terminal shows the right address");
      return Handled::Handled;
    }
    if (request.method == "POST") return Handled::Unhandled;
    if (request.method != "GET" && request.method != "HEAD") {
      refuse(response, kWrong, "expected GET or POST");
      return Handled::Handled;
    }
    answered(response, [&] { get(path, request, response); });
    return Handled::Handled;
  }

  [[nodiscard]] std::string path_of(const httplib::Request& request) const {
    if (request.path.size() > kMostPath) return "";
    return let_in({request.path, request.get_header_value("Host"), request.get_header_value("Origin"),
                   request.get_header_value("Sec-Fetch-Site")},
                  token_, port_);
  }

  void get(const std::string& path, const httplib::Request& request, httplib::Response& response) {
    if (path == "/") return say(response, {page(), "text/html; charset=utf-8", ""});
    const Way way = way_of(path);
    const auto name = [&](std::size_t k) { return way.names.at(k); };
    if (way.pattern == "state") return say(response, desk_.state());
    if (way.pattern == "machines") return say(response, desk_.machines());
    if (way.pattern == "fields/*") return say(response, desk_.fields(name(0)));
    if (way.pattern == "parts/*") return say(response, desk_.faces(name(0)));
    if (way.pattern == "parts/*/wheel") return say(response, desk_.wheel(name(0)));
    if (way.pattern == "jobs/*") {
      const std::size_t from = std::strtoull(request.get_param_value("from").c_str(), nullptr, 10);
      const Json job = desk_.jobs().one(name(0), from);
      return say(response, {job.dump(-1, ' ', false, Json::error_handler_t::replace), "application/json", ""});
    }
    if (way.pattern == "jobs/*/report") return say(response, desk_.report(name(0), ""));
    if (way.pattern == "jobs/*/ops/*/report") return say(response, desk_.report(name(0), name(1)));
    if (way.pattern == "jobs/*/zip") return say(response, desk_.zip(name(0)));
    if (way.pattern == "jobs/*/files/*") return say(response, desk_.file(name(0), name(1)));
    if (way.pattern == "jobs/*/programs/*") return say(response, desk_.program(name(0), name(1)));
    refuse(response, kUnknown, "no such page");
  }

  void post(const httplib::Request& request, httplib::Response& response, const httplib::ContentReader& reader) {
    const Way way = way_of(path_of(request));
    if (way.pattern == "parts" || way.pattern == "files") return take(way.pattern, request, response, reader);
    std::string body;
    const bool whole = reader([&](const char* data, std::size_t size) {
      body.append(data, size);
      return body.size() <= kMostQuestion;
    });
    if (!whole) return refuse(response, kTooLarge, "the request is too long");
    const Json asked = body.empty() ? Json::object() : Json::parse(body);
    const auto done = [&] { say(response, {"{}", "application/json", ""}); };
    if (way.pattern == "defaults") return say(response, desk_.defaults(asked));
    if (way.pattern == "jobs") {
      const std::string id = desk_.jobs().add(asked.at("command"), asked.at("part"), asked.at("fields"));
      return say(response, {Json{{"id", id}}.dump(), "application/json", ""});
    }
    if (way.pattern == "jobs/*/stop") return desk_.jobs().stop(way.names.at(0)), done();
    if (way.pattern == "jobs/*/resume") return desk_.jobs().resume(way.names.at(0)), done();
    if (way.pattern == "jobs/*/post") return say(response, desk_.post(way.names.at(0), asked));
    if (way.pattern == "jobs/*/judge") return say(response, desk_.judge(way.names.at(0), asked));
    if (way.pattern == "jobs/*/sheet") return say(response, desk_.sheet(way.names.at(0), asked));
    refuse(response, kUnknown, "no such page");
  }

  /// A file that was dropped on the page; a part is read, and thrown away if it is none.
  void take(const std::string& kind, const httplib::Request& request, httplib::Response& response,
            const httplib::ContentReader& reader) {
    const std::string folder = desk_.folder().files();
    const std::string half = fmt::format("{}/{}{}", folder, kHalf, ++uploads_);
    std::ofstream stream(half, std::ios::binary);
    std::size_t size = 0;
    const bool whole = reader([&](const char* data, std::size_t more) {
      stream.write(data, static_cast<std::streamsize>(more));
      return (size += more) <= kMostUpload && stream.good();
    });
    stream.close();
    if (!whole || !stream) {
      fs::remove(half);
      // The reader says so of a length that is only announced.
      const bool large = size > kMostUpload || response.status == kTooLarge;
      return refuse(response, large ? kTooLarge : kWrong, "the file was not received completely; drop it again");
    }
    const std::string name = desk_.new_file(request.get_param_value("name"));
    rename_file(half, folder + "/" + name);
    try {
      if (kind == "parts") desk_.look_at(name, request.get_param_value("unit"));
    } catch (const std::exception&) {
      fs::remove(folder + "/" + name);
      throw;
    }
    say(response, {Json{{"name", name}}.dump(-1, ' ', false, Json::error_handler_t::replace), "application/json", ""});
  }

  [[nodiscard]] std::string page() const {
    const std::string start = Json{{"version", kVersion}, {"part", first_part_}}.dump();
    return fill_page(studio_template(), "OpenFlank studio",
                     "<script type=\"application/json\" data-file=\"start.json\">" + script_safe(start) + "</script>");
  }

  Desk& desk_;
  std::string first_part_, token_;
  int port_ = 0;
  std::atomic<int> uploads_{0};
  httplib::Server server_;
};

/// A copy of the user's part, read; its name.
std::string take_part(Desk& desk, const StudioOptions& options) {
  if (options.part.empty()) return "";
  if (!fs::is_regular_file(options.part)) throw InputError(options.part + ": is not a file");
  const std::string name = desk.new_file(options.part), file = desk.folder().files() + "/" + name;
  fs::copy_file(options.part, file);
  try {
    desk.look_at(name, options.unit.value_or(""));
  } catch (const InputError&) {
    fs::remove(file);
    throw;
  }
  return name;
}

}  // namespace

void run_studio(const StudioOptions& options, const std::string& program,
                const std::function<void(const std::string& address)>& told, const std::function<bool()>& cancelled) {
  if (studio_template().empty())
    throw UsageError("studio", "this flank was built without its pages: " + std::string(page_is_missing()));
  Desk desk(options.folder, program);
  Server server(desk, take_part(desk, options));
  told(server.bind(options.port));
  server.serve(cancelled);
}

}  // namespace flank::internal
