#pragma once

#include <string>
#include <string_view>

#include "docent/base/result.h"

// Passwords and tokens, by libsodium.

namespace docent::telepresence {

/// How dear a password is to try.
struct PasswordCost {
  unsigned long long passes = 2;         ///< over the memory
  std::size_t memory_bytes = 19U << 20;  ///< what OWASP asks of argon2id at least, with two passes
};

/// argon2id with a salt of its own, as text that also says what it cost. Error: there is not so much memory.
[[nodiscard]] Result<std::string> hash_password(const std::string& password, const PasswordCost& cost = {});
/// Takes as long as hash_password did.
[[nodiscard]] bool is_password(const std::string& password, const std::string& hash);

/// 256 random bits as 64 hexadecimal digits.
[[nodiscard]] std::string make_token();
/// BLAKE2b of a token, under which it is stored: whoever reads the store cannot use it.
[[nodiscard]] std::string hash_token(std::string_view token);
/// In the same time whatever the two have in common.
[[nodiscard]] bool is_same_secret(std::string_view a, std::string_view b);

}  // namespace docent::telepresence
