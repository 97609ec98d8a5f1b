#pragma once

#include <memory>
#include <string>

namespace boost::asio::ssl {
class context;
}

namespace docent::telepresence {

/// How both ends of an encrypted line prove that they hold the same key, and nobody without the key reads it: TLS 1.3
/// with a pre-shared key and an ephemeral one (RFC 8446, psk_dhe_ke), by OpenSSL. There are no certificates.
/// @param key  16 to 256 bytes
[[nodiscard]] std::shared_ptr<boost::asio::ssl::context> pre_shared(const std::string& key);

}  // namespace docent::telepresence
