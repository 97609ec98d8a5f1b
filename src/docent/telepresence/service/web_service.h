#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "docent/geometry/pose2.h"
#include "docent/messages/docent_messages.h"
#include "docent/museum/museum.h"
#include "docent/telepresence/counting/count_desk.h"
#include "docent/telepresence/documents.h"
#include "docent/telepresence/service/answer_desk.h"
#include "docent/telepresence/service/backup_keeper.h"
#include "docent/telepresence/service/operator_desk.h"
#include "docent/telepresence/service/screen_desk.h"
#include "docent/telepresence/service/viewers.h"
#include "docent/telepresence/service/vote_desk.h"
#include "docent/telepresence/service/web_store.h"
#include "docent/telepresence/service/wish_desk.h"
#include "docent/telepresence/store/store_queue.h"
#include "docent/telepresence/views/health_view.h"

namespace docent::telepresence {

/// Whose hours these are.
struct PresentHours {
  std::string mode;  ///< open, web, closed
  bool is_open = true;
  std::string next_mode{};  ///< comes next by itself; empty: none does
  std::string next_at{};    ///< "HH:MM" by the museum's clock
};

/// The horn's sound, as pages fetch it.
struct HornSound {
  std::string file;
  double duration_s = 0.0;
};

/// What a Web service is made with.
struct WebServiceParts {
  WebStore store;
  StoreQueue::Post post;  ///< see StoreQueue; empty: what is stored is stored at once
  StoreQueueParams queue;
  bool is_shared = false;             ///< other gateways write into the same database
  std::size_t max_open_requests{};    ///< of everybody together; more are refused
  std::size_t kept_places{};          ///< of these, for the hall's screen and buttons and for staff
  std::size_t max_open_of_address{};  ///< of whoever comes from one address over the Web
  Duration forgets_after{};           ///< then a request is given up
  OperatorDesk::Note note;
  ScreenDesk::Means screen;
  HornSound horn;
  std::optional<StoreBackups> backups;  ///< made daily; nullopt: none
  std::string gateway;                  ///< a name of its own
  std::uint64_t seed = 0;
  /// Told what operators order, whenever that is shown.
  std::function<void(const documents::OperationMessage&)> operated;
};

/// All that people on the Web may ask for, and what they are shown of what became of it. Each message of theirs goes to
/// the desk that it is for, and they are answered; what the robot says of itself is shown, what has changed only.
/// Whatever waits for a disk waits on a thread of its own, and nothing of operators does. One thread, but for
/// `health_document`.
class WebService {
 public:
  /// Museum, robot, button and viewers outlive it. @param button  this process's copy of the stop button
  WebService(WebServiceParts parts, const museum::Museum& museum, RobotLink& robot, StopRegister& button,
             Viewers& viewers, Time now);
  WebService(const WebService&) = delete;
  WebService& operator=(const WebService&) = delete;
  ~WebService() { queue_.finish(); }  ///< the desks are there until what waits is stored

  // From the Web:

  void take(const Caller& caller, const ClientMessage& message, Time now);
  /// Somebody opened the live channel.
  void arrived(const std::string& address) { counts_.arrived(address); }
  void left(const Caller& caller, Time now) { operator_.left(caller, now); }

  // From the robot:

  void see(const docent_msgs::MissionState& mission);
  void see(const docent_msgs::SpeechState& speech) { viewers_.show(slots::kSpeech, encode_speech(speech)); }
  void see(const docent_msgs::SoundState& sound);
  void see(const docent_msgs::Expression& expression);
  void see(const docent_msgs::RequestBoard& board, Time now);
  void see(const docent_msgs::Limits& limits) { operator_.see(limits); }
  void see(const nav_msgs::Odometry& odometry) { counts_.see(odometry); }
  void see(const docent_msgs::Event& event) { counts_.see(event); }
  void see(const docent_msgs::Tactile& ring) { counts_.see(ring); }
  void see(const docent_msgs::Health& health, Time now) { health_.see(health, now); }
  /// The horn sounds.
  void honk(Time now);
  /// A button beside the screen was pressed.
  void press(int number, Time now);

  // From the clock:

  /// Every second. @param viewers  how many watch
  void look(const PresentHours& hours, std::size_t viewers, Time now);
  /// Every second: the newest people, and where the robot is.
  void see_people(const docent_msgs::People& people, std::optional<Pose2> map_from_base) {
    counts_.see_people(people, map_from_base);
  }
  /// Now and then: tells the robot again what it has not answered.
  void resend(Time now);
  /// Ten times a second.
  void steer_on(Time now);
  /// A copy of the stop button has been heard of: answers those whose order enough copies hold.
  void confirm(Time now) { answer_operators(now); }
  /// A few times a second: what operators order.
  void show_operation();
  /// Every ten seconds. @param accesses  all that the server was ever asked
  void store_counts(const PresentHours& hours, std::uint64_t accesses, Time now);
  /// Every few minutes.
  void forget_old(Time now);

  /// Any thread: the health of all modules, as it was shown last.
  [[nodiscard]] std::string health_document() const { return health_.document(); }
  /// What could not be stored; empty: all could.
  [[nodiscard]] std::string fault() const;

 private:
  /// Slots that are shown again only when they have changed.
  enum class Kept { expression, hours, operation, count };
  void show_if_new(Kept kept, slots::Slot slot, std::string text);
  void look_at_store(Time now);
  void answer(ViewerId viewer, const std::string& id, const Reason& why_not);
  void answer_operators(Time now);
  /// Answers that viewer, once it is clear what became of it.
  [[nodiscard]] std::function<void(const Reason&)> answer_for(ViewerId viewer, std::string id);
  [[nodiscard]] bool may_wait(const Caller& caller) const;
  void take_request(const Caller& caller, const RequestMessage& message, Time now);
  void take_cancel(const Caller& caller, const CancelMessage& message, Time now);
  void take_vote(const Caller& caller, const VoteMessage& message, Time now);

  const museum::Museum& museum_;
  Viewers& viewers_;
  std::unique_ptr<Database> database_;
  StoreQueue queue_;
  const std::size_t max_open_requests_, kept_places_, max_open_of_address_;
  const Duration forgets_after_;
  const HornSound horn_;
  const std::function<void(const documents::OperationMessage&)> operated_;
  WishDesk wishes_;
  AnswerDesk answers_;
  ScreenDesk screen_;
  VoteDesk votes_;
  OperatorDesk operator_;
  CountDesk counts_;
  HealthView health_;
  std::optional<MissionPhase> phase_;  ///< of the mission, as last heard
  bool is_muted_ = false;
  BackupKeeper backups_;
  std::optional<Time> looked_at_store_;
  std::string store_fault_;  ///< of its files, as last seen
  std::array<std::string, static_cast<std::size_t>(Kept::count)> shown_;
};

}  // namespace docent::telepresence
