#include "docent/apps/web_account/web_account_command.h"

#include <termios.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>

#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/command.h"
#include "docent/apps/shared/deployment.h"
#include "docent/telepresence/accounts/accounts.h"

namespace docent::apps::web_account_command {
namespace {

struct Options {
  std::string name;
  std::string role = "operator";
  std::string state = default_state();
  std::string database;
};

Time now() { return Time{std::chrono::nanoseconds{std::chrono::system_clock::now().time_since_epoch()}.count()}; }

/// The accounts, and the store that they lie in.
struct Opened {
  std::unique_ptr<telepresence::Database> database;
  std::unique_ptr<telepresence::Accounts> accounts;
};

Opened open(const Options& options) {
  std::string where = options.database;
  if (where.empty()) {
    std::error_code ignored;
    std::filesystem::create_directories(options.state, ignored);
    where = (std::filesystem::path{options.state} / "web.sqlite").string();
  }
  Opened opened;
  opened.database = value_or_fail(telepresence::Database::open(where));
  opened.accounts = value_or_fail(telepresence::Accounts::open(*opened.database));
  return opened;
}

void list(const Options& options) {
  const Opened opened = open(options);
  const auto accounts = value_or_fail(opened.accounts->list());
  if (accounts.empty()) std::printf("no accounts\n");
  for (const auto& account : accounts) std::printf("%-24s %s\n", account.name.c_str(), to_text(account.rank));
}

void add(const Options& options) {
  const Opened opened = open(options);
  const auto rank = parse<telepresence::Rank>(options.role).value_or(telepresence::Rank::viewer);
  value_or_fail(opened.accounts->add(options.name, read_secret("password for " + options.name + ": "), rank, now()));
  const char* article = options.role.starts_with('o') ? "an" : "a";
  std::printf("%s is %s %s now; they log in on the page /operate\n", options.name.c_str(), article,
              options.role.c_str());
}

void set_password(const Options& options) {
  const Opened opened = open(options);
  value_or_fail(opened.accounts->set_password(options.name, read_secret("new password for " + options.name + ": ")));
  std::printf("done; they have to log in again\n");
}

void remove(const Options& options) {
  const Opened opened = open(options);
  value_or_fail(opened.accounts->remove(options.name));
  std::printf("%s has no account any more\n", options.name.c_str());
}

}  // namespace

std::string read_secret(const std::string& prompt) {
  termios shown{};
  const bool is_terminal = ::isatty(STDIN_FILENO) == 1 && ::tcgetattr(STDIN_FILENO, &shown) == 0;
  if (is_terminal) {
    std::fputs(prompt.c_str(), stderr);
    termios hidden = shown;
    hidden.c_lflag &= ~static_cast<tcflag_t>(ECHO);
    ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &hidden);
  }
  std::string secret;
  std::getline(std::cin, secret);
  if (is_terminal) {
    ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &shown);
    std::fputs("\n", stderr);
  }
  return secret;
}

void add_web_account_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand("web-account", "who may moderate the forum and operate the robot on the Web");
  command.require_subcommand(1);
  const auto part = [&](const char* name, const char* meaning, void (*run)(const Options&)) {
    CLI::App& sub = *command.add_subcommand(name, meaning);
    sub.add_option("--state", options->state, "folder of the robot's state, as for docent up")
        ->check(kept_folder())
        ->capture_default_str();
    sub.add_option("--database", options->database, "where several gateways share one: postgresql://…");
    if (std::string{name} != "list")
      sub.add_option("NAME", options->name, "of the account: a-z, 0-9, _ - .")->required();
    sub.callback([options, run] { run(*options); });
    return &sub;
  };
  part("add", "adds an account; its password is asked for, or the first line of the standard input", add)
      ->add_option("--role", options->role, "moderator or operator")
      ->check(CLI::IsMember({"moderator", "operator"}))
      ->capture_default_str();
  part("passwd", "sets another password", set_password);
  part("remove", "removes an account, and ends its logins", remove);
  part("list", "lists the accounts", list);
}

}  // namespace docent::apps::web_account_command
