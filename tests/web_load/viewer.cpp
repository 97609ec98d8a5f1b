#include "viewer.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <utility>

namespace docent::web_load {

Viewer::Viewer(int port, std::string_view path, Pace pace) : pace_{pace}, path_{path} {
  descriptor_ = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0);
  if (descriptor_ < 0) return;
  if (pace != Pace::prompt) {  // somebody far away has a small window
    const int bytes = 4096;
    ::setsockopt(descriptor_, SOL_SOCKET, SO_RCVBUF, &bytes, sizeof bytes);
  }
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(descriptor_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0 && errno != EINPROGRESS)
    close();
}

Viewer::Viewer(Viewer&& other) noexcept
    : descriptor_{std::exchange(other.descriptor_, -1)},
      pace_{other.pace_},
      path_{std::move(other.path_)},
      buffer_{std::move(other.buffer_)},
      has_greeted_{other.has_greeted_},
      is_open_{other.is_open_} {}

Viewer::~Viewer() { close(); }

void Viewer::close() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
  is_open_ = false;
}

void Viewer::greet() {
  if (has_greeted_ || descriptor_ < 0) return;
  has_greeted_ = true;
  const std::string request = "GET " + path_ +
                              " HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                              "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n";
  if (::send(descriptor_, request.data(), request.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(request.size()))
    close();
}

void Viewer::read(std::size_t most, std::vector<std::string>& texts) {
  std::array<char, 16384> bytes;
  while (descriptor_ >= 0 && most > 0) {
    const ssize_t count = ::recv(descriptor_, bytes.data(), std::min(most, bytes.size()), 0);
    if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) break;
    if (count <= 0) return close();
    buffer_.append(bytes.data(), static_cast<std::size_t>(count));
    most -= static_cast<std::size_t>(count);
  }
  if (!is_open_) {
    const std::size_t end = buffer_.find("\r\n\r\n");
    if (end == std::string::npos) return;
    if (!buffer_.starts_with("HTTP/1.1 101")) return close();
    is_open_ = true;
    buffer_.erase(0, end + 4);
  }
  while (take_frame(texts)) {
  }
  if (buffer_.empty()) buffer_.shrink_to_fit();
}

bool Viewer::take_frame(std::vector<std::string>& texts) {
  const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(buffer_[at]); };
  if (buffer_.size() < 2) return false;
  std::size_t header = 2;
  std::uint64_t length = byte(1) & 0x7FU;
  if (length >= 126) {
    const std::size_t more = length == 126 ? 2 : 8;
    header += more;
    if (buffer_.size() < header) return false;
    length = 0;
    for (std::size_t i = 0; i < more; ++i) length = length << 8U | byte(2 + i);
  }
  if (buffer_.size() < header + length) return false;
  const unsigned kind = byte(0) & 0x0FU;
  if (kind == 1) texts.push_back(buffer_.substr(header, length));
  if (kind == 8) {
    close();
    return false;
  }
  if (kind == 9 && descriptor_ >= 0) {  // a ping: the pong is masked with zeros
    std::string pong{"\x8A\x80\0\0\0\0", 6};
    pong[1] = static_cast<char>(0x80U | length);
    pong += buffer_.substr(header, length);
    if (::send(descriptor_, pong.data(), pong.size(), MSG_NOSIGNAL) < 0 && errno != EAGAIN) close();
  }
  buffer_.erase(0, header + length);
  return true;
}

}  // namespace docent::web_load
