#pragma once

#include <sqlite3.h>

#include <chrono>
#include <thread>

namespace docent::telepresence {

/// Has the connection wait for others who write, and look every 2 ms whether they have done, for `patience_ms` in all.
/// SQLite's own waiting looks ever more seldom, and whoever stores all the time is always first.
template <int patience_ms>
void wait_for_others(sqlite3* connection) {
  static constexpr int kLook = 2;  // [ms]
  sqlite3_busy_handler(
      connection,
      [](void* /*nothing*/, int times) {
        if (times * kLook >= patience_ms) return 0;
        std::this_thread::sleep_for(std::chrono::milliseconds{kLook});
        return 1;
      },
      nullptr);
}

}  // namespace docent::telepresence
