#include "docent/telepresence/accounts/secrets.h"

#include <sodium.h>

#include <array>

#include "docent/base/check.h"

namespace docent::telepresence {
namespace {

/// Before anything else of the library; any thread, any number of times.
void begin() {
  static const bool is_ready = sodium_init() >= 0;
  DOCENT_CHECK(is_ready);
}

template <std::size_t N>
std::string hexadecimal(const std::array<unsigned char, N>& bytes) {
  std::array<char, 2 * N + 1> text{};
  sodium_bin2hex(text.data(), text.size(), bytes.data(), bytes.size());
  return {text.data(), 2 * N};
}

}  // namespace

Result<std::string> hash_password(const std::string& password, const PasswordCost& cost) {
  begin();
  std::array<char, crypto_pwhash_STRBYTES> text{};
  const int failed = crypto_pwhash_str_alg(text.data(), password.data(), password.size(), cost.passes,
                                           cost.memory_bytes, crypto_pwhash_ALG_ARGON2ID13);
  if (failed != 0) return fail("there is not enough memory to hash a password");
  return std::string{text.data()};
}

bool is_password(const std::string& password, const std::string& hash) {
  begin();
  std::array<char, crypto_pwhash_STRBYTES> text{};
  if (hash.size() >= text.size()) return false;
  hash.copy(text.data(), hash.size());
  return crypto_pwhash_str_verify(text.data(), password.data(), password.size()) == 0;
}

std::string make_token() {
  begin();
  std::array<unsigned char, 32> bytes{};
  randombytes_buf(bytes.data(), bytes.size());
  return hexadecimal(bytes);
}

std::string hash_token(std::string_view token) {
  begin();
  std::array<unsigned char, crypto_generichash_BYTES> hash{};
  crypto_generichash(hash.data(), hash.size(), reinterpret_cast<const unsigned char*>(token.data()), token.size(),
                     nullptr, 0);
  return hexadecimal(hash);
}

bool is_same_secret(std::string_view a, std::string_view b) {
  return a.size() == b.size() && sodium_memcmp(a.data(), b.data(), a.size()) == 0;
}

}  // namespace docent::telepresence
