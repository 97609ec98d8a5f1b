#include "docent/simulator/visitors.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "docent/messages/conversions.h"
#include "docent/vocabulary/uuid.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::simulator {
namespace {

constexpr std::array<const char*, 24> kNames{"Anna", "Ben",   "Clara", "David", "Emma", "Felix", "Greta", "Henri",
                                             "Ida",  "Jonas", "Karla", "Leon",  "Mia",  "Noah",  "Olga",  "Paul",
                                             "Rosa", "Samir", "Tara",  "Uwe",   "Vera", "Wim",   "Yara",  "Zoe"};

}  // namespace

WishingVisitors::WishingVisitors(const WishParams& params, std::vector<std::string> exhibits,
                                 std::vector<std::string> tours, Rng rng)
    : params_{params},
      exhibits_{std::move(exhibits)},
      tours_{std::move(tours)},
      wish_rng_{rng.stream("wishes")},
      answer_rng_{rng.stream("answers")},
      id_rng_{rng.stream("ids")} {
  next_wish_ = next_gap();
}

double WishingVisitors::next_gap() {
  if (!(params_.requests_per_hour > 0.0) || (exhibits_.empty() && tours_.empty())) return 1e18;
  const double mean = 3600.0 / params_.requests_per_hour;
  // An exponential cut off at 1.8 means; the factor 1.365 keeps the mean of the cut one.
  return std::min(wish_rng_.exponential(1.365 * mean), 1.8 * mean);
}

std::string WishingVisitors::new_id(Time now) { return make_uuid_v7(now, id_rng_); }

docent_msgs::Request& WishingVisitors::ask(Time now, const std::string& kind, const std::string& target,
                                           const std::string& language) {
  docent_msgs::Request request;
  request.id = new_id(now);
  request.stamp = to_message(now);
  request.source = params_.source;
  request.visitor =
      kNames[static_cast<std::size_t>(wish_rng_.integer(0, static_cast<std::int64_t>(kNames.size()) - 1))];
  request.kind = kind;
  request.target = target;
  request.language = language;
  return open_.emplace_back(Open{std::move(request), now, false}).request;
}

std::string WishingVisitors::language() {
  const std::size_t count = params_.languages.size();
  const auto pick = static_cast<std::size_t>(wish_rng_.uniform() * static_cast<double>(count));
  return params_.languages.at(std::min(pick, count - 1));
}

void WishingVisitors::ask(Time now, const Wish& wish) {
  docent_msgs::Request& request = ask(now, wish.kind, wish.target, wish.language);
  request.viewpoint = wish.viewpoint;
  if (!wish.source.empty()) request.source = wish.source;
}

void WishingVisitors::answer_with(double more, double next) {
  params_.answers_more = more;
  params_.answers_next = next;
}

WishingVisitors::Output WishingVisitors::step(Time now, Duration since_start) {
  Output output;
  while (to_seconds(since_start) >= next_wish_) {
    next_wish_ += next_gap();
    const bool wants_exhibit = tours_.empty() || (!exhibits_.empty() && wish_rng_.chance(params_.exhibit_share));
    const auto& list = wants_exhibit ? exhibits_ : tours_;
    const auto pick = static_cast<std::size_t>(wish_rng_.integer(0, static_cast<std::int64_t>(list.size()) - 1));
    ask(now, to_text(wants_exhibit ? RequestKind::exhibit : RequestKind::tour), list[pick], language());
  }
  for (Open& open : open_) {
    if (now < open.next_send) continue;
    if (!open.was_sent) output.offered.push_back(open.request.id);
    open.was_sent = true;
    open.next_send = now + seconds(params_.resend_period);
    output.requests.push_back(open.request);
  }
  for (const Answer& answer : answers_) {
    if (now >= answer.at) output.choices.push_back(answer.choice);
  }
  std::erase_if(answers_, [&](const Answer& answer) { return now >= answer.at; });
  return output;
}

void WishingVisitors::see_board(const docent_msgs::RequestBoard& board) {
  std::erase_if(open_, [&](const Open& open) {
    return std::any_of(board.requests.begin(), board.requests.end(),
                       [&](const docent_msgs::RequestState& state) { return state.request.id == open.request.id; });
  });
}

void WishingVisitors::see_mission(Time now, const docent_msgs::MissionState& mission) {
  const docent_msgs::Prompt& prompt = mission.prompt;
  if (prompt.id.empty() || prompt.options.empty() || !seen_prompts_.insert(prompt.id).second) return;
  if (seen_prompts_.size() > 1000) seen_prompts_ = {prompt.id};
  const double luck = answer_rng_.uniform();
  const double delay = answer_rng_.uniform(1.0, 4.0);
  const auto option = [&](docent::Answer a, docent::Answer b) -> std::string {
    for (const std::string& name : prompt.options) {
      if (const auto known = parse<docent::Answer>(name); known == a || known == b) return name;
    }
    return {};
  };
  std::string answer;
  if (luck < params_.answers_more)
    answer = option(docent::Answer::more, docent::Answer::yes);
  else if (luck < params_.answers_more + params_.answers_next)
    answer = option(docent::Answer::next, docent::Answer::no);
  if (answer.empty()) return;
  docent_msgs::Choice choice;
  choice.id = new_id(now);
  choice.prompt_id = prompt.id;
  choice.choice = answer;
  choice.source = params_.source;
  answers_.push_back({now + seconds(delay), std::move(choice)});
}

}  // namespace docent::simulator
