#pragma once

#include <string>
#include <string_view>

#include "docent/messages/schema.h"

namespace docent::transport {

/// What ROS 2 calls a type's hash, by which two programs know that they mean the same message (REP 2016): "RIHS01_" and
/// the SHA-256 of the type's description with those of all types that it nests, in the canonical form of JSON.
/// @param schemas  a message and all that it nests, the message last (message_schemas). A bounded string is
///                 "string<=256", an octet "byte".
[[nodiscard]] std::string type_hash(const MessageSchemas& schemas);

/// That of a type which goes over the bus, "sensor_msgs/msg/LaserScan"; empty: of none that Docent knows.
[[nodiscard]] const std::string& type_hash_of(std::string_view type);

/// What an endpoint of this type carries in USER_DATA: "typehash=RIHS01_…;". Empty where the hash is.
[[nodiscard]] std::string endpoint_user_data(std::string_view type);

/// What a participant carries there: "enclave=/;".
inline constexpr std::string_view kParticipantUserData = "enclave=/;";

}  // namespace docent::transport
