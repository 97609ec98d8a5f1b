#include "docent/apps/state/state_command.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/command.h"
#include "docent/apps/shared/deployment.h"
#include "docent/telepresence/store/salvage/private_files.h"
#include "docent/telepresence/store/salvage/recovery.h"
#include "docent/telepresence/store/sqlite_files.h"
#include "docent/telepresence/store/store_backups.h"
#include "docent/telepresence/store/store_lock.h"

namespace docent::apps::state_command {
namespace {

namespace fs = std::filesystem;
using telepresence::SqliteFiles;
using telepresence::StoreBackups;
using telepresence::StoreLock;

constexpr const char* kDatabase = "web.sqlite";

struct Options {
  std::string state = default_state();
  std::string museum;
  std::string to;
  std::string from;
};

fs::path database_of(const Options& options) { return fs::path{options.state} / kDatabase; }

void want_state(const Options& options) {
  if (!fs::is_directory(options.state)) throw CommandFailed{"--state " + options.state + ": there is no such folder"};
}

/// Copies what may be damaged, for to look at it is to change it.
std::string fault_of_closed(const SqliteFiles& files) {
  const std::string seen = files.fault(false);
  if (!seen.empty()) return seen;
  char name[] = "/tmp/docent-state-XXXXXX";
  if (::mkdtemp(name) == nullptr) throw CommandFailed{"/tmp: cannot be written"};
  const fs::path folder = name;
  std::error_code code;
  for (const fs::path& file : {files.file(), files.wal()})
    if (fs::exists(file, code)) fs::copy_file(file, folder / file.filename(), code);
  const std::string fault = code ? "cannot be copied to " + folder.string() + ": " + code.message()
                                 : telepresence::fault_of_database(folder / files.file().filename());
  fs::remove_all(folder, code);
  return fault;
}

void check(const Options& options) {
  want_state(options);
  const SqliteFiles files{database_of(options)};
  std::error_code ignored;
  std::string fault;
  if (!fs::exists(files.file(), ignored) && !fs::exists(files.accounts(), ignored)) {
    std::printf("%s: there is none yet\n", files.file().c_str());
  } else {
    const auto lock = value_or_fail(StoreLock::open(files.file()));
    lock.wait_for(StoreLock::Part::files, StoreLock::Kind::alone);
    const bool is_open = !lock.try_for(StoreLock::Part::use, StoreLock::Kind::alone);
    fault = is_open ? telepresence::fault_of_database(files.file()) : fault_of_closed(files);
    std::printf("%s: %s%s\n", files.file().c_str(), fault.empty() ? "sound" : fault.c_str(),
                is_open ? " (a program has it open)" : "");
    if (const auto note = lock.note(); !note.said.empty()) std::printf("  %s\n", note.said.c_str());
  }
  const auto backups = StoreBackups{options.state, files.file().string(), ""}.list();
  if (backups.empty()) std::printf("no backups\n");
  for (const fs::path& backup : backups) {
    const fs::path copy = backup / kDatabase;
    const std::string wrong = fs::exists(copy, ignored) ? telepresence::fault_of_database(copy) : "";
    std::printf("backup %s: %s%s\n", backup.filename().c_str(), wrong.empty() ? "sound" : wrong.c_str(),
                fs::exists(backup / "museum", ignored) ? ", with the museum" : "");
  }
  if (!fault.empty())
    throw CommandFailed{
        "the store is damaged: the next program that opens it recovers what is left, and keeps the "
        "damaged files"};
}

void backup(const Options& options) {
  want_state(options);
  if (!options.museum.empty() && !fs::is_directory(options.museum))
    throw CommandFailed{"--museum " + options.museum + ": there is no such folder"};
  if (!fs::exists(database_of(options))) throw CommandFailed{database_of(options).string() + ": there is none yet"};
  const StoreBackups backups{options.state, database_of(options).string(), options.museum};
  if (options.to.empty()) {
    std::printf("%s\n", value_or_fail(backups.make(telepresence::seconds_now())).c_str());
    return;
  }
  const fs::path to = fs::absolute(options.to).lexically_normal();
  if (fs::exists(to)) throw CommandFailed{"--to " + options.to + " is there already"};
  if (!fs::is_directory(to.parent_path()) || ::access(to.parent_path().c_str(), W_OK) != 0)
    throw CommandFailed{"--to " + options.to + ": nothing can be written into " + to.parent_path().string()};
  value_or_fail(backups.make_in(to));
  std::printf("%s\n", to.c_str());
}

/// As `docent up` holds it while it runs.
void want_no_robot(const Options& options) {
  const std::string path = options.state + "/up.lock";
  const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) return;
  const bool is_free = ::flock(file, LOCK_EX | LOCK_NB) == 0;
  ::close(file);
  if (!is_free) throw CommandFailed{"--state " + options.state + ": a robot runs on it; end it first"};
}

fs::path backup_named(const Options& options) {
  const auto all = StoreBackups{options.state, database_of(options).string(), ""}.list();
  if (options.from.empty()) {
    if (all.empty()) throw CommandFailed{options.state + "/backups: there is no backup"};
    return all.back();
  }
  const fs::path named = fs::path{options.state} / "backups" / options.from;
  const fs::path from =
      options.from.find('/') == std::string::npos && fs::is_directory(named) ? named : fs::path{options.from};
  if (!fs::is_directory(from)) throw CommandFailed{"--from " + options.from + ": there is no such backup"};
  return from;
}

void restore(const Options& options) {
  want_state(options);
  const fs::path from = backup_named(options);
  const bool has_database = fs::exists(from / kDatabase);
  if (!has_database && options.museum.empty()) throw CommandFailed{from.string() + " holds no " + kDatabase};
  if (!options.museum.empty() && !fs::is_directory(from / "museum"))
    throw CommandFailed{from.string() + " holds no museum"};
  want_no_robot(options);
  const auto say = [](const fs::path& what, const fs::path& kept) {
    std::printf("%s is as the backup has it%s%s\n", what.c_str(), kept.empty() ? "" : "; what it was is ",
                kept.c_str());
  };
  if (has_database)
    say(database_of(options), value_or_fail(StoreBackups::restore_database(from / kDatabase, database_of(options))));
  if (options.museum.empty()) return;
  fs::path museum = fs::absolute(options.museum).lexically_normal();
  if (museum.filename().empty()) museum = museum.parent_path();
  say(museum, value_or_fail(StoreBackups::restore_museum(from / "museum", museum)));
}

}  // namespace

void add_state_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand("state", "checks, copies and puts back accounts, forum, counts and museum");
  command.require_subcommand(1);
  command.footer(
      "Each day the robot makes a backup of itself, STATE/backups/DAY, and keeps seven.\n\n"
      "  docent state check\n"
      "  docent state backup --museum my-museum --to /media/stick/docent-backup\n"
      "  docent state restore --from 20261129");
  const auto part = [&](const char* name, const char* meaning, void (*run)(const Options&)) {
    CLI::App& sub = *command.add_subcommand(name, meaning);
    sub.add_option("--state", options->state, "folder of the robot's state, as for docent up")
        ->check(kept_folder())
        ->capture_default_str();
    sub.callback([options, run] { run(*options); });
    return &sub;
  };
  part("check", "says whether the store is sound, and which backups there are; changes nothing", check);
  CLI::App& copy = *part("backup", "makes a backup now; the robot may run", backup);
  copy.add_option("--museum", options->museum, "folder of the museum, to be copied too");
  copy.add_option("--to", options->to, "a new folder; STATE/backups/DAY without it");
  CLI::App& back =
      *part("restore", "puts a backup in the place of the store, which is kept; no robot may run", restore);
  back.add_option("--from", options->from, "a day of STATE/backups, or a folder; the newest without it");
  back.add_option("--museum", options->museum, "folder of the museum, to be put back too");
}

}  // namespace docent::apps::state_command
