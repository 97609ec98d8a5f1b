// For trials that kill it and damage its files:
//   docent_store_trial FILE write NAME             wishes, audit lines and passwords, as fast as they can be stored
//   docent_store_trial FILE read                   what is there
//   docent_store_trial FILE login NAME PASSWORD    whether that is right
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>

#include "docent/messages/docent_messages.h"
#include "docent/telepresence/accounts/accounts.h"
#include "docent/telepresence/api/audit.h"
#include "docent/telepresence/outbox.h"
#include "docent/telepresence/store/database.h"
#include "docent/telepresence/store/store_backups.h"

namespace {

using namespace docent;
using namespace docent::telepresence;

constexpr PasswordCost kCheap{1, 8192};
constexpr int kWishesOfPassword = 40;
constexpr int kWishesOfLook = 20;

Time now() { return Time{std::chrono::nanoseconds{std::chrono::system_clock::now().time_since_epoch()}.count()}; }

template <typename... Parts>
void say(const char* word, const Parts&... parts) {
  std::fputs(word, stdout);
  (std::printf(" %s", std::string{parts}.c_str()), ...);
  std::fputs("\n", stdout);
  std::fflush(stdout);
}

template <typename T>
T open_or_end(Result<T> opened) {
  if (opened) return std::move(*opened);
  say("refused", opened.error().message);
  std::exit(1);
}

struct Trial {
  explicit Trial(const std::string& file)
      : database{open_or_end(Database::open(file))},
        accounts{open_or_end(Accounts::open(*database, kCheap))},
        audit{open_or_end(Audit::open(*database))},
        outbox{open_or_end(Outbox::open(*database))} {}
  std::unique_ptr<Database> database;
  std::unique_ptr<Accounts> accounts;
  std::unique_ptr<Audit> audit;
  std::unique_ptr<Outbox> outbox;
};

void tell_notice(const Database& database, std::string& told) {
  if (const std::string notice = database.notice(); !notice.empty() && notice != told) {
    say("notice", notice);
    told = notice;
  }
}

template <typename Done>
bool is_stored(const Done& done) {
  if (done) return true;
  say("refused", done.error().message);
  std::this_thread::sleep_for(std::chrono::milliseconds{20});
  return false;
}

int write(Trial& trial, const std::string& file, const std::string& name) {
  std::string told;
  const StoreBackups backups{std::filesystem::path{file}.parent_path(), file, ""};
  const std::int64_t today = now().nanoseconds / 1'000'000'000;
  if (backups.is_due(today)) (void)is_stored(backups.make(today));
  say("trying", "ada", "password of ada");
  if (trial.accounts->add("ada", "password of ada", Rank::operator_, now())) say("password", "ada", "password of ada");
  for (int number = 1;; ++number) {
    const std::string token = "wish<" + name + "-" + std::to_string(number) + ">";
    docent_msgs::Request wish;
    wish.id = name + "-" + std::to_string(number);
    wish.source = "web";
    wish.visitor = token;
    wish.kind = "visit";
    wish.target = "an exhibit";
    if (is_stored(trial.outbox->put(wish))) say("stored", token);
    const std::string line = "line<" + name + "-" + std::to_string(number) + ">";
    if (number % 3 == 0 && is_stored(trial.audit->add({now(), "account:ada", "judge_post", line, "192.0.2.1"})))
      say("stored", line);
    if (number % kWishesOfPassword == 0) {
      const std::string password = "password " + name + " " + std::to_string(number);
      say("trying", "ada", password);
      if (is_stored(trial.accounts->set_password("ada", password))) say("password", "ada", password);
    }
    if (number % kWishesOfLook == 0) (void)is_stored(trial.database->look());
    tell_notice(*trial.database, told);
  }
}

int read(Trial& trial) {
  std::string told;
  tell_notice(*trial.database, told);
  const auto wishes = trial.database->run("SELECT visitor FROM outbox");
  const auto lines = trial.database->run("SELECT about FROM audit");
  if (!is_stored(wishes) || !is_stored(lines)) return 1;
  for (const auto* rows : {&*wishes, &*lines})
    for (const Row& row : rows->rows) say("has", row.text(0));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const std::string what = argv[2];
  Trial trial{argv[1]};
  if (what == "write" && argc == 4) return write(trial, argv[1], argv[3]);
  if (what == "read") return read(trial);
  if (what != "login" || argc != 5) return 2;
  const auto person = trial.accounts->check(argv[3], argv[4]);
  say(person && *person ? "right" : "wrong");
  return 0;
}
