#pragma once

#include <array>
#include <string>
#include <vector>

#include "docent/base/random.h"
#include "docent/messages/cdr.h"

// For tests of everything that carries messages.

namespace docent {

/// Fills any message with random content.
struct RandomFiller {
  Rng rng;
  template <class T>
  void operator()(const char* /*name*/, T& field) {
    fill(field);
  }
  template <class T>
  void fill(T& field) {
    if constexpr (Message<T>) {
      T::visit(field, *this);
    } else if constexpr (std::is_same_v<T, bool>) {
      field = rng.chance(0.5);
    } else {
      field = static_cast<T>(rng.integer(0, 100));
    }
  }
  void fill(std::string& text) { text = std::string(static_cast<std::size_t>(rng.integer(0, 9)), 'a'); }
  template <class T>
  void fill(std::vector<T>& items) {
    items.resize(static_cast<std::size_t>(rng.integer(0, 4)));
    for (auto& item : items) fill(item);
  }
  template <class T, std::size_t N>
  void fill(std::array<T, N>& items) {
    for (auto& item : items) fill(item);
  }
};

template <Message T>
[[nodiscard]] T random_message(std::uint64_t seed) {
  RandomFiller filler{Rng{seed}};
  T message;
  filler.fill(message);
  return message;
}

}  // namespace docent
