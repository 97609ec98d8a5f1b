#include "docent/apps/gateway/gateway_command.h"

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "docent/apps/shared/command.h"
#include "docent/apps/shared/log.h"
#include "docent/base/files.h"
#include "docent/base/shipped_files.h"
#include "docent/telepresence/document_json.h"
#include "docent/telepresence/limits/fair_share.h"
#include "docent/telepresence/limits/network.h"
#include "docent/telepresence/server/web_server.h"
#include "docent/telepresence/site.h"
#include "docent/telepresence/uplink/uplink_client.h"
#include "docent/telepresence/views/slots.h"

namespace docent::apps::gateway_command {
namespace {

struct Options {
  std::string from = "127.0.0.1:8090";
  std::string key;
  std::string page;
  double messages_per_second = 100.0;
  double calls_per_second = 40.0;
  telepresence::WebServerParams server;
};

std::atomic<bool> is_ended{false};

/// What does not change while the museum's robot runs: the museum, its map, the exhibits' pictures.
void fetch_documents(telepresence::UplinkClient& line, telepresence::Site& site) {
  const auto fetch = [&](const std::string& path) { return value_or_fail(line.fetch(path)); };
  std::string museum = fetch("/api/museum.json");
  const auto json = nlohmann::json::parse(museum, nullptr, false);
  if (!json.is_object()) throw CommandFailed{"the other end of the line is no Docent"};
  for (const auto& exhibit : json.value("exhibits", nlohmann::json::array())) {
    const std::string picture = exhibit.value("picture", std::string{});
    if (picture.starts_with('/')) site.set_file(picture, fetch(picture));
  }
  site.set_document("/api/map.png", "image/png", fetch("/api/map.png"));
  site.set_document("/api/museum.json", "application/json", std::move(museum));
}

/// The text of a viewer's message, as the museum reads it again.
std::string text_of(const telepresence::ClientMessage& message) {
  return std::visit([](const auto& one) { return telepresence::json_text(one); }, message);
}

/// The desk of the far gateway: what its visitors ask of the museum, each their share of the line.
class SharedDesk final : public telepresence::ApiDesk {
 public:
  SharedDesk(std::shared_ptr<telepresence::UplinkClient> line, double calls_per_second)
      : line_{std::move(line)}, share_{{.per_second = calls_per_second}} {}
  void take(telepresence::ApiRequest request, std::function<void(telepresence::ApiReply)> answer) override {
    bool is_within = false;
    {
      const std::scoped_lock lock{mutex_};
      is_within = share_.take(telepresence::network_of(request.address), now());
    }
    if (!is_within) return answer({429, R"({"reason":"too_fast","about":""})", ""});
    line_->take(std::move(request), std::move(answer));
  }
  void admit(std::string token, std::function<void(telepresence::Admitted)> answer) override {
    line_->admit(std::move(token), std::move(answer));
  }
  void close() override { line_->close(); }
  static Time now() {
    return Time{std::chrono::nanoseconds{std::chrono::steady_clock::now().time_since_epoch()}.count()};
  }

 private:
  const std::shared_ptr<telepresence::UplinkClient> line_;
  std::mutex mutex_;
  telepresence::FairShare share_;
};

constexpr auto kFirstLine = std::chrono::seconds{15};

/// That something has happened once.
class Signal {
 public:
  void set() {
    {
      const std::scoped_lock lock{mutex_};
      is_set_ = true;
    }
    wake_.notify_all();
  }
  /// False: not within that time, or somebody ends the program.
  [[nodiscard]] bool wait_for(std::chrono::seconds patience) {
    const auto end = std::chrono::steady_clock::now() + patience;
    std::unique_lock lock{mutex_};
    while (!is_set_ && !is_ended && std::chrono::steady_clock::now() < end)
      wake_.wait_for(lock, std::chrono::milliseconds{100});
    return is_set_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable wake_;
  bool is_set_ = false;
};

/// The server for the crowd and the line to the museum, which need one another.
class Gateway {
 public:
  Gateway(const std::string& host, const std::string& port, const std::string& key, const Options& options)
      : site_{std::make_shared<telepresence::Site>()}, share_{{.per_second = options.messages_per_second}} {
    const auto page = options.page.empty() ? shipped_path("web/dist") : std::filesystem::path{options.page};
    value_or_fail(site_->load_page(page));
    for (const char* camera : {"/camera/robot.jpg", "/camera/scene.jpg"})
      site_->set_changing(camera, "image/jpeg", std::make_shared<const std::string>(), "");
    site_->set_live_document("/metrics", "text/plain; version=0.0.4", [this] { return metrics(); });
    uplink_ = std::make_shared<telepresence::UplinkClient>(host, port, key, from_museum());
    if (!has_line_.wait_for(kFirstLine)) throw CommandFailed{host + ":" + port + ": " + uplink_->fault()};
    fetch_documents(*uplink_, *site_);
    telepresence::WebServerHooks hooks;
    hooks.message = [this](const telepresence::Caller& caller, const telepresence::ClientMessage& message) {
      if (!is_ready_) return;
      if (!share_.take(telepresence::network_of(caller.address), SharedDesk::now()))
        return server_->send(caller.id, kTooFast);
      if (!uplink_->say(telepresence::UplinkMessage{caller.id, text_of(message)})) server_->send(caller.id, kBusy);
    };
    hooks.arrived = [this](const std::string& address) { uplink_->say(telepresence::UplinkArrival{address}); };
    hooks.desk = std::make_shared<SharedDesk>(uplink_, options.calls_per_second);
    auto params = options.server;
    params.full_viewers = 0;  // what the line carries is the pose alone of what moves
    params.foxglove_clients = 0;
    server_ = value_or_fail(telepresence::WebServer::start(params, site_, std::move(hooks)));
    server_->restrict_to(telepresence::Stream::thin, telepresence::slots::kPose);
    is_ready_ = true;
  }

  void run() const {
    while (!is_ended) std::this_thread::sleep_for(std::chrono::milliseconds{100});
  }
  [[nodiscard]] int port() const { return server_->port(); }

 private:
  static constexpr const char* kBusy = R"({"type":"error","reason":{"word":"not_stored","about":""}})";

  static constexpr const char* kTooFast = R"({"type":"error","reason":{"word":"too_fast","about":""}})";

  telepresence::UplinkHooks from_museum() {
    telepresence::UplinkHooks hooks;
    hooks.slot = [this](std::size_t slot, std::string text) {
      if (is_ready_ && slot < static_cast<std::size_t>(telepresence::WebServer::kSlots))
        server_->broadcast(static_cast<int>(slot), std::move(text));
    };
    hooks.answer = [this](std::uint64_t viewer, std::string text) {
      if (is_ready_) server_->send(viewer, std::move(text));
    };
    hooks.picture = [this](telepresence::JoinedPicture picture) {
      if (picture.path == "/camera/robot.jpg" || picture.path == "/camera/scene.jpg")
        site_->set_changing(picture.path, "image/jpeg", std::make_shared<const std::string>(std::move(picture.bytes)),
                            picture.taken);
    };
    hooks.line = [this](bool is_open) {
      if (is_open) has_line_.set();
      log_to_stderr(is_open ? LogLevel::info : LogLevel::warning, "gateway",
                    is_open ? "the line to the museum is open" : "the line to the museum is lost");
    };
    return hooks;
  }
  [[nodiscard]] std::string metrics() const {
    if (!is_ready_) return "";
    const auto figures = server_->figures();
    return "docent_web_viewers " + std::to_string(figures.viewers) + "\ndocent_web_http_requests_total " +
           std::to_string(figures.http_requests) + "\n";
  }

  std::shared_ptr<telepresence::Site> site_;
  telepresence::FairShare share_;  ///< of what visitors say; the server's thread alone
  Signal has_line_;
  std::atomic<bool> is_ready_{false};
  std::shared_ptr<telepresence::UplinkClient> uplink_;
  std::unique_ptr<telepresence::WebServer> server_;
};

void run(const Options& options) {
  const auto colon = options.from.rfind(':');
  if (colon == std::string::npos) throw CommandFailed{"--from is HOST:PORT, not '" + options.from + "'"};
  std::string key = value_or_fail(read_file(options.key));
  while (!key.empty() && key.find_last_not_of("0123456789abcdef") == key.size() - 1) key.pop_back();
  value_or_fail(options.server.validate());
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { is_ended = true; });
  if (key.size() < 16) throw CommandFailed{options.key + ": no key of a museum: 32 hexadecimal digits"};
  const Gateway gateway{options.from.substr(0, colon), options.from.substr(colon + 1), key, options};
  std::printf("open http://%s:%d/\n", options.server.address.c_str(), gateway.port());
  std::fflush(stdout);
  gateway.run();
}

}  // namespace

void add_gateway_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("gateway", "Serve the Web's visitors from far away, over one thin line from the museum");
  command->add_option("--from", options->from, "HOST:PORT of the museum's line: web.uplink_port of its robot.yaml")
      ->capture_default_str();
  command->add_option("--key", options->key, "the museum's file uplink.key, of its state folder")
      ->required()
      ->check(CLI::ExistingFile);
  command->add_option("--port", options->server.port, "where the page is served; 0: any free one")
      ->capture_default_str();
  command->add_option("--address", options->server.address, "where it listens")->capture_default_str();
  command->add_option("--max-viewers", options->server.max_viewers, "at most")->capture_default_str();
  command
      ->add_option("--messages-per-second", options->messages_per_second,
                   "of all visitors together, shared among those who send")
      ->check(CLI::Range(1.0, 1e4))
      ->capture_default_str();
  command->add_option("--calls-per-second", options->calls_per_second, "likewise, calls to /api/v1")
      ->check(CLI::Range(1.0, 1e4))
      ->capture_default_str();
  command->add_option("--proxy", options->server.proxies,
                      "address of a proxy of yours, whose X-Forwarded-For, -Host, -Proto and -Prefix are believed");
  command->add_option("--prefix", options->server.prefix,
                      "path below which a proxy shows the page and which it passes on, such as /robot");
  command->add_option("--page", options->page, "folder of the built page; without it the one that came with docent");
  command->callback([options] { run(*options); });
}

}  // namespace docent::apps::gateway_command
