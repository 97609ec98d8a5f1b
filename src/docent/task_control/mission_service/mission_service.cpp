#include "docent/task_control/mission_service/mission_service.h"

#include <algorithm>
#include <utility>

#include "docent/task_control/mission_service/status_text.h"

namespace docent::task_control {
namespace {

constexpr std::size_t kLongestField = 200;  // [bytes] of any text of a request: it comes from anybody

bool is_sound(const VisitorRequest& request) {
  const std::string source = request.source.text();
  const std::string kind = request.kind.text();
  for (const std::string* text : {&request.id, &source, &request.visitor, &kind, &request.target, &request.language}) {
    if (text->size() > kLongestField) return false;
  }
  return !request.id.empty();
}

}  // namespace

MissionService::MissionService(std::unique_ptr<Mission> mission, MissionStore store, const museum::Museum& museum,
                               Company& company, RoomName name_of_room)
    : mission_{std::move(mission)},
      store_{std::move(store)},
      museum_{museum},
      company_{company},
      name_of_room_{std::move(name_of_room)} {}

MissionNews MissionService::request(VisitorRequest request, Time now) {
  if (!is_sound(request)) return {};
  if (mission_->scheduler().state().board.find(request.id) == nullptr) {
    const auto old = store_.find(request.id);
    if (!old) {  // unknown whether it is new: the client will ask again
      store_fault_ = old.error().message;
      return {};
    }
    if (*old) {
      mission_->show_again(**old);
      return flush(now);
    }
  }
  mission_->submit(std::move(request), now);
  return flush(now);
}

MissionNews MissionService::votes(const VoteCounts& votes, Time now) {
  std::size_t best = 0;
  std::uint32_t most = 0;
  for (std::size_t i = 0; i < std::min(votes.tours.size(), votes.counts.size()); ++i) {
    if (votes.counts[i] <= most || museum_.find_tour(votes.tours[i]) == nullptr) continue;
    most = votes.counts[i];
    best = i;
  }
  if (votes.round.size() > kLongestField) return {};
  mission_->votes(votes.round, most > 0 ? votes.tours[best] : "", now);
  return flush(now);
}

MissionNews MissionService::report(const std::string& task_id, std::optional<TaskStatus> state, const Reason& reason,
                                   const ShownQuestion& question, bool took_long, Time now) {
  if (task_id == mission_->task().id) question_ = question;
  mission_->report(task_id, state, reason, now, took_long);
  return flush(now);
}

MissionNews MissionService::localization(bool is_localized, Point2 position, Time now) {
  mission_->localization(is_localized, position, now);
  return std::exchange(is_localized_, is_localized) == is_localized ? MissionNews{} : flush(now);
}

MissionNews MissionService::tick(Time now) {
  mission_->company(company_.is_there());
  company_.observe();
  mission_->tick(now);
  return flush(now);
}

MissionNews MissionService::flush(Time now) {
  const MissionMemory memory = mission_->memory();
  if (auto saved = store_.save(memory); !saved) {
    store_fault_ = saved.error().message;
    return {};
  }
  store_fault_.clear();
  mission_->mark_stored();
  MissionNews news;
  news.happenings = mission_->take_happenings();
  const std::uint64_t revision = memory.schedule.board.revision();
  if (std::exchange(told_revision_, revision) != revision) news.board = memory.schedule.board;
  if (std::exchange(told_task_, memory.task.id) != memory.task.id) {
    news.trial =
        company_.finish();  // it counts as what it was worth until now, also where a visitor ended it by a wish
    news.task = begin_task(memory.task);
  }
  MissionStatus seen = status(now);
  if (told_status_ != seen) news.status = seen;
  told_status_ = std::move(seen);
  return news;
}

MissionTask MissionService::begin_task(const TaskOrder& order) {
  question_ = {};
  if (order.kind == TaskKind::mingle) return {order, company_.begin()};
  return {order, std::nullopt};
}

bool MissionService::may_speak(Time now) const {
  const MissionPhase phase = mission_->summary(now).phase;
  return phase == MissionPhase::idle || phase == MissionPhase::waiting || phase == MissionPhase::going_home;
}

MissionStatus MissionService::status(Time now) {
  const MissionSummary summary = mission_->summary(now);
  const museum::Exhibit* exhibit = museum_.find_exhibit(summary.exhibit_id);
  const museum::Translations title = is_about_room(summary) ? name_of_room_(summary.place)
                                     : exhibit != nullptr   ? exhibit->title
                                                            : museum::Translations{};
  MissionStatus status;
  status.phase = summary.phase;
  status.tour_id = summary.tour_id;
  status.exhibit_id = summary.exhibit_id;
  if (summary.phase == MissionPhase::asking) status.question = question_;
  status.exhibits_explained = summary.counters.exhibits_explained;
  status.tours_completed = summary.counters.tours_completed;
  status.requests_served = summary.counters.requests_served;
  status.agenda = summary.agenda;
  status.languages = mission_->scheduler().programme().languages;
  for (const std::string& language : status.languages) {
    const std::string tour = daily_tour_ ? name_and_time(museum_, *daily_tour_, language) : std::string{};
    status.texts.push_back(status_text(summary, title, tour, language));
  }
  return status;
}

std::string MissionService::fault(Time now) const {
  if (!store_fault_.empty()) return store_fault_;
  if (std::string fault = mission_->planner_fault(); !fault.empty()) return fault;
  if (!company_.fault().empty()) return company_.fault();
  if (std::string call = mission_->staff_call(now); !call.empty()) return call;
  if (mission_->is_battery_silent(now)) return "the battery says nothing";
  if (!store_.set_aside().empty()) return "a damaged database was set aside: " + store_.set_aside();
  return {};
}

}  // namespace docent::task_control
