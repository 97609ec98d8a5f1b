#include "docent/apps/doctor/computer.h"

#include <arpa/inet.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/timex.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "docent/telepresence/accounts/accounts.h"

namespace docent::apps::doctor_command {
namespace {

constexpr double kGigabyte = 1e9;
constexpr double kLeastDisk = 0.5;    // [GB] less stops recordings and the store
constexpr double kSmallDisk = 5.0;    // [GB] an hour of recording has some 0.3
constexpr double kSmallMemory = 1.8;  // [GB]
constexpr long kFewProcessors = 2;

/// The folder, or the nearest one above it that is there.
std::filesystem::path there(std::filesystem::path folder) {
  std::error_code error;
  while (!std::filesystem::exists(folder, error) && folder.has_parent_path() && folder != folder.parent_path())
    folder = folder.parent_path();
  return folder;
}

Finding disk_of(const std::string& state) {
  std::error_code error;
  const auto place = there(std::filesystem::absolute(state, error));
  if (!std::filesystem::is_directory(place, error))
    return {"computer", "state", Verdict::wrong, place.string() + " is not a folder (--state)"};
  const auto space = std::filesystem::space(place, error);
  if (error) return {"computer", "disk", Verdict::wrong, state + ": " + error.message()};
  const double free = static_cast<double>(space.available) / kGigabyte;
  Finding finding{
      "computer", "disk", Verdict::fine, text_of("%.1f GB free for %s", free, state.c_str()), {{"free_gb", free}}};
  if (free < kSmallDisk) finding.verdict = free < kLeastDisk ? Verdict::wrong : Verdict::note;
  if (::access(place.c_str(), W_OK) != 0) {
    finding.verdict = std::max(finding.verdict, Verdict::note);
    finding.text += "; this user may not write there (the service's may)";
  }
  return finding;
}

Finding processors() {
  const long count = ::sysconf(_SC_NPROCESSORS_ONLN);
  const double memory =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE)) / kGigabyte;
  const bool is_small = count < kFewProcessors || memory < kSmallMemory;
  return {"computer",
          "processors",
          is_small ? Verdict::note : Verdict::fine,
          text_of("%ld processors, %.1f GB%s", count, memory, is_small ? ": a robot wants 2 and 2 GB" : ""),
          {{"processors", static_cast<double>(count)}, {"memory_gb", memory}}};
}

Finding real_time(const modules::ProcessParams& processes) {
  if (processes.urgent != "realtime")
    return {"computer", "real time", Verdict::note, "processes.urgent is " + processes.urgent};
  rlimit limit{};
  const bool may = ::geteuid() == 0 || (::getrlimit(RLIMIT_RTPRIO, &limit) == 0 &&
                                        limit.rlim_cur >= static_cast<rlim_t>(processes.priority));
  return {"computer", "real time", may ? Verdict::fine : Verdict::note,
          may ? text_of("priority %d is allowed", processes.priority)
              : "this user has no right to it (docs/install.md); the service has"};
}

Finding clock_kept() {
  timex state{};
  const bool is_kept = ::adjtimex(&state) != TIME_ERROR;
  return {"computer", "clock", is_kept ? Verdict::fine : Verdict::note,
          is_kept ? "kept by a time service" : "nobody keeps it: fine for a base on this computer, else chrony"};
}

Finding port_of(const ComputerDemand& demand) {
  const std::string name = "port " + std::to_string(demand.port);
  const int end = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int yes = 1;
  ::setsockopt(end, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(demand.port));
  const bool is_free = ::bind(end, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  const std::string why = std::strerror(errno);
  ::close(end);
  if (is_free) return {"computer", name, Verdict::fine, "free for the page"};
  if (demand.robot_runs) return {"computer", name, Verdict::fine, "taken, by the robot that runs"};
  return {"computer", name, Verdict::wrong, why};
}

Finding accounts_of(const ComputerDemand& demand) {
  Finding finding{"computer", "accounts", Verdict::note, ""};
  const std::filesystem::path file = std::filesystem::path{demand.state} / "web.sqlite";
  std::error_code error;
  const std::string where = demand.web.database.empty() ? file.string() : demand.web.database;
  if (demand.web.database.empty() && !std::filesystem::exists(file, error)) {
    finding.text = "none yet: docent web-account add NAME";
    return finding;
  }
  auto database = telepresence::Database::open(where);
  if (!database) {
    finding.text = database.error().message;
    return finding;
  }
  auto accounts = telepresence::Accounts::open(**database);
  const auto list = accounts ? (*accounts)->list() : tl::unexpected<Error>(accounts.error());
  if (!list) {
    finding.text = list.error().message;
    return finding;
  }
  int operators = 0;
  for (const auto& account : *list) operators += account.rank == telepresence::Rank::operator_ ? 1 : 0;
  finding.verdict = operators > 0 ? Verdict::fine : Verdict::note;
  finding.text = text_of("%zu, %d of them operators", list->size(), operators);
  if (operators == 0) finding.text += ": nobody can stop the robot on the page (docent web-account add NAME)";
  return finding;
}

Finding https_of(const modules::WebParams& web) {
  const bool is_local = web.address == "127.0.0.1" || web.address == "::1" || web.address == "localhost";
  const bool is_secure = web.api.secure_cookies;
  if (is_secure && is_local)
    return {"computer", "https", Verdict::fine, "logins go by https alone, through a proxy on this computer"};
  if (is_secure)
    return {"computer", "https", Verdict::note,
            "logins go by https alone; the page itself is also open at " + web.address + ", without"};
  if (is_local)
    return {"computer", "https", Verdict::fine,
            "the page is for this computer alone; for others a proxy with https (docs/install.md)"};
  return {"computer", "https", Verdict::wrong,
          "the page is open at " + web.address + " without https: passwords can be read on the way"};
}

}  // namespace

std::vector<Finding> findings_of_computer(const ComputerDemand& demand) {
  return {disk_of(demand.state), processors(),        real_time(demand.processes), clock_kept(),
          port_of(demand),       accounts_of(demand), https_of(demand.web)};
}

}  // namespace docent::apps::doctor_command
