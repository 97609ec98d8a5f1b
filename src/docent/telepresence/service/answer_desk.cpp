#include "docent/telepresence/service/answer_desk.h"

#include <algorithm>

namespace docent::telepresence {

Reason AnswerDesk::take(const ChoiceMessage& message, RequestSource source) {
  if (!prompt_ || prompt_->id != message.prompt) return ReasonWord::question_over;
  const auto& options = prompt_->options;
  if (std::find(options.begin(), options.end(), message.choice) == options.end()) return ReasonWord::no_such_answer;
  if (choice_ && choice_->prompt_id == message.prompt) return {};
  choice_ = docent_msgs::Choice{message.id, message.prompt, message.choice, to_text(source)};
  robot_.tell(*choice_);
  return {};
}

void AnswerDesk::resend() {
  if (choice_ && (!prompt_ || choice_->prompt_id != prompt_->id)) choice_.reset();
  if (choice_) robot_.tell(*choice_);
}

}  // namespace docent::telepresence
