#pragma once

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

// For tests only.

namespace docent::telepresence {

/// A client made of a bare socket, so that it can misbehave.
class TestClient {
 public:
  /// @param from  of this computer: 127.0.0.2 and so on are other callers
  explicit TestClient(int port, int receive_buffer = 0, const char* from = "127.0.0.1")
      : socket_{::socket(AF_INET, SOCK_STREAM, 0)} {
    if (receive_buffer > 0) ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = ::inet_addr(from);
    if (::bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) return;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    is_connected_ = ::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
  }
  ~TestClient() { ::close(socket_); }
  TestClient(const TestClient&) = delete;
  TestClient& operator=(const TestClient&) = delete;

  [[nodiscard]] bool is_connected() const { return is_connected_; }
  void send(const std::string& bytes) const {
    for (std::size_t at = 0; at < bytes.size();) {
      const auto sent = ::send(socket_, bytes.data() + at, bytes.size() - at, MSG_NOSIGNAL);
      if (sent <= 0) return;
      at += static_cast<std::size_t>(sent);
    }
  }
  /// Waits for at least one byte; false at the end of the stream or when nothing comes.
  bool receive(std::chrono::milliseconds patience = std::chrono::milliseconds{3000}) {
    pollfd wait{socket_, POLLIN, 0};
    if (::poll(&wait, 1, static_cast<int>(patience.count())) <= 0) return false;
    char bytes[65536];
    const auto got = ::recv(socket_, bytes, sizeof bytes, 0);
    if (got <= 0) return false;
    buffer_.append(bytes, static_cast<std::size_t>(got));
    return true;
  }
  /// The server has not closed it, or something of it is still to be read.
  [[nodiscard]] bool is_alive() const {
    char byte = 0;
    const auto got = ::recv(socket_, &byte, 1, MSG_PEEK | MSG_DONTWAIT);
    return got > 0 || (got < 0 && (errno == EAGAIN || errno == EINTR));
  }
  /// All that comes until the server closes.
  std::string receive_all() {
    while (receive()) {
    }
    return std::exchange(buffer_, {});
  }
  /// Head and body of the next answer.
  std::pair<std::string, std::string> receive_reply() {
    std::size_t end = 0;
    while ((end = buffer_.find("\r\n\r\n")) == std::string::npos) {
      if (!receive()) return {buffer_, ""};
    }
    const std::string head = buffer_.substr(0, end + 4);
    const auto length_at = head.find("Content-Length: ");
    const std::size_t length = length_at == std::string::npos ? 0 : std::stoul(head.substr(length_at + 16));
    while (buffer_.size() < end + 4 + length && receive()) {
    }
    const std::string body = buffer_.substr(end + 4, length);
    buffer_.erase(0, end + 4 + length);
    return {head, body};
  }
  /// True when the server accepts the upgrade.
  bool upgrade(const std::string& extra = "", const std::string& path = "/live") {
    send("GET " + path +
         " HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n" +
         extra + "\r\n");
    const auto [head, body] = receive_reply();
    return head.starts_with("HTTP/1.1 101") && head.find("s3pPLMBiTxaQ9kYGzzhZRbK+xOo=") != std::string::npos;
  }
  void send_frame(const std::string& payload, int opcode = 1) const {
    std::string frame(1, static_cast<char>(0x80 | opcode));
    if (payload.size() < 126) {
      frame += static_cast<char>(0x80 | payload.size());
    } else {
      frame += static_cast<char>(0x80 | 126);
      frame += static_cast<char>(payload.size() >> 8U);
      frame += static_cast<char>(payload.size() & 0xFFU);
    }
    frame += std::string(4, '\0');  // a mask of zeros leaves the payload as it is
    send(frame + payload);
  }
  struct Frame {
    int opcode = -1;  ///< -1: nothing came
    std::string payload;
    [[nodiscard]] int close_code() const {
      return payload.size() < 2
                 ? 0
                 : (static_cast<unsigned char>(payload[0]) << 8) | static_cast<unsigned char>(payload[1]);
    }
  };
  Frame receive_frame(std::chrono::milliseconds patience = std::chrono::milliseconds{3000}) {
    const auto need = [&](std::size_t bytes) {
      while (buffer_.size() < bytes) {
        if (!receive(patience)) return false;
      }
      return true;
    };
    if (!need(2)) return {};
    const auto byte = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(buffer_[i])); };
    std::size_t length = byte(1) & 0x7FU;
    std::size_t head = 2;
    if (length >= 126) {
      const std::size_t width = length == 126 ? 2 : 8;
      if (!need(2 + width)) return {};
      length = 0;
      for (std::size_t i = 0; i < width; ++i) length = (length << 8U) | byte(2 + i);
      head += width;
    }
    if (!need(head + length)) return {};
    Frame frame{static_cast<int>(byte(0) & 0x0FU), buffer_.substr(head, length)};
    buffer_.erase(0, head + length);
    return frame;
  }

 private:
  int socket_;
  bool is_connected_ = false;
  std::string buffer_;
};

}  // namespace docent::telepresence
