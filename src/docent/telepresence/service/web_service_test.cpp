#include "docent/telepresence/service/web_service.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <mutex>
#include <thread>

#include "docent/messages/conversions.h"
#include "docent/telepresence/service/service_fixture.h"

namespace docent::telepresence {
namespace {

const std::string kId = "018f3a6c-5b2e-7c3d-9a4b-0123456789ab";
const std::string kOtherId = "018f3a6c-5b2e-7c3d-9a4b-ba9876543210";

museum::Museum small_museum() {
  museum::Museum museum;
  museum.languages = {"de", "en"};
  museum.exhibits.resize(1);
  museum.exhibits[0].id = "sputnik";
  museum.exhibits[0].viewpoints = {{1, 1, {}}, {2, 1, {}}};
  museum.tours = {{"space", {}, {"sputnik"}, std::nullopt}};
  return museum;
}

/// The service with a robot and viewers who write down what they hear; the test is the Web and the clock.
class WebServiceTest : public testing::Test {
 protected:
  WebServiceTest() { make(WebStore::open(":memory:").value(), {}); }
  void make(WebStore store, StoreQueue::Post post) {
    WebServiceParts parts;
    parts.store = std::move(store);
    database_ = parts.store.database.get();
    parts.post = std::move(post);
    parts.max_open_requests = most_.all;
    parts.kept_places = most_.kept;
    parts.max_open_of_address = most_.of_address;
    parts.forgets_after = std::chrono::hours{1};
    parts.note = [](const std::string&, const std::string&, const std::string&) {};
    parts.screen = {[](const AnswerMessage&, Time) { return Result<void>{}; },
                    [](const std::string&) { return "help"; }};
    parts.horn = {"00ff.wav", 0.5};
    parts.gateway = "one";
    parts.operated = [this](const documents::OperationMessage& operation) { operations_.push_back(operation); };
    service_ = std::make_unique<WebService>(std::move(parts), museum_, robot_, button_, viewers_, now_);
  }

  /// What the caller is answered; empty: nothing.
  std::string take(const ClientMessage& message, Role role = Role::visitor) {
    viewers_.answers.clear();
    service_->take({7, role, "ada"}, message, now_);
    if (viewers_.answers.empty()) return {};
    EXPECT_EQ(viewers_.answers.size(), 1U);
    EXPECT_EQ(viewers_.answers[0].first, 7U) << "and nobody else";
    return viewers_.answers[0].second;
  }
  static RequestMessage wish(const std::string& id = kId, const std::string& target = "sputnik") {
    return {id, RequestKind::exhibit, target, 1, "Lise", ""};
  }
  void say_phase(MissionPhase phase, const docent_msgs::Prompt& prompt = {}) {
    docent_msgs::MissionState mission;
    mission.phase = to_text(phase);
    mission.prompt = prompt;
    service_->see(mission);
  }
  void show_board(const std::string& id, RequestStatus status) {
    docent_msgs::RequestBoard board;
    board.requests.resize(1);
    board.requests[0].request.id = id;
    board.requests[0].state = to_text(status);
    service_->see(board, now_);
  }
  void look() { service_->look({"open", true}, 3, now_); }

  struct Most {
    std::size_t all = 2, kept = 0, of_address = 2;
  } most_;
  museum::Museum museum_ = small_museum();
  Time now_ = time_from_seconds(100.0);
  StopRegister button_{"web", {}, now_};
  RobotEar robot_;
  ViewerEyes viewers_;
  std::vector<documents::OperationMessage> operations_;
  Database* database_ = nullptr;
  std::unique_ptr<WebService> service_;
};

TEST_F(WebServiceTest, AWishIsStoredToldAcknowledgedAndToldAgain) {
  EXPECT_EQ(take(wish()), encode_acknowledgement(kId));
  ASSERT_EQ(robot_.requests.size(), 1U);
  const docent_msgs::Request& told = robot_.requests[0];
  EXPECT_EQ(told.id, kId);
  EXPECT_EQ(told.source, "web");
  EXPECT_EQ(told.visitor, "Lise");
  EXPECT_EQ(told.kind, "exhibit");
  EXPECT_EQ(told.target, "sputnik");
  EXPECT_EQ(told.viewpoint, 1);
  EXPECT_EQ(told.language, "de") << "the museum's own, where nobody said one";
  service_->resend(now_);
  EXPECT_EQ(robot_.requests.size(), 2U);
  show_board(kId, RequestStatus::queued);
  service_->resend(now_);
  EXPECT_EQ(robot_.requests.size(), 2U);
  EXPECT_EQ(viewers_.of(slots::kBoard).size(), 1U);
}

TEST_F(WebServiceTest, WhatTheMuseumDoesNotHaveIsRefusedInWords) {
  EXPECT_EQ(take(wish(kId, "mona-lisa")), encode_refusal(kId, {ReasonWord::no_such_exhibit, "mona-lisa"}));
  EXPECT_TRUE(robot_.requests.empty());
}

TEST_F(WebServiceTest, NoMoreWaitThanMay) {
  take(wish());
  take(wish(kOtherId));
  const std::string third = "018f3a6c-5b2e-7c3d-9a4b-111111111111";
  EXPECT_EQ(take(wish(third)), encode_refusal(third, ReasonWord::too_many_wait));
  show_board(kId, RequestStatus::fulfilled);
  EXPECT_EQ(take(wish(third)), encode_acknowledgement(third));
}

TEST_F(WebServiceTest, WhoeverFillsTheBoardFromTheWebLeavesRoomForTheHall) {
  most_ = {20, 5, 8};
  make(WebStore::open(":memory:").value(), {});
  int taken = 0;
  for (int i = 0; i < 100; ++i) {
    const std::string id = kId.substr(0, 33) + std::to_string(100 + i);
    viewers_.answers.clear();
    service_->take({7, Role::visitor, "", "", i % 2 == 0 ? "192.0.2.1" : "198.51.100." + std::to_string(i)}, wish(id),
                   now_);
    if (viewers_.answers.at(0).second == encode_acknowledgement(id)) ++taken;
  }
  EXPECT_EQ(taken, 15);
  for (int i = 0; i < 5; ++i) {
    const std::string id = kId.substr(0, 33) + std::to_string(300 + i);
    EXPECT_EQ(take(wish(id), Role::kiosk), encode_acknowledgement(id));
  }
  EXPECT_EQ(take(wish(kOtherId), Role::kiosk), encode_refusal(kOtherId, ReasonWord::too_many_wait));
}

TEST_F(WebServiceTest, OneAddressDoesNotTakeAllPlaces) {
  most_ = {20, 5, 3};
  make(WebStore::open(":memory:").value(), {});
  for (int i = 0; i < 5; ++i) {
    const std::string id = kId.substr(0, 33) + std::to_string(100 + i);
    viewers_.answers.clear();
    service_->take({7, Role::visitor, "", "", "2001:db8::" + std::to_string(i)}, wish(id), now_);
    EXPECT_EQ(viewers_.answers.at(0).second,
              i < 3 ? encode_acknowledgement(id) : encode_refusal(id, ReasonWord::too_many_wait));
  }
  viewers_.answers.clear();
  service_->take({7, Role::visitor, "", "", "2001:db8:0:1::1"}, wish(), now_);
  EXPECT_EQ(viewers_.answers.at(0).second, encode_acknowledgement(kId)) << "somebody else still gets in";
}

TEST_F(WebServiceTest, WhatCannotBeStoredIsRefused) {
  ASSERT_TRUE(database_->run("DROP TABLE outbox"));
  EXPECT_EQ(take(wish()), encode_refusal(kId, ReasonWord::not_stored));
  EXPECT_TRUE(robot_.requests.empty());
  EXPECT_FALSE(service_->fault().empty());
}

TEST_F(WebServiceTest, AWishCanBeTakenBack) {
  EXPECT_EQ(take(CancelMessage{kOtherId, kId}), encode_acknowledgement(kOtherId));
  ASSERT_EQ(robot_.requests.size(), 1U);
  EXPECT_EQ(robot_.requests[0].kind, "cancel");
  EXPECT_EQ(robot_.requests[0].target, kId);
}

TEST_F(WebServiceTest, TellsWhoAsks) {
  take(wish(), Role::kiosk);
  take(wish(kOtherId), Role::staff);
  ASSERT_EQ(robot_.requests.size(), 2U);
  EXPECT_EQ(robot_.requests[0].source, "kiosk");
  EXPECT_EQ(robot_.requests[1].source, "staff");
}

TEST_F(WebServiceTest, AQuestionIsAnsweredAndToldAgain) {
  const ChoiceMessage choice{kId, "p1", "more"};
  EXPECT_EQ(take(choice), encode_refusal(kId, ReasonWord::question_over));
  docent_msgs::Prompt prompt;
  prompt.id = "p1";
  prompt.options = {"more", "next"};
  say_phase(MissionPhase::asking, prompt);
  EXPECT_EQ(take(choice), encode_acknowledgement(kId));
  service_->resend(now_);
  ASSERT_EQ(robot_.choices.size(), 2U);
  say_phase(MissionPhase::driving);
  service_->resend(now_);
  EXPECT_EQ(robot_.choices.size(), 2U);
}

TEST_F(WebServiceTest, AVoteIsTakenToldCountedAndShown) {
  EXPECT_EQ(take(VoteMessage{kId, "018f3a6c-5b2e-7c3d-9a4b-222222222222", "space"}), encode_acknowledgement(kId));
  EXPECT_EQ(take(VoteMessage{kId, "018f3a6c-5b2e-7c3d-9a4b-222222222222", "nonsense"}),
            encode_refusal(kId, {ReasonWord::no_such_tour, "nonsense"}));
  look();
  look();
  ASSERT_EQ(robot_.votes.size(), 1U) << "nothing was new the second time";
  EXPECT_EQ(robot_.votes[0].counts, std::vector<std::uint32_t>{1});
  EXPECT_EQ(viewers_.of(slots::kVotes).size(), 1U);
  service_->store_counts({"open", true}, 5, now_);
  const auto days = Statistics::open(*database_).value()->days("").value();
  ASSERT_EQ(days.size(), 1U);
  EXPECT_EQ(days[0].counts.at(Counted::votes), 1.0);
  EXPECT_EQ(days[0].counts.at(Counted::accesses), 5.0);
}

TEST_F(WebServiceTest, TheScreenIsAnsweredWhereItAsked) {
  EXPECT_EQ(take(LampsMessage{{1, 3}}, Role::kiosk), "");
  EXPECT_EQ(robot_.lamps.back(), (std::vector<std::int32_t>{1, 3}));
  const HelpMessage help{kId, "de"};
  EXPECT_EQ(take(help, Role::kiosk), encode_refusal(kId, ReasonWord::busy)) << "nobody knows what the robot is about";
  say_phase(MissionPhase::idle);
  EXPECT_EQ(take(help, Role::kiosk), encode_acknowledgement(kId));
  ASSERT_EQ(robot_.says.size(), 1U);
  EXPECT_EQ(take(AnswerMessage{kOtherId, PollQuestion::liked, PollAnswer::yes, "de"}, Role::kiosk),
            encode_acknowledgement(kOtherId));
  now_ = now_ + seconds(15.0);
  look();
  EXPECT_TRUE(robot_.lamps.back().empty()) << "the screen says nothing any more";
}

TEST_F(WebServiceTest, AnOperatorStopsTheRobotAndAllOperatorsSeeIt) {
  service_->show_operation();
  service_->show_operation();
  EXPECT_EQ(viewers_.of(slots::kOperation).size(), 1U);
  EXPECT_EQ(take(StopMessage{kId, true}, Role::staff), "") << "the robot has not confirmed it";
  EXPECT_EQ(robot_.stops, 1);
  EXPECT_TRUE(button_.state().is_stopped);
  for (const char* keeper : {"avoid", "robot"}) button_.hear(keeper, {button_.state(), true}, now_);
  service_->confirm(now_);
  ASSERT_EQ(viewers_.answers.size(), 1U);
  EXPECT_EQ(viewers_.answers[0].second, encode_acknowledgement(kId));
  EXPECT_EQ(viewers_.of(slots::kOperation).size(), 2U) << "at once";
  ASSERT_EQ(operations_.size(), 3U);
  EXPECT_TRUE(operations_.back().is_stopped);
}

TEST_F(WebServiceTest, SteeringIsAnsweredOnlyWhereItIsRefused) {
  EXPECT_EQ(take(SteerMessage{true, 1.0, 0.0}, Role::staff), encode_error(ReasonWord::no_lease));
  EXPECT_EQ(take(LeaseMessage{kId, true}, Role::staff), encode_acknowledgement(kId));
  EXPECT_EQ(take(SteerMessage{true, 1.0, 0.0}, Role::staff), "");
  ASSERT_FALSE(robot_.steered.empty());
  EXPECT_TRUE(robot_.steered.back().is_pressed);
  service_->left({7, Role::staff, "ada"}, now_);
  EXPECT_FALSE(robot_.steered.back().is_pressed);
  EXPECT_EQ(take(SetHoursMessage{kOtherId, OperatingMode::closed}, Role::staff), encode_acknowledgement(kOtherId));
  ASSERT_EQ(robot_.limits.size(), 1U);
}

TEST_F(WebServiceTest, WhatStaysTheSameIsNotShownAgain) {
  docent_msgs::Expression expression;
  expression.mood = "happy";
  for (int i = 0; i < 3; ++i) service_->see(expression);
  EXPECT_EQ(viewers_.of(slots::kExpression).size(), 1U);
  expression.valence = 0.7;
  service_->see(expression);
  EXPECT_EQ(viewers_.of(slots::kExpression).size(), 2U);
  look();
  look();
  EXPECT_EQ(viewers_.of(slots::kHours), std::vector<std::string>{encode_hours("open", true)});
  service_->look({"closed", false}, 3, now_);
  EXPECT_EQ(viewers_.of(slots::kHours).size(), 2U);
  EXPECT_EQ(viewers_.of(slots::kHealth).size(), 3U) << "a viewer hears something every second";
}

TEST_F(WebServiceTest, AMutedRobotHasNoHorn) {
  service_->honk(now_);
  docent_msgs::SoundState sound;
  sound.volume = 0.0;
  service_->see(sound);
  service_->honk(now_);
  sound.volume = 0.4;
  service_->see(sound);
  service_->honk(now_);
  EXPECT_EQ(viewers_.of(slots::kHorn),
            (std::vector<std::string>{encode_horn(now_, "00ff.wav", 0.5), encode_horn(now_, "", 0.5),
                                      encode_horn(now_, "00ff.wav", 0.5)}));
  EXPECT_EQ(viewers_.of(slots::kSound).size(), 2U);
}

TEST_F(WebServiceTest, OnlyButtonsThatThereAreArePressed) {
  for (const int number : {0, 1, kButtons, kButtons + 1}) service_->press(number, now_);
  EXPECT_EQ(viewers_.of(slots::kButton),
            (std::vector<std::string>{encode_button(now_, 1), encode_button(now_, kButtons)}));
}

TEST_F(WebServiceTest, TheHealthOfAllIsShownAndCanBeFetched) {
  docent_msgs::Health health;
  health.module = "avoid";
  health.state = "ready";
  service_->see(health, now_);
  look();
  EXPECT_NE(service_->health_document().find("avoid"), std::string::npos);
  EXPECT_EQ(viewers_.of(slots::kHealth).back(), service_->health_document());
}

TEST_F(WebServiceTest, AnOperatorWaitsForNoDiskThatVisitorsWaitFor) {
  char name[] = "/tmp/docent-service-XXXXXX";
  const std::filesystem::path folder = ::mkdtemp(name);
  std::mutex mutex;
  std::vector<std::function<void()>> posted;
  make(WebStore::open((folder / "web.sqlite").string()).value(), [&](std::function<void()> work) {
    const std::scoped_lock lock{mutex};
    posted.push_back(std::move(work));
  });
  const auto other = Database::open((folder / "web.sqlite").string()).value();
  ASSERT_TRUE(other->run_script("BEGIN EXCLUSIVE")) << "the file is held";
  viewers_.answers.clear();
  service_->take({7, Role::visitor, ""}, wish(), now_);
  for (int i = 0; i < 300; ++i)
    service_->take({8, Role::visitor, ""}, VoteMessage{kId, std::to_string(i), "space"}, now_);
  EXPECT_TRUE(viewers_.answers.empty()) << "nothing is stored yet";
  service_->take({9, Role::staff, "ada"}, StopMessage{kOtherId, true, 0}, now_);
  EXPECT_EQ(robot_.stops, 1);
  service_->take({9, Role::staff, "ada"}, LeaseMessage{kOtherId, true}, now_);
  service_->take({9, Role::staff, "ada"}, SteerMessage{true, 0.3, 0.0}, now_);
  ASSERT_FALSE(robot_.steered.empty());
  EXPECT_TRUE(robot_.steered.back().is_pressed);
  EXPECT_TRUE(robot_.requests.empty());
  now_ = now_ + seconds(3.0);
  look();
  EXPECT_EQ(viewers_.answers.size(), 302U) << "who waits for too long is told: the lease, the wish, the votes";
  EXPECT_NE(service_->fault(), "");
  ASSERT_TRUE(other->run_script("ROLLBACK"));
  for (int i = 0; i < 5000 && robot_.requests.empty(); ++i) {
    service_->take({7, Role::visitor, ""}, wish(), now_);
    std::this_thread::sleep_for(std::chrono::milliseconds{1});
    const std::scoped_lock lock{mutex};
    for (const auto& work : std::exchange(posted, {})) work();
  }
  EXPECT_FALSE(robot_.requests.empty()) << "it works again";
  service_.reset();
  std::filesystem::remove_all(folder);
}

TEST_F(WebServiceTest, SaysWithinAMinuteThatItsStoreIsGoneAndMakesItAnew) {
  char name[] = "/tmp/docent-service-XXXXXX";
  const std::filesystem::path folder = std::filesystem::path{::mkdtemp(name)} / "state";
  std::filesystem::create_directory(folder);
  make(WebStore::open((folder / "web.sqlite").string()).value(), {});
  EXPECT_NE(take(wish()).find("ack"), std::string::npos);
  look();
  EXPECT_EQ(service_->fault(), "");
  std::filesystem::remove_all(folder);
  now_ = now_ + std::chrono::minutes{1};
  look();
  EXPECT_NE(service_->fault().find("the file is gone"), std::string::npos) << service_->fault();
  const auto other = WebStore::open((folder / "web.sqlite").string()).value();
  ASSERT_EQ(other.pending.size(), 1U) << "what was acknowledged is there";
  EXPECT_EQ(other.pending[0].id, kId);
  service_.reset();
  std::filesystem::remove_all(folder.parent_path());
}

TEST_F(WebServiceTest, OldWishesAreGivenUp) {
  take(wish());
  now_ = now_ + std::chrono::minutes{59};
  service_->forget_old(now_);
  robot_.requests.clear();
  service_->resend(now_);
  EXPECT_EQ(robot_.requests.size(), 1U);
  now_ = now_ + std::chrono::minutes{2};
  service_->forget_old(now_);
  robot_.requests.clear();
  service_->resend(now_);
  EXPECT_TRUE(robot_.requests.empty());
}

}  // namespace
}  // namespace docent::telepresence
