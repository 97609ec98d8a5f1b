#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "docent/base/result.h"
#include "docent/telepresence/api/exchange/exchange.h"
#include "docent/telepresence/uplink/envelope/picture_pieces.h"

namespace docent::telepresence {

/// What the far gateway does with what comes. All of it is called on the client's thread.
struct UplinkHooks {
  std::function<void(std::size_t slot, std::string text)> slot;
  std::function<void(std::uint64_t viewer, std::string text)> answer;
  std::function<void(JoinedPicture picture)> picture;
  std::function<void(bool is_open)> line = {};  ///< it was opened, or is lost; see `fault`
};

/// The far end of the encrypted line to the museum, on a thread of its own: opens it again whenever it is lost. It is
/// also the desk of the far gateway: calls to /api/v1 are answered by the museum, of which operators must be nearer.
class UplinkClient final : public ApiDesk {
 public:
  /// @param host, port  of the museum's web.uplink_port  @param key  of its file uplink.key
  UplinkClient(std::string host, std::string port, std::string key, UplinkHooks hooks);
  UplinkClient(const UplinkClient&) = delete;
  UplinkClient& operator=(const UplinkClient&) = delete;
  ~UplinkClient() override;

  /// Why there is no line, of the last attempt. Any thread.
  [[nodiscard]] std::string fault() const;
  /// What does not change while the museum's robot runs, by its path. Waits. Error: it could not be had.
  [[nodiscard]] Result<std::string> fetch(const std::string& path);
  /// Any thread. False: the line is down, too much waits, or it is too long for the other end.
  bool say(const ToMuseum& message);
  void take(ApiRequest request, std::function<void(ApiReply)> answer) override;
  void admit(std::string token, std::function<void(Admitted)> answer) override;
  void close() override;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace docent::telepresence
