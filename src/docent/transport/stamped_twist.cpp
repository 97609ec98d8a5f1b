#include "docent/transport/stamped_twist.h"

#include <chrono>

#include "docent/messages/conversions.h"
#include "docent/messages/message_fitness.h"
#include "docent/messages/standard_messages.h"

namespace docent::transport {
namespace {

std::vector<std::uint8_t> encode(const void* message) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  geometry_msgs::TwistStamped stamped;
  stamped.header = {to_message(Time{std::chrono::duration_cast<Duration>(now).count()}), "base_link"};
  stamped.twist = *static_cast<const geometry_msgs::Twist*>(message);
  return encode_cdr(stamped);
}

std::shared_ptr<const void> decode(std::span<const std::uint8_t> bytes) {
  const auto stamped = decode_cdr<geometry_msgs::TwistStamped>(bytes);
  return stamped ? std::make_shared<const geometry_msgs::Twist>(stamped->twist) : nullptr;
}

}  // namespace

const TypeSupport& stamped_twist_support() {
  static constexpr TypeSupport kSupport{geometry_msgs::TwistStamped::kType, encode, decode, [](const void* message) {
                                          return fault_of(*static_cast<const geometry_msgs::Twist*>(message));
                                        }};
  return kSupport;
}

}  // namespace docent::transport
