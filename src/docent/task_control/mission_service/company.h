#pragma once

#include <optional>
#include <string>

#include "docent/interaction/attract/style.h"
#include "docent/interaction/attract/trial_memory.h"

namespace docent::task_control {

/// The people whom the robot attracts between two tours.
class Company {
 public:
  Company() = default;
  Company(const Company&) = delete;
  Company& operator=(const Company&) = delete;
  virtual ~Company() = default;

  /// Somebody is near.
  [[nodiscard]] virtual bool is_there() const = 0;
  /// A phase begins, in this style.
  [[nodiscard]] virtual interaction::AttractionAction begin() = 0;
  /// Twice a second.
  virtual void observe() = 0;
  /// The phase is over, or a visitor has ended it by a wish. nullopt: it taught nothing, or there was none.
  [[nodiscard]] virtual std::optional<interaction::AttractionTrial> finish() = 0;
  /// What is wrong with its memory; empty: nothing.
  [[nodiscard]] virtual const std::string& fault() const = 0;
};

}  // namespace docent::task_control
