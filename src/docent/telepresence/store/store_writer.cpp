// docent_store_writer WHERE NAME: writes numbered rows as fast as it can and says each number once it is stored. For
// tests that kill it.
#include <cstdio>
#include <string>

#include "docent/telepresence/store/database.h"
#include "docent/telepresence/store/migrations.h"

int main(int argc, char** argv) {
  using namespace docent::telepresence;
  if (argc != 3) return 2;
  auto database = Database::open(argv[1]);
  if (!database) {
    std::fprintf(stderr, "%s\n", database.error().message.c_str());
    return 1;
  }
  constexpr Migration kTables[] = {{"rows", "CREATE TABLE rows (writer TEXT NOT NULL, number BIGINT NOT NULL)"}};
  if (auto made = migrate(**database, "writer", kTables); !made) {
    std::fprintf(stderr, "%s\n", made.error().message.c_str());
    return 1;
  }
  for (std::int64_t number = 1;; ++number) {
    if (!(*database)->run("INSERT INTO rows (writer, number) VALUES ($1, $2)", {std::string{argv[2]}, number}))
      return 1;
    std::printf("%lld\n", static_cast<long long>(number));
    std::fflush(stdout);
  }
}
