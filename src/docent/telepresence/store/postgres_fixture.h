#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

// For tests: a PostgreSQL of their own, on a socket in a temporary folder.

namespace docent::telepresence {

class Postgres {
 public:
  Postgres() {
    std::error_code ignored;
    for (const auto& version : std::filesystem::directory_iterator("/usr/lib/postgresql", ignored))
      programs_ = version.path() / "bin";
    if (programs_.empty()) return;
    char name[] = "/tmp/docent-postgres-XXXXXX";
    folder_ = ::mkdtemp(name);
    const bool is_root = ::geteuid() == 0;
    if (is_root) run("chown postgres " + folder_.string());
    as_ = is_root ? "setpriv --reuid postgres --regid postgres --clear-groups " : "";
    const std::string data = (folder_ / "data").string();
    is_running_ = run(as_ + (programs_ / "initdb").string() + " -D " + data + " -A trust -U docent --no-sync") &&
                  run(as_ + (programs_ / "pg_ctl").string() + " -w -D " + data + " -l " + (folder_ / "log").string() +
                      " -o \"-c listen_addresses='' -c unix_socket_directories=" + folder_.string() + "\" start");
  }
  Postgres(const Postgres&) = delete;
  Postgres& operator=(const Postgres&) = delete;
  ~Postgres() {
    if (folder_.empty()) return;
    run(as_ + (programs_ / "pg_ctl").string() + " -m immediate -D " + (folder_ / "data").string() + " stop");
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  [[nodiscard]] bool is_installed() const { return !programs_.empty(); }
  [[nodiscard]] bool is_running() const { return is_running_; }
  [[nodiscard]] std::string address() const { return "postgresql:///postgres?user=docent&host=" + folder_.string(); }
  /// All connections are cut.
  bool restart() const {
    return run(as_ + (programs_ / "pg_ctl").string() + " -w -m immediate -D " + (folder_ / "data").string() +
               " restart");
  }
  /// All its processes stand, or go on: nobody is told, and nothing is closed.
  bool hang(bool stands) const {
    const std::string signal = stands ? "STOP" : "CONT";
    return run("P=$(head -n1 " + (folder_ / "data" / "postmaster.pid").string() + "); kill -" + signal +
               " $P $(ps -o pid= --ppid $P)");
  }

 private:
  static bool run(const std::string& command) { return std::system((command + " >/dev/null 2>&1").c_str()) == 0; }

  std::filesystem::path programs_;
  std::filesystem::path folder_;
  std::string as_;
  bool is_running_ = false;
};

}  // namespace docent::telepresence
