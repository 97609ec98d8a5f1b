// docent_pose_server: the Web server with a pose that moves, without a robot. Prints its port, runs until its standard
// input ends, and prints then what it did.
#include <time.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <limits>
#include <memory>
#include <thread>

#include "docent/telepresence/live_encoding.h"
#include "docent/telepresence/server/web_server.h"

namespace {

using namespace docent;

double monotonic_s() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// A robot that drives round a circle.
std::string pose_at(double now_s) {
  telepresence::LiveFrame frame;
  frame.now = time_from_seconds(now_s);
  const double angle = 0.1 * now_s;
  frame.map_from_base =
      Pose2{10.0 + 4.0 * std::cos(angle), 8.0 + 4.0 * std::sin(angle), Angle::radians(angle + 1.5708)};
  frame.linear = 0.4;
  frame.angular = 0.1;
  frame.battery = 0.87;
  return telepresence::encode_pose(frame);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"The Web server with a pose that moves, for scripts/evaluate web-load"};
  telepresence::WebServerParams params;
  params.port = 0;
  params.max_viewers = 30000;
  params.max_connections = 40000;
  double period_s = 0.3;
  app.add_option("--port", params.port);
  app.add_option("--period", period_s, "[s] between two values of a viewer")->check(CLI::Range(0.01, 10.0));
  CLI11_PARSE(app, argc, argv);
  auto server = telepresence::WebServer::start(params, std::make_shared<telepresence::Site>(), {[](auto&&...) {}});
  if (!server) {
    std::fprintf(stderr, "%s\n", server.error().message.c_str());
    return 1;
  }
  constexpr int kPose = 0;
  (*server)->restrict_to(telepresence::Stream::thin, kPose);
  std::printf("%d\n", (*server)->port());
  std::fflush(stdout);
  std::jthread source{[&](const std::stop_token& stop) {
    using Clock = std::chrono::steady_clock;
    const auto step = std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<double>(period_s / telepresence::WebServer::kParts));
    auto next = Clock::now();
    for (int part = 0; !stop.stop_requested(); part = (part + 1) % telepresence::WebServer::kParts) {
      (*server)->broadcast_part(kPose, part, pose_at(monotonic_s()));
      next = std::max(next + step, Clock::now());  // what was missed is not caught up
      std::this_thread::sleep_until(next);
    }
  }};
  std::cin.ignore(std::numeric_limits<std::streamsize>::max());
  const auto figures = (*server)->figures();
  std::printf("{\"viewers\": %zu, \"messages\": %llu, \"skipped\": %llu}\n", figures.viewers,
              static_cast<unsigned long long>(figures.messages_out),
              static_cast<unsigned long long>(figures.values_skipped));
  return 0;
}
