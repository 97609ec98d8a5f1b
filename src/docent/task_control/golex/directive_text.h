#pragma once

#include <string>

#include "docent/task_control/golex/decomposition.h"
#include "docent/task_control/golex/executive_task.h"

namespace docent::task_control {

/// What a directive says, in the task's language; empty: there is nothing to say. Of several ways to say a sentence the
/// task's id chooses one, so that a line that is sent again has the same words.
/// @param mood  of the item
[[nodiscard]] std::string text_of(const Directive& directive, const ExecutiveTask& task, Mood mood);

/// Which of several ways to say it; >= 0.
[[nodiscard]] int variant_of(const Directive& directive, const ExecutiveTask& task);

/// What it says to people who stand in its way, when it has asked `count` times, 1 or more: to let it through. Who
/// leads a tour asks every other time to stay behind it, for then it is often the visitors who stand there.
[[nodiscard]] std::string words_for_way(const ExecutiveTask& task, Mood mood, int count);

}  // namespace docent::task_control
