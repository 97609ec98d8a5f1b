#include <utility>  // first: Beast 1.74 forgets it in C++20
//
#include <algorithm>
#include <array>
#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <map>
#include <set>
#include <thread>

#include "docent/telepresence/api/exchange/forwarding.h"
#include "docent/telepresence/limits/descriptors.h"
#include "docent/telepresence/limits/network.h"
#include "docent/telepresence/server/foxglove_session.h"
#include "docent/telepresence/server/http_connection.h"
#include "docent/telepresence/server/session.h"
#include "docent/telepresence/server/uplink_session.h"
#include "docent/telepresence/server/web_server.h"
#include "docent/telepresence/uplink/uplink_door.h"

namespace docent::telepresence {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using asio::ip::tcp;

constexpr std::size_t kGroups = WebServer::kParts;
constexpr auto kGroupPeriod = std::chrono::milliseconds{10};
constexpr std::size_t kKeptConnections = 100;  // connections, for this computer, proxies and those who have accounts
constexpr std::size_t kOtherFiles = 300;       // and sockets that the program needs besides connections
constexpr std::size_t kManyViewers = 100;      // from here on sends are spread over the groups

bool is_this_computer(const std::string& network) { return network == "127.0.0.1" || network == "::/64"; }

bool is_one_of(const std::vector<std::string>& all, const std::string& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

/// As many connections as this process may have.
WebServerParams within_descriptors(WebServerParams params) {
  const auto wanted = static_cast<std::size_t>(params.max_connections);
  const std::size_t allowed = allow_descriptors(wanted + kOtherFiles);
  const std::size_t most = std::max<std::size_t>(1, allowed - std::min(allowed, kOtherFiles));
  params.max_connections = static_cast<int>(std::min(wanted, most));
  return params;
}

std::vector<std::string> names_of(const WebServerParams& params) {
  std::vector<std::string> names = params.hosts;
  names.insert(names.end(), params.origins.begin(), params.origins.end());
  return names;
}

}  // namespace

struct WebServer::Core {
  Core(const WebServerParams& given, std::shared_ptr<const Site> site, WebServerHooks the_hooks)
      : params{given},
        hooks{std::move(the_hooks)},
        router{site, given.origins, hooks.screen_key},
        foxglove{hooks.foxglove},
        acceptor{io},
        uplink_door{io, UplinkSession::manner(),
                    [this](std::unique_ptr<WebSocket> line, const std::string& address) {
                      open_uplink(std::move(line), address);
                    }},
        timer{io},
        accept_timer{io} {
    sessions.message = hooks.message;
    sessions.of_address = RateLimits{{params.messages_of_address, params.message_burst_of_address}};
    sessions.screen_stops = params.screen_stops;
    sessions.left = [this](const Caller& caller) {
      if (groups[caller.id % kGroups].erase(caller.id) == 0) return;
      --viewers;
      if (caller.role == Role::staff && hooks.left) hooks.left(caller);
    };
    sessions.latest = [this](std::size_t slot) { return latest.at(slot); };
    http.connections = &sessions.connections;
    http.desk = hooks.desk;
    http.take_place = [this](const std::string& address) { return take_place(address); };
    http.origins = params.origins;
    http.proxies = params.proxies;
    http.prefix = params.prefix;
    http.shows_foxglove_to_proxies = params.foxglove_by_proxy;
    http.hosts = Hosts{names_of(params)};
    http.route = [this](const RouteRequest& request) {
      return router.route(request, viewers >= static_cast<std::size_t>(params.max_viewers));
    };
    http.open_live = [this](tcp::socket socket, HttpRequest request, const Arrival& how) {
      open_live(std::move(socket), std::move(request), how);
    };
    uplink_owner.arrived = hooks.arrived;
    uplink_owner.left = [this](std::uint64_t number) { uplinks.erase(number); };
    uplink_owner.site = std::move(site);
    uplink_owner.desk = hooks.desk;
    uplink_owner.asked = &http.asked;
    uplink_owner.is_closing = &http.is_closing;
    http.open_foxglove = [this](tcp::socket socket, HttpRequest request) {
      open_foxglove(std::move(socket), std::move(request));
    };
  }

  void accept();
  void take(tcp::socket socket);
  /// null: that address has as many connections as it may have.
  [[nodiscard]] std::shared_ptr<Place> take_place(const std::string& address);
  /// That login is over: whoever came with it is gone at once, and so is their hand on the knob.
  void end_login(const std::string& login);
  void open_live(tcp::socket socket, HttpRequest request, const Arrival& how);
  void open_foxglove(tcp::socket socket, HttpRequest request);
  void open_uplink(std::unique_ptr<WebSocket> line, const std::string& address);
  [[nodiscard]] std::uint32_t slots_with_a_value() const;
  void tick();
  void flush_all();

  const WebServerParams params;
  const WebServerHooks hooks;
  std::map<std::string, int> places;  ///< that connections from elsewhere hold, by their network
  const Router router;
  const std::shared_ptr<FoxgloveHub> foxglove;
  std::atomic<std::size_t> viewers{0};
  std::atomic<std::uint64_t> viewers_ever{0};
  SessionOwner sessions;
  HttpOwner http;
  UplinkOwner uplink_owner;
  asio::io_context io{1};  // after the counters: its last handlers still count down
  tcp::acceptor acceptor;
  UplinkDoor uplink_door;
  asio::steady_timer timer;
  asio::steady_timer accept_timer;
  // Only the server's thread touches these.
  std::array<SharedText, kSlots> latest;
  std::array<std::map<ViewerId, std::shared_ptr<Session>>, kGroups> groups;
  std::set<std::shared_ptr<FoxgloveSession>> foxglove_sessions;
  std::map<std::uint64_t, std::shared_ptr<UplinkSession>> uplinks;
  std::uint64_t next_uplink = 1;
  ViewerId next_viewer = 1;
  std::size_t next_group = 0;
  bool is_ticking = false;
  SecondHolder second_holder;
  std::thread thread;
};

Result<void> WebServerParams::validate() const {
  if (port < 0 || port > 65535) return fail("web.port must be 0 to 65535");
  if (uplink_port < 0 || uplink_port > 65535) return fail("web.uplink_port must be 0 to 65535");
  if (max_connections < 1) return fail("web.max_connections must be at least 1");
  if (foxglove_clients < 0 || foxglove_clients > 100) return fail("web.foxglove_clients must be 0 to 100");
  if (connections_of_address < 1) return fail("web.connections_of_address must be at least 1");
  if (!(messages_of_address > 0.0)) return fail("web.messages_of_address must be > 0");
  if (!(message_burst_of_address >= 1.0)) return fail("web.message_burst_of_address must be at least 1");
  if (full_viewers < 0) return fail("web.full_viewers must be >= 0");
  if (max_viewers < 1) return fail("web.max_viewers must be at least 1");
  if (!(messages_per_second > 0.0)) return fail("web.messages_per_second must be > 0");
  if (!(steering_per_second >= 10.0)) return fail("web.steering_per_second must be at least 10");
  if (!(message_burst >= 1.0)) return fail("web.message_burst must be at least 1");
  if (max_message_bytes < 256 || max_message_bytes > 1 << 20)
    return fail("web.max_message_bytes must be 256 to 1048576");
  if (send_buffer_bytes < 4096) return fail("web.send_buffer_bytes must be at least 4096");
  if (!(uplink_picture_s >= 0.1)) return fail("web.uplink_picture_s must be at least 0.1");
  if (uplink_picture_bytes_per_s < 100) return fail("web.uplink_picture_bytes_per_s must be at least 100");
  for (const double rate : {uplink_messages_per_second, uplink_calls_per_second, uplink_writes_per_second})
    if (!(rate >= 1.0)) return fail("web.uplink_…_per_second must be at least 1");
  if (!prefix.empty() && !is_path_prefix(prefix))
    return fail("web.prefix must be empty or a path such as /robot, without a / at its end, not '" + prefix + "'");
  for (const std::string name : {"/api", "/assets", "/audio", "/camera", "/face", "/foxglove", "/kiosk", "/live",
                                 "/metrics", "/operate", "/setup"})
    if (prefix == name || prefix.starts_with(name + "/"))
      return fail("web.prefix is a path of the page's own: " + name);
  if (foxglove_by_proxy && proxies.empty())
    return fail("web.foxglove_by_proxy needs web.proxies: an address that may hand on");
  if (!(idle_timeout_s >= 1.0)) return fail("web.idle_timeout_s must be at least 1");
  return {};
}

void WebServer::Core::accept() {
  acceptor.async_accept([this](beast::error_code error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    if (error) {  // out of descriptors: wait for some to come free
      accept_timer.expires_after(std::chrono::milliseconds{100});
      accept_timer.async_wait([this](beast::error_code) { accept(); });
      return;
    }
    take(std::move(socket));
    accept();
  });
}

void WebServer::Core::take(tcp::socket socket) {
  const auto most = static_cast<std::size_t>(params.max_connections);
  if (sessions.connections >= most) return;  // it closes
  beast::error_code error;
  const auto peer = socket.remote_endpoint(error);
  if (error) return;
  // For many others speak a proxy of ours and whatever runs on this computer.
  const std::string address = peer.address().to_string();
  const bool speaks_for_many = is_this_computer(network_of(address)) || is_one_of(params.proxies, address);
  const bool is_nearly_full = sessions.connections + kKeptConnections >= most && most > 2 * kKeptConnections;
  if (is_nearly_full && !speaks_for_many && !(hooks.desk && hooks.desk->is_staff_from(address))) return;
  std::shared_ptr<Place> place;
  if (!speaks_for_many && !(place = take_place(address))) return;
  std::make_shared<HttpConnection>(http, std::move(socket), std::move(place))->read();
}

std::shared_ptr<Place> WebServer::Core::take_place(const std::string& address) {
  auto place = std::make_shared<Place>(places, network_of(address));
  return place->taken() > params.connections_of_address ? nullptr : place;
}

void WebServer::Core::end_login(const std::string& login) {
  std::vector<std::shared_ptr<Session>> theirs;
  for (const auto& group : groups)
    for (const auto& [id, viewer] : group)
      if (viewer->is_of(login)) theirs.push_back(viewer);
  for (const auto& viewer : theirs) viewer->end("logged out");
}

void WebServer::Core::open_live(tcp::socket socket, HttpRequest request, const Arrival& how) {
  beast::error_code ignored;
  socket.set_option(tcp::no_delay{true}, ignored);
  socket.set_option(asio::socket_base::send_buffer_size{params.send_buffer_bytes}, ignored);
  const ViewerId id = next_viewer++;
  // The robot's own screen shows all there is, whoever watches besides.
  const bool must_be_thin = how.role != Role::kiosk && viewers >= static_cast<std::size_t>(params.full_viewers);
  const auto session =
      std::make_shared<Session>(sessions, params, std::move(socket),
                                Caller{id, how.role, how.name, how.login, how.address}, must_be_thin, how.place);
  if (how.role == Role::visitor && hooks.arrived) hooks.arrived(how.address);
  groups[id % kGroups].emplace(id, session);
  ++viewers;
  ++viewers_ever;
  session->run(std::move(request), slots_with_a_value(), how.is_thin);
}

std::uint32_t WebServer::Core::slots_with_a_value() const {
  std::uint32_t slots = 0;
  for (std::size_t slot = 0; slot < latest.size(); ++slot) {
    if (latest.at(slot)) slots |= 1U << slot;
  }
  return slots;
}

void WebServer::Core::open_uplink(std::unique_ptr<WebSocket> line, const std::string& address) {
  // One holder of the key. A line that was cut is given up within seconds; whoever is sent away for longer is a second
  // one.
  if (!uplinks.empty()) {
    second_holder.sent_away(address, SecondHolder::Clock::now());
    return line->drop();
  }
  second_holder.came_in();
  const std::uint64_t number = next_uplink++;
  const auto session = std::make_shared<UplinkSession>(sessions, uplink_owner, params, std::move(line), number);
  uplinks.emplace(number, session);
  session->run(slots_with_a_value());
}

void WebServer::Core::open_foxglove(tcp::socket socket, HttpRequest request) {
  if (!foxglove || foxglove_sessions.size() >= static_cast<std::size_t>(params.foxglove_clients)) return;  // it closes
  beast::error_code ignored;
  socket.set_option(tcp::no_delay{true}, ignored);
  const auto session = std::make_shared<FoxgloveSession>(*foxglove, std::move(socket), [this](FoxgloveSession* left) {
    foxglove_sessions.erase(left->shared_from_this());
  });
  foxglove_sessions.insert(session);
  session->run(std::move(request));
}

void WebServer::Core::tick() {
  for (auto& [id, viewer] : groups[next_group]) viewer->flush();
  next_group = (next_group + 1) % kGroups;
  is_ticking = viewers > kManyViewers;
  if (!is_ticking) return flush_all();
  timer.expires_after(kGroupPeriod);  // from now: a late tick is skipped, not caught up
  timer.async_wait([this](beast::error_code error) {
    if (!error) tick();
  });
}

void WebServer::Core::flush_all() {
  for (auto& group : groups) {
    for (auto& [id, viewer] : group) viewer->flush();
  }
}

WebServer::WebServer(std::unique_ptr<Core> core) : core_{std::move(core)} {}

Result<std::unique_ptr<WebServer>> WebServer::start(const WebServerParams& params, std::shared_ptr<const Site> site,
                                                    WebServerHooks hooks) {
  const std::string name = params.address + ":" + std::to_string(params.port);
  beast::error_code error;
  const auto address = asio::ip::make_address(params.address, error);
  if (error) return fail(name + ": not an address");
  auto core = std::make_unique<Core>(within_descriptors(params), std::move(site), std::move(hooks));
  const tcp::endpoint endpoint{address, static_cast<std::uint16_t>(params.port)};
  core->acceptor.open(endpoint.protocol(), error);
  if (!error) core->acceptor.set_option(asio::socket_base::reuse_address{true}, error);
  if (!error) core->acceptor.bind(endpoint, error);
  if (!error) core->acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error == asio::error::address_in_use) return fail(name + ": the port is in use by another program");
  if (error) return fail(name + ": cannot listen: " + error.message());
  if (params.uplink_port != 0 && !core->hooks.uplink_key.empty()) {
    const tcp::endpoint door{address, static_cast<std::uint16_t>(params.uplink_port)};
    if (auto open = core->uplink_door.listen(door, core->hooks.uplink_key); !open)
      return tl::unexpected<Error>(open.error());
  }
  core->accept();
  core->thread = std::thread{[raw = core.get()] { raw->io.run(); }};
  if (core->hooks.desk) {
    core->hooks.desk->when_ended(
        [raw = core.get()](const std::string& login) { asio::post(raw->io, [raw, login] { raw->end_login(login); }); });
  }
  return std::unique_ptr<WebServer>{new WebServer{std::move(core)}};
}

WebServer::~WebServer() {
  // What the desk was asked it still answers, and each answer finds its connection.
  core_->http.is_closing = true;
  if (core_->hooks.desk) {
    core_->hooks.desk->when_ended({});
    core_->hooks.desk->close();
  }
  while (core_->http.asked > 0) std::this_thread::sleep_for(std::chrono::milliseconds{1});
  core_->io.stop();
  core_->thread.join();
  for (const auto& session : core_->foxglove_sessions) session->drop();
  core_->foxglove_sessions.clear();
  for (const auto& [number, uplink] : std::exchange(core_->uplinks, {})) uplink->drop();
  for (auto& group : core_->groups) {
    for (auto& [id, viewer] : group) viewer->drop();
    group.clear();
  }
}

std::string WebServer::second_holder() const { return core_->second_holder.address(SecondHolder::Clock::now()); }

int WebServer::port() const { return core_->acceptor.local_endpoint().port(); }

void WebServer::broadcast(int slot, std::string text) {
  auto shared = std::make_shared<const std::string>(std::move(text));
  asio::post(core_->io, [core = core_.get(), slot = static_cast<std::size_t>(slot), shared = std::move(shared)] {
    core->latest[slot] = shared;
    for (auto& group : core->groups) {
      for (auto& [id, viewer] : group) viewer->mark(slot);
    }
    const auto uplinks = core->uplinks;  // one that is full may leave
    for (const auto& [number, uplink] : uplinks) uplink->mark(slot);
    if (core->is_ticking) return;
    if (core->viewers > kManyViewers) return core->tick();
    core->flush_all();
  });
}

void WebServer::broadcast_part(int slot, int part, std::string text) {
  asio::post(core_->io,
             [core = core_.get(), slot = static_cast<std::size_t>(slot), part = static_cast<std::size_t>(part),
              shared = std::make_shared<const std::string>(std::move(text))] {
               core->latest.at(slot) = shared;
               for (auto& [id, viewer] : core->groups.at(part)) {
                 viewer->mark(slot);
                 viewer->flush();
               }
               if (part != 0) return;
               const auto uplinks = core->uplinks;
               for (const auto& [number, uplink] : uplinks) uplink->mark(slot);
             });
}

void WebServer::restrict_to(Stream stream, int slot) {
  asio::post(core_->io, [core = core_.get(), stream, bit = 1U << static_cast<unsigned>(slot)] {
    SessionOwner& sessions = core->sessions;
    for (const auto& [kind, slots] :
         {std::pair{Stream::details, &sessions.detail_slots}, std::pair{Stream::full, &sessions.full_slots},
          std::pair{Stream::thin, &sessions.thin_slots}, std::pair{Stream::operators, &sessions.operator_slots},
          std::pair{Stream::stop, &sessions.stop_slots}})
      *slots = kind == stream ? *slots | bit : *slots & ~bit;
  });
}

void WebServer::send(ViewerId viewer, std::string text) {
  asio::post(core_->io, [core = core_.get(), viewer, shared = std::make_shared<const std::string>(std::move(text))] {
    if (const auto uplink = core->uplinks.find(viewer >> kUplinkShift); uplink != core->uplinks.end()) {
      const auto held = uplink->second;
      return held->answer(viewer & ((1ULL << kUplinkShift) - 1), *shared);
    }
    auto& group = core->groups[viewer % kGroups];
    if (const auto place = group.find(viewer); place != group.end()) {
      const auto held = place->second;  // closing it may take it out of the group
      held->answer(shared);
    }
  });
}

void WebServer::show(std::uint32_t channel, Time time, std::shared_ptr<const std::vector<std::uint8_t>> message) {
  asio::post(core_->io, [core = core_.get(), channel, time, message = std::move(message)] {
    const auto sessions = core->foxglove_sessions;  // one that is full may leave
    for (const auto& session : sessions) session->add(channel, time, message);
  });
}

WebServerFigures WebServer::figures() const {
  const SessionOwner& sessions = core_->sessions;
  return {sessions.connections,  core_->viewers,         core_->viewers_ever,
          core_->http.requests,  sessions.messages_in,   sessions.messages_refused,
          sessions.messages_out, sessions.values_skipped};
}

}  // namespace docent::telepresence
