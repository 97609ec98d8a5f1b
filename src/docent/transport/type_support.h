#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "docent/transport/bus.h"

namespace docent::transport {

/// How type_support is made. Only type_support.cpp needs it, and a test with a type of its own.
template <Message T>
constexpr TypeSupport support_of() {
  return {T::kType, [](const void* message) { return encode_cdr(*static_cast<const T*>(message)); },
          [](std::span<const std::uint8_t> bytes) -> std::shared_ptr<const void> {
            auto message = decode_cdr<T>(bytes);
            return message ? std::make_shared<const T>(std::move(*message)) : nullptr;
          },
          [](const void* message) { return fault_of(*static_cast<const T*>(message)); }};
}

}  // namespace docent::transport
