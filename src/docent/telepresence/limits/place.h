#pragma once

#include <map>
#include <string>
#include <utility>

namespace docent::telepresence {

/// That a connection is counted among those of its network, as long as this lives. One thread.
class Place {
 public:
  /// @param all  how many there are, by their network; outlives it
  Place(std::map<std::string, int>& all, std::string network) : all_{all}, network_{std::move(network)} {
    ++all_[network_];
  }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;
  ~Place() {
    if (--all_[network_] == 0) all_.erase(network_);
  }
  /// With this one.
  [[nodiscard]] int taken() const { return all_.at(network_); }

 private:
  std::map<std::string, int>& all_;
  const std::string network_;
};

}  // namespace docent::telepresence
