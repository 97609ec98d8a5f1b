#pragma once

#include "docent/telepresence/server/web_server.h"
#include "docent/telepresence/views/inside_view.h"
#include "docent/transport/bus.h"

namespace docent::modules {

/// For the `web` module: connects what specialists look at to bus and server.
class InsideDesk {
 public:
  /// The bus outlives it.
  explicit InsideDesk(transport::Bus& bus) : bus_{bus} {}

  /// From now on viewers who look inside are shown. @pre lives as long as this
  void begin(telepresence::WebServer& server);

 private:
  transport::Bus& bus_;
  telepresence::InsideView view_;
};

}  // namespace docent::modules
