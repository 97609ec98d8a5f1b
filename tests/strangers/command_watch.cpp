// docent_command_watch DOMAIN: what the base is told and what it does, a line each, by the monotonic clock [s].
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "docent/messages/docent_messages.h"
#include "docent/messages/topics.h"
#include "docent/transport/dds_bus.h"

namespace {

double now_s() { return std::chrono::duration<double>{std::chrono::steady_clock::now().time_since_epoch()}.count(); }

void print(const char* what, double linear, double angular) {
  std::printf("%s %.4f %.4f %.4f\n", what, now_s(), linear, angular);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "docent_command_watch DOMAIN\n");
    return 2;
  }
  auto bus = docent::transport::DdsBus::create({std::atoi(argv[1]), "", {}});
  if (!bus) {
    std::fprintf(stderr, "%s\n", bus.error().message.c_str());
    return 2;
  }
  (*bus)->subscribe<docent::geometry_msgs::Twist>(
      docent::topics::kCommandVelocity,
      [](const docent::geometry_msgs::Twist& command) { print("command", command.linear.x, command.angular.z); });
  (*bus)->subscribe<docent::nav_msgs::Odometry>(
      docent::topics::kOdometry, [](const docent::nav_msgs::Odometry& odometry) {
        print("moves", odometry.twist.twist.linear.x, odometry.twist.twist.angular.z);
      });
  std::jthread end{[&](const std::stop_token&) {
    while (std::getchar() != EOF) {
    }
    std::_Exit(0);  // whoever watched is gone
  }};
  (*bus)->run({});
  return 0;
}
