#include "docent/telepresence/server/web_server.h"

#include <arpa/inet.h>
#include <benchmark/benchmark.h>
#include <sys/epoll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <thread>
#include <vector>

// How late viewers see a value. Server and viewers share the machine, so the figures are an upper bound.

namespace docent::telepresence {
namespace {

using Clock = std::chrono::steady_clock;

int connect_viewer(int port) {
  const int end = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(end, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) return -1;
  const char request[] =
      "GET /live HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n";
  if (::send(end, request, sizeof request - 1, MSG_NOSIGNAL) < 0) return -1;
  char reply[1024];
  if (::recv(end, reply, sizeof reply, 0) <= 0) return -1;
  return end;
}

/// One value of 2 kB ten times a second to `viewers`; the counters are milliseconds from broadcast to arrival.
void BM_Viewers(benchmark::State& state) {
  const auto viewers = static_cast<std::size_t>(state.range(0));
  rlimit limit{};
  ::getrlimit(RLIMIT_NOFILE, &limit);
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &limit);
  if (limit.rlim_cur < 2 * viewers + 100) return state.SkipWithError("too few file descriptors: ulimit -n");

  WebServerParams params;
  params.port = 0;
  auto server = WebServer::start(params, std::make_shared<Site>(), {[](const Caller&, const ClientMessage&) {}});
  if (!server) return state.SkipWithError(server.error().message.c_str());
  const int poll = ::epoll_create1(0);
  std::vector<int> ends;
  for (std::size_t i = 0; i < viewers; ++i) {
    const int end = connect_viewer((*server)->port());
    if (end < 0) return state.SkipWithError("a viewer could not connect");
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.fd = end;
    ::epoll_ctl(poll, EPOLL_CTL_ADD, end, &event);
    ends.push_back(end);
  }
  std::vector<double> late_ms;
  std::vector<epoll_event> events(1024);
  std::vector<char> sink(1 << 16);
  for (auto _ : state) {
    const auto begin = Clock::now();
    (*server)->broadcast(0, std::string(2000, 'x'));
    std::size_t left = viewers;
    std::vector<std::size_t> got(1 << 20, 0);
    while (left > 0 && Clock::now() - begin < std::chrono::seconds{5}) {
      const int count = ::epoll_wait(poll, events.data(), static_cast<int>(events.size()), 1000);
      for (int i = 0; i < count; ++i) {
        const int end = events[static_cast<std::size_t>(i)].data.fd;
        const auto bytes = ::recv(end, sink.data(), sink.size(), MSG_DONTWAIT);
        if (bytes <= 0) continue;
        auto& sum = got[static_cast<std::size_t>(end)];
        sum += static_cast<std::size_t>(bytes);
        if (sum < 2004) continue;  // 4 bytes of frame
        --left;
        late_ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
      }
    }
    std::this_thread::sleep_until(begin + std::chrono::milliseconds{100});
  }
  for (const int end : ends) ::close(end);
  ::close(poll);
  std::sort(late_ms.begin(), late_ms.end());
  if (late_ms.empty()) return state.SkipWithError("nothing arrived");
  state.counters["p50_ms"] = late_ms[late_ms.size() / 2];
  state.counters["p99_ms"] = late_ms[late_ms.size() * 99 / 100];
  state.counters["skipped"] = static_cast<double>((*server)->figures().values_skipped);
}
BENCHMARK(BM_Viewers)->Arg(10)->Arg(100)->Arg(1000)->Arg(5000)->Iterations(20)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace docent::telepresence
