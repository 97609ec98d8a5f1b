#include "docent/task_control/mission_service/mission_service.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <limits>
#include <string>
#include <utility>

#include "docent/task_control/mission_service/museum_programme.h"
#include "docent/task_control/plan_controller/plan_controller.h"

namespace docent::task_control {
namespace {

museum::Museum two_exhibits() {
  museum::Museum museum;
  museum.languages = {"en", "de"};
  museum.exhibits.resize(2);
  museum.exhibits[0].id = "a";
  museum.exhibits[0].title = {{"en", "Clocks"}, {"de", "Uhren"}};
  museum.exhibits[0].pose = {5.0, 0.0, {}};
  museum.exhibits[1].id = "b";
  museum.exhibits[1].pose = {10.0, 0.0, {}};
  museum.tours = {{"both", {}, {"a", "b"}, std::nullopt}, {"back", {}, {"b", "a"}, std::nullopt}};
  return museum;
}

class FakeCompany final : public Company {
 public:
  [[nodiscard]] bool is_there() const override { return somebody; }
  [[nodiscard]] interaction::AttractionAction begin() override {
    is_under_way = true;
    return style;
  }
  void observe() override { ++observed; }
  [[nodiscard]] std::optional<interaction::AttractionTrial> finish() override {
    if (!std::exchange(is_under_way, false)) return std::nullopt;
    return interaction::AttractionTrial{{}, 0.1, style, {}, 0.5};
  }
  [[nodiscard]] const std::string& fault() const override { return what_is_wrong; }

  interaction::AttractionAction style{GazeStrategy::nearest, Mood::happy, SpeechAct::invite};
  bool somebody = false;
  bool is_under_way = false;
  int observed = 0;
  std::string what_is_wrong;
};

/// The mission with a museum of two exhibits; the test is everybody else.
class MissionServiceTest : public testing::Test {
 protected:
  MissionServiceTest()
      : folder_{std::filesystem::temp_directory_path() / ("docent_service_" + std::to_string(getpid()))} {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    start();
  }
  ~MissionServiceTest() override {
    service_.reset();
    std::filesystem::remove_all(folder_);
  }
  [[nodiscard]] std::filesystem::path file() const { return folder_ / "mission.sqlite"; }
  [[nodiscard]] Time now() const { return time_from_seconds(now_s_); }
  void start() {
    service_.reset();
    MissionStore store = MissionStore::open(file(), "dep", false).value();
    MissionMemory memory = store.load().value();
    auto mission = std::make_unique<Mission>(MissionParams{}, programme_of(museum_), straight_distance(),
                                             std::move(memory), std::make_unique<PlanController>(), now());
    service_ = std::make_unique<MissionService>(std::move(mission), std::move(store), museum_, company_,
                                                [](const std::string&) { return museum::Translations{}; });
    hear(service_->begin(now()));
  }
  /// Keeps what was told last.
  const MissionNews& hear(MissionNews news) {
    news_ = std::move(news);
    if (news_.board) board_ = news_.board;
    if (news_.task) task_ = *news_.task;
    if (news_.status) status_ = *news_.status;
    for (const Happening& happening : news_.happenings) happened_.push_back(happening.kind);
    return news_;
  }
  const MissionNews& wish(const std::string& id, const std::string& target, RequestKind kind = RequestKind::exhibit) {
    return hear(service_->request({id, now(), RequestSource::web, "Ada", kind, target, -1, "en"}, now()));
  }
  const MissionNews& report(TaskStatus state, const ShownQuestion& question = {}) {
    return hear(service_->report(task_.order.id, state, {}, question, false, now()));
  }
  void pass(double duration_s, Point2 place = {}) {
    for (const double end = now_s_ + duration_s; now_s_ < end; now_s_ += 0.5) {
      hear(service_->localization(true, place, now()));
      hear(service_->tick(now()));
    }
  }
  [[nodiscard]] std::optional<RequestStatus> state_of(const std::string& id) const {
    const BoardEntry* entry = board_ ? board_->find(id) : nullptr;
    return entry != nullptr ? std::optional{entry->status} : std::nullopt;
  }

  std::filesystem::path folder_;
  museum::Museum museum_ = two_exhibits();
  FakeCompany company_;
  double now_s_ = 100.0;
  std::unique_ptr<MissionService> service_;
  MissionNews news_;
  std::optional<RequestBoard> board_;
  MissionTask task_;
  MissionStatus status_;
  std::vector<EventKind> happened_;
};

TEST_F(MissionServiceTest, AtTheStartAllIsToldOnce) {
  EXPECT_TRUE(news_.board);
  EXPECT_TRUE(news_.task);
  ASSERT_TRUE(news_.status);
  EXPECT_EQ(news_.status->phase, MissionPhase::waking);
  EXPECT_EQ(news_.status->languages, (std::vector<std::string>{"en", "de"}));
  EXPECT_EQ(news_.status->texts.size(), 2U);
  pass(5.0);
  pass(0.5);
  EXPECT_FALSE(news_.board);
  EXPECT_FALSE(news_.task);
  EXPECT_FALSE(news_.status) << "nothing is new";
}

TEST_F(MissionServiceTest, NoTextOfARequestMayBeEndless) {
  using Change = void (*)(VisitorRequest&, const std::string&);
  const std::pair<const char*, Change> fields[] = {
      {"id", [](VisitorRequest& request, const std::string& text) { request.id = text; }},
      {"source", [](VisitorRequest& request, const std::string& text) { request.source = Word<RequestSource>{text}; }},
      {"visitor", [](VisitorRequest& request, const std::string& text) { request.visitor = text; }},
      {"kind", [](VisitorRequest& request, const std::string& text) { request.kind = Word<RequestKind>{text}; }},
      {"target", [](VisitorRequest& request, const std::string& text) { request.target = text; }},
      {"language", [](VisitorRequest& request, const std::string& text) { request.language = text; }}};
  for (const auto& [field, change] : fields) {
    for (const std::size_t size : {201U, 200U}) {
      VisitorRequest request{
          std::string{"of "} + field, now(), RequestSource::web, "Ada", RequestKind::exhibit, "a", -1, "en"};
      change(request, std::string(size, 'x'));
      const std::string id = request.id;
      hear(service_->request(std::move(request), now()));
      EXPECT_EQ(state_of(id).has_value(), size == 200U) << field << " of " << size << " bytes";
    }
  }
}

TEST_F(MissionServiceTest, AnyNumberMayComeAsAViewpoint) {
  const auto from = [&](const std::string& id, int viewpoint) {
    hear(service_->request({id, now(), RequestSource::web, "Ada", RequestKind::exhibit, "a", viewpoint, "en"}, now()));
    return board_->find(id);
  };
  const BoardEntry* beyond = from("beyond", std::numeric_limits<int>::max());
  ASSERT_NE(beyond, nullptr);
  EXPECT_EQ(beyond->status, RequestStatus::refused);
  const BoardEntry* below = from("below", std::numeric_limits<int>::min());
  ASSERT_NE(below, nullptr);
  EXPECT_NE(below->status, RequestStatus::refused);
  EXPECT_EQ(below->request.viewpoint, -1) << "from anywhere";
}

TEST_F(MissionServiceTest, AWishStandsOnTheBoardAndBecomesATask) {
  pass(5.0);
  wish("r1", "a");
  ASSERT_TRUE(news_.board);
  EXPECT_EQ(state_of("r1"), RequestStatus::active);
  ASSERT_TRUE(news_.task);
  EXPECT_EQ(news_.task->order.kind, TaskKind::visit);
  EXPECT_EQ(news_.task->order.exhibit_id, "a");
  EXPECT_FALSE(news_.task->style);
  ASSERT_TRUE(news_.status);
  EXPECT_EQ(status_.phase, MissionPhase::driving);
  EXPECT_NE(status_.texts[0].find("Clocks"), std::string::npos) << status_.texts[0];
  EXPECT_NE(status_.texts[1].find("Uhren"), std::string::npos) << status_.texts[1];
}

TEST_F(MissionServiceTest, AWishThatIsSaidAgainIsTheSameWish) {
  pass(5.0);
  wish("r1", "a");
  EXPECT_FALSE(wish("r1", "a").board);
  EXPECT_EQ(board_->entries().size(), 1U);
}

TEST_F(MissionServiceTest, WhatNobodyCouldMeanIsIgnored) {
  pass(5.0);
  wish("", "a");
  wish("r1", std::string(201, 'x'));
  wish(std::string(201, 'x'), "a");
  const Word<RequestSource> source{std::string(201, 'x')};
  hear(service_->request({"r2", now(), source, "", RequestKind::exhibit, "a", -1, "en"}, now()));
  pass(1.0);
  EXPECT_TRUE(board_->entries().empty());
  wish("r3", std::string(200, 'x'));
  EXPECT_EQ(state_of("r3"), RequestStatus::refused);
}

TEST_F(MissionServiceTest, AWishOfLongAgoIsShownAgainAndNotServedAgain) {
  pass(5.0);
  wish("old", "nonsense");
  ASSERT_EQ(state_of("old"), RequestStatus::refused);
  for (int i = 0; i < 120; ++i) wish("r" + std::to_string(i), "nonsense");
  ASSERT_EQ(state_of("old"), std::nullopt) << "the board keeps the newest hundred";
  wish("old", "a");
  EXPECT_EQ(state_of("old"), RequestStatus::refused);
}

TEST_F(MissionServiceTest, WhatCannotBeStoredIsToldToNobodyUntilItCan) {
  pass(5.0);
  {
    SQLite::Database other{file().string(), SQLite::OPEN_READWRITE};
    SQLite::Transaction lock{other, SQLite::TransactionBehavior::IMMEDIATE};
    wish("r1", "a");
    EXPECT_FALSE(news_.board);
    EXPECT_FALSE(news_.task);
    EXPECT_FALSE(news_.status);
    EXPECT_FALSE(service_->fault(now()).empty());
  }
  pass(0.5);
  EXPECT_EQ(state_of("r1"), RequestStatus::active);
  EXPECT_EQ(task_.order.exhibit_id, "a");
  EXPECT_EQ(service_->fault(now()), "");
}

TEST_F(MissionServiceTest, WhatWasToldOutlivesARestart) {
  pass(5.0);
  wish("r1", "a");
  const std::string task = task_.order.id;
  start();
  EXPECT_EQ(state_of("r1"), RequestStatus::active);
  EXPECT_EQ(task_.order.id, task);
}

TEST_F(MissionServiceTest, TheTourThatLeadsIsWishedFor) {
  pass(5.0);
  const auto votes = [this](std::vector<std::string> tours, std::vector<std::uint32_t> counts) {
    hear(service_->votes({"round", std::move(tours), std::move(counts)}, now()));
    pass(200.0);  // nobody else wants anything
  };
  votes({"both", "back"}, {0, 0});
  EXPECT_EQ(state_of("round"), std::nullopt);
  votes({"nonsense", "both", "back", "more"}, {9, 2, 2});  // and a count is missing
  ASSERT_TRUE(state_of("round"));
  EXPECT_EQ(board_->find("round")->request.target, "both") << "the first of two with as many";
  EXPECT_EQ(board_->find("round")->request.source, RequestSource::vote);
}

TEST_F(MissionServiceTest, ARoundWithAnEndlessNameIsIgnored) {
  pass(5.0);
  hear(service_->votes({std::string(201, 'x'), {"both"}, {2}}, now()));
  pass(200.0);
  EXPECT_TRUE(board_->entries().empty());
}

TEST_F(MissionServiceTest, AQuestionIsShownWhileItsTaskAsksIt) {
  pass(5.0);
  wish("r1", "a");
  const ShownQuestion question{"q1", "en", {"en"}, {"More?"}, {"more", "next"}, "next", now()};
  hear(service_->report("another task", TaskStatus::asking, {}, question, false, now()));
  EXPECT_EQ(status_.question.id, "");
  report(TaskStatus::explaining, question);
  EXPECT_EQ(status_.question.id, "") << "not before it asks";
  report(TaskStatus::asking, question);
  EXPECT_EQ(status_.phase, MissionPhase::asking);
  EXPECT_EQ(status_.question, question);
  report(TaskStatus::done, question);
  EXPECT_EQ(state_of("r1"), RequestStatus::fulfilled);
  EXPECT_EQ(status_.question, ShownQuestion{});
  EXPECT_EQ(status_.requests_served, 1U);
  EXPECT_EQ(status_.exhibits_explained, 1U);
}

TEST_F(MissionServiceTest, MinglingHasAStyleAndItsWorthIsToldWhenItIsOver) {
  pass(5.0);
  report(TaskStatus::done);  // it is at home
  company_.somebody = true;
  pass(60.0);
  ASSERT_EQ(task_.order.kind, TaskKind::mingle);
  EXPECT_EQ(task_.style, company_.style);
  EXPECT_GT(company_.observed, 100);
  EXPECT_FALSE(news_.trial);
  wish("r1", "a");
  ASSERT_TRUE(news_.trial) << "a wish ends it";
  EXPECT_EQ(news_.trial->reward, 0.5);
  ASSERT_TRUE(news_.task);
  EXPECT_EQ(news_.task->order.kind, TaskKind::visit);
  EXPECT_FALSE(news_.task->style);
}

TEST_F(MissionServiceTest, TellsOfItsPlaceAtOnceWhenThatChanges) {
  pass(5.0);
  pass(5.0, {0.1, 0.0});
  const MissionNews same = service_->localization(true, {0.2, 0.0}, now());
  EXPECT_FALSE(same.status);
  wish("r1", "a");
  hear(service_->localization(false, {}, now()));
  now_s_ += 4.0;
  hear(service_->tick(now()));
  EXPECT_EQ(status_.phase, MissionPhase::relocalizing);
}

TEST_F(MissionServiceTest, SaysWhatIsWrong) {
  EXPECT_EQ(service_->fault(now()), "");
  service_->battery(0.8, false, now());
  now_s_ += 3600.0;
  EXPECT_EQ(service_->fault(now()), "the battery says nothing");
  company_.what_is_wrong = "attraction.json is damaged";
  EXPECT_EQ(service_->fault(now()), "attraction.json is damaged") << "that comes first";
}

TEST_F(MissionServiceTest, ADamagedDatabaseIsSetAsideAndSaid) {
  service_.reset();
  std::filesystem::remove_all(folder_);
  std::filesystem::create_directories(folder_);
  std::FILE* damaged = std::fopen(file().c_str(), "w");
  ASSERT_NE(damaged, nullptr);
  std::fputs("this is no database, whatever its name says; it is long enough to be read as one", damaged);
  std::fclose(damaged);
  start();
  EXPECT_NE(service_->fault(now()).find("set aside"), std::string::npos) << service_->fault(now());
}

}  // namespace
}  // namespace docent::task_control
