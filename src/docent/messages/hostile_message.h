#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "docent/base/random.h"
#include "docent/messages/cdr.h"

// For tests of everything that messages from outside reach: whatever may stand in a field that decodes.

namespace docent {

/// Spoils fields of a message: each number, text or count with probability `share`.
class HostileFiller {
 public:
  static constexpr std::int64_t kMost = 20000;  ///< items in a list

  HostileFiller(Rng& rng, double share) : rng_{rng}, share_{share} {}

  template <class T>
  void operator()(const char* /*name*/, T& field) {
    fill(field);
  }
  template <class T>
  void fill(T& field) {
    if constexpr (Message<T>) {
      T::visit(field, *this);
    } else if (rng_.chance(share_)) {
      if constexpr (std::is_same_v<T, bool>) {
        field = !field;
      } else if constexpr (std::is_floating_point_v<T>) {
        field = real<T>();
      } else {
        field = whole<T>();
      }
    }
  }
  void fill(std::string& text) {
    if (rng_.chance(share_)) text = rng_.chance(0.5) ? std::string{} : std::string(rng_.chance(0.5) ? 300 : 5, 'x');
  }
  template <class T>
  void fill(std::vector<T>& items) {
    for (auto& item : items) fill(item);
    if (rng_.chance(share_)) items.resize(rng_.chance(0.3) ? 0 : size(), items.empty() ? T{} : T{items.front()});
  }
  template <class T, std::size_t N>
  void fill(std::array<T, N>& items) {
    for (auto& item : items) fill(item);
  }

 private:
  template <class T>
  T real() {
    using Limits = std::numeric_limits<T>;
    const T numbers[] = {Limits::quiet_NaN(),
                         Limits::infinity(),
                         -Limits::infinity(),
                         T(1e30),
                         T(-1e30),
                         Limits::max(),
                         Limits::lowest(),
                         Limits::min(),
                         Limits::denorm_min(),
                         T(-0.0),
                         T(0.0),
                         T(1e-20),
                         T(-1e-20),
                         T(1e7),
                         T(-1e7),
                         T(1e-5),
                         T(7.0),
                         T(-7.0),
                         T(3000.0),
                         T(-1.0)};
    return numbers[rng_.integer(0, std::size(numbers) - 1)];
  }
  template <class T>
  T whole() {
    using Limits = std::numeric_limits<T>;
    const T numbers[] = {T{0}, T{1}, T{100}, Limits::max(), Limits::min(), T(Limits::max() / 2), T(Limits::max() - 1)};
    return numbers[rng_.integer(0, std::size(numbers) - 1)];
  }
  std::size_t size() {
    const std::int64_t sizes[] = {1, 2, 300, 5000, kMost};
    return static_cast<std::size_t>(sizes[rng_.integer(0, std::size(sizes) - 1)]);
  }

  Rng& rng_;
  double share_;
};

template <Message T>
void spoil(T& message, Rng& rng, double share) {
  HostileFiller{rng, share}.fill(message);
}

}  // namespace docent
