#pragma once

#include <string>

#include "docent/telepresence/server/web_server.h"
#include "docent/telepresence/views/slots.h"

namespace docent::telepresence {

/// Those who watch.
class Viewers {
 public:
  Viewers() = default;
  Viewers(const Viewers&) = delete;
  Viewers& operator=(const Viewers&) = delete;
  virtual ~Viewers() = default;

  /// The new value of a slot, for all of them.
  virtual void show(slots::Slot slot, std::string text) = 0;
  /// For one of them alone.
  virtual void answer(ViewerId viewer, std::string text) = 0;
};

}  // namespace docent::telepresence
