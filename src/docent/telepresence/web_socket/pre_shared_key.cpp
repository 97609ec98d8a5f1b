#include "docent/telepresence/web_socket/pre_shared_key.h"

#include <algorithm>
#include <boost/asio/ssl/context.hpp>

#include "docent/base/check.h"

namespace docent::telepresence {
namespace {

namespace ssl = boost::asio::ssl;

constexpr const char* kIdentity = "docent";  // of the one key that there is

/// Where a context keeps its key.
int key_index() {
  static const int index = SSL_CTX_get_ex_new_index(0, nullptr, nullptr, nullptr, nullptr);
  return index;
}

unsigned copy_key(SSL* line, unsigned char* place, unsigned room) {
  const auto* key = static_cast<const std::string*>(SSL_CTX_get_ex_data(SSL_get_SSL_CTX(line), key_index()));
  if (key == nullptr || key->size() > room) return 0;
  std::copy(key->begin(), key->end(), place);
  return static_cast<unsigned>(key->size());
}

unsigned key_of_server(SSL* line, const char* identity, unsigned char* place, unsigned room) {
  return std::string{kIdentity} == identity ? copy_key(line, place, room) : 0;
}

unsigned key_of_client(SSL* line, const char* /*hint*/, char* identity, unsigned longest, unsigned char* place,
                       unsigned room) {
  const std::string name = kIdentity;
  if (name.size() + 1 > longest) return 0;
  std::copy(name.begin(), name.end(), identity);
  identity[name.size()] = '\0';
  return copy_key(line, place, room);
}

}  // namespace

std::shared_ptr<ssl::context> pre_shared(const std::string& key) {
  DOCENT_CHECK(key.size() >= 16 && key.size() <= 256);
  struct Held {
    std::string key;
    ssl::context context{ssl::context::tls};
  };
  const auto held = std::make_shared<Held>();
  held->key = key;
  SSL_CTX* const context = held->context.native_handle();
  SSL_CTX_set_min_proto_version(context, TLS1_3_VERSION);
  // A key from these callbacks goes with this hash.
  DOCENT_CHECK(SSL_CTX_set_ciphersuites(context, "TLS_AES_128_GCM_SHA256") == 1);
  SSL_CTX_set_num_tickets(context, 0);
  SSL_CTX_set_ex_data(context, key_index(), &held->key);
  SSL_CTX_set_psk_server_callback(context, key_of_server);
  SSL_CTX_set_psk_client_callback(context, key_of_client);
  return {held, &held->context};
}

}  // namespace docent::telepresence
