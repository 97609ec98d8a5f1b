#pragma once

#include <mutex>
#include <string>
#include <utility>

#include "docent/telepresence/service/viewers.h"
#include "docent/telepresence/views/health_view.h"

namespace docent::modules {

/// For the `web` module: viewers are those of the server, once there is one.
class ServerLink final : public telepresence::Viewers {
 public:
  /// @pre lives as long as anybody calls this
  void set_server(telepresence::WebServer& server) {
    const std::scoped_lock lock{mutex_};
    server_ = &server;
  }
  void show(telepresence::slots::Slot slot, std::string text) override {
    if (auto* server = this->server()) server->broadcast(slot, std::move(text));
  }
  void answer(telepresence::ViewerId viewer, std::string text) override {
    if (auto* server = this->server()) server->send(viewer, std::move(text));
  }
  /// Any thread. Empty: there is no server yet.
  [[nodiscard]] std::string metrics() const {
    const auto* server = this->server();
    return server != nullptr ? telepresence::metrics_text(server->figures()) : std::string{};
  }

 private:
  [[nodiscard]] telepresence::WebServer* server() const {
    const std::scoped_lock lock{mutex_};
    return server_;
  }

  mutable std::mutex mutex_;  ///< the server's thread asks for metrics as soon as it runs
  telepresence::WebServer* server_ = nullptr;
};

}  // namespace docent::modules
