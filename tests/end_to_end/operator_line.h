#pragma once

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "docent/telepresence/server/test_client.h"

namespace docent {

/// An operator with a browser at one gateway, as the page /operate is: logs in, opens the line, and opens it again
/// whenever it is gone.
class OperatorLine {
 public:
  using Seconds = std::chrono::duration<double>;
  static constexpr const char* kName = "ada";
  static constexpr const char* kPassword = "a long way from Bonn";

  explicit OperatorLine(int port) : port_{port} {}

  /// The line is open, after a login where one is due.
  [[nodiscard]] bool opens(Seconds patience);
  struct Answer {
    bool is_acknowledged = false;
    std::string why_not;  ///< of a refusal, or that none came
    double after_s = 0.0;
  };
  [[nodiscard]] Answer press();
  /// Of the stop that the line shows.
  [[nodiscard]] Answer release();
  /// What operators are shown now: `stopped`, `stop_number`, `hours` …; null: nothing yet.
  [[nodiscard]] nlohmann::json operation();
  /// Whose hours the gateway says that these are, as every viewer sees it; empty: it does not answer.
  [[nodiscard]] std::string hours() const;

 private:
  [[nodiscard]] bool open_once();
  [[nodiscard]] bool log_in();
  [[nodiscard]] Answer ask(nlohmann::json message);
  /// What has come: keeps the newest operation. @returns an answer of that id
  std::optional<nlohmann::json> hear(const std::string& id, std::chrono::milliseconds patience);

  int port_;
  std::string cookie_;
  std::unique_ptr<telepresence::TestClient> line_;
  nlohmann::json operation_;
};

}  // namespace docent
