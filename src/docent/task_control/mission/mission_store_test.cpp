#include "docent/task_control/mission/mission_store.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "docent/base/files.h"

namespace docent::task_control {
namespace {

class MissionStoreTest : public testing::Test {
 protected:
  MissionStoreTest() : folder_{std::filesystem::temp_directory_path() / ("docent_store_" + std::to_string(getpid()))} {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~MissionStoreTest() override { std::filesystem::remove_all(folder_); }
  [[nodiscard]] std::filesystem::path path() const { return folder_ / "mission.sqlite"; }
  [[nodiscard]] MissionStore open(const std::string& name = "abc") const {
    auto store = MissionStore::open(path(), name, false);
    EXPECT_TRUE(store) << (store ? "" : store.error().message);
    return std::move(*store);
  }

  std::filesystem::path folder_;
};

VisitorRequest request(const std::string& id) {
  return {id, {12345}, RequestSource::web, "Ada \"'; DROP TABLE requests", RequestKind::exhibit, "sputnik", 3, "de"};
}

MissionMemory full_memory() {
  MissionMemory memory;
  memory.next_task = 17;
  memory.task = {"abc-16", TaskKind::visit, "sputnik", {1.5, -2.5, Angle::radians(0.7)}, "de", false, "space"};
  memory.schedule.visit = Visit{"sputnik", 2, {1.5, -2.5, Angle::radians(0.7)}, "de", "space", false, {99}};
  memory.schedule.tour = TourRun{"space", "de", {}, true, 360.0, {77}, {{"c", {0, 5}}}};
  memory.schedule.tour->stops = {{"a", StopStatus::explained, 1, 0}, {"b", StopStatus::pending, 2, 5}};
  memory.schedule.broken_tour = memory.schedule.tour;
  memory.schedule.broken_tour->broken_off = {99};
  memory.must_charge = true;
  memory.schedule.counters = {4, 5, 6};
  memory.schedule.visit->asks = false;
  memory.schedule.farewell = Farewell{"space", "de", {55}};
  memory.schedule.loads = {{{7}, 50}, {{9}, 3}};
  memory.lessons = {{{LessonKind::pair, "a", "b/2"}, {3.0, 61.5, 1300.0, 7.25}},
                    {{LessonKind::crowd}, {1.5, 2.5, 0.0, 99.0}}};
  return memory;
}

TEST_F(MissionStoreTest, GivesBackWhatWasSaved) {
  MissionMemory memory = full_memory();
  RequestBoard& board = memory.schedule.board;
  board.add(request("a"), RequestStatus::queued, {}, {1});
  board.add(request("b"), RequestStatus::refused, {ReasonWord::no_such_exhibit, "sputnik"}, {2});
  board.add(request("c"), RequestStatus::queued, {}, {3});
  board.change("c", RequestStatus::active, ReasonWord::on_the_way, {4});
  board.count_attempt("a", {1000});
  {
    MissionStore store = open();
    ASSERT_TRUE(store.save(memory));
  }
  MissionStore store = open("another name");
  const auto loaded = store.load();
  ASSERT_TRUE(loaded);
  EXPECT_EQ(loaded->deployment, "abc") << "the first name stays";
  EXPECT_EQ(loaded->next_task, 17U);
  EXPECT_EQ(loaded->task.id, "abc-16");
  EXPECT_EQ(loaded->task.map_from_base.y, -2.5);
  EXPECT_FALSE(loaded->task.offer_more);
  ASSERT_TRUE(loaded->schedule.visit);
  EXPECT_EQ(loaded->schedule.visit->exhibit_id, "sputnik");
  EXPECT_EQ(loaded->schedule.visit->viewpoint, 2);
  EXPECT_FALSE(loaded->schedule.visit->is_joinable);
  ASSERT_TRUE(loaded->schedule.tour);
  ASSERT_TRUE(loaded->schedule.broken_tour);
  EXPECT_EQ(loaded->schedule.broken_tour->stops.size(), 2U);
  EXPECT_EQ(loaded->schedule.broken_tour->broken_off, (Time{99}));
  ASSERT_EQ(loaded->schedule.tour->stops.size(), 2U);
  EXPECT_EQ(loaded->schedule.tour->stops[0].status, StopStatus::explained);
  EXPECT_EQ(loaded->schedule.tour->stops[1].attempts, 2);
  EXPECT_EQ(loaded->schedule.tour->stops[1].number, 5);
  ASSERT_EQ(loaded->schedule.tour->members.size(), 1U);
  EXPECT_EQ(loaded->schedule.tour->members[0].request_id, "c");
  EXPECT_EQ(loaded->schedule.tour->members[0].stops, (std::vector<int>{0, 5}));
  EXPECT_TRUE(loaded->must_charge);
  EXPECT_FALSE(loaded->schedule.visit->asks);
  ASSERT_EQ(loaded->schedule.loads.size(), 2U);
  EXPECT_EQ(loaded->schedule.loads[0].at, Time{7});
  EXPECT_EQ(loaded->schedule.loads[1].stops, 3);
  ASSERT_TRUE(loaded->schedule.farewell);
  EXPECT_EQ(loaded->schedule.farewell->tour_id, "space");
  EXPECT_EQ(loaded->schedule.farewell->started, Time{55});
  ASSERT_EQ(loaded->lessons.size(), 2U);
  const LessonRow& pair = loaded->lessons.back();
  EXPECT_EQ(pair.key, (LessonKey{LessonKind::pair, "a", "b/2"}));
  EXPECT_EQ(pair.lesson, (Lesson{3.0, 61.5, 1300.0, 7.25}));
  EXPECT_EQ(loaded->schedule.counters.requests_served, 6U);
  const auto& entries = loaded->schedule.board.entries();
  ASSERT_EQ(entries.size(), 3U);
  EXPECT_EQ(entries[0].request.id, "a");
  EXPECT_EQ(entries[0].attempts, 1);
  EXPECT_EQ(entries[0].not_before, Time{1000});
  EXPECT_EQ(entries[0].request.visitor, request("a").visitor);
  EXPECT_EQ(entries[1].request.id, "c");
  EXPECT_EQ(entries[1].status, RequestStatus::active);
  EXPECT_EQ(entries[1].changed, Time{4});
  EXPECT_EQ(entries[2].reason, Reason(ReasonWord::no_such_exhibit, "sputnik"));
  EXPECT_EQ(loaded->schedule.board.revision(), board.revision());
}

TEST_F(MissionStoreTest, LearnsOnInAFileOfBefore) {
  {
    MissionStore store = open();
    MissionMemory memory = full_memory();
    memory.lessons.clear();
    ASSERT_TRUE(store.save(memory));
    SQLite::Database before{path().string(), SQLite::OPEN_READWRITE};
    before.exec("DROP TABLE travel_times");  // as a program without it wrote it
  }
  MissionStore store = open();
  EXPECT_TRUE(store.set_aside().empty());
  MissionMemory memory = store.load().value();
  EXPECT_EQ(memory.next_task, 17U);
  EXPECT_TRUE(memory.lessons.empty());
  for (const double sum : {10.0, 25.0}) {
    memory.lessons = {{{LessonKind::pair, "a", "b"}, {1.0, sum, 0.0, 0.0}}};
    ASSERT_TRUE(store.save(memory));
  }
  memory.lessons.clear();
  ASSERT_TRUE(store.save(memory));
  const auto lessons = store.load()->lessons;
  ASSERT_EQ(lessons.size(), 1U) << "a lesson replaces the one before";
  EXPECT_EQ(lessons.front().lesson.sum, 25.0);
}

TEST_F(MissionStoreTest, RemembersOldRequestsForEver) {
  MissionStore store = open();
  MissionMemory memory;
  for (int i = 0; i < 250; ++i) {
    memory.schedule.board.add(request("r" + std::to_string(i)), RequestStatus::refused, ReasonWord::closed, {i});
    ASSERT_TRUE(store.save(memory));
    memory.schedule.board.mark_stored();
  }
  const auto old = store.find("r3");
  ASSERT_TRUE(old && *old);
  EXPECT_EQ((*old)->created, Time{3});
  EXPECT_EQ((*old)->status, RequestStatus::refused);
  EXPECT_FALSE(*store.find("unknown"));
  const auto loaded = store.load();
  EXPECT_EQ(loaded->schedule.board.entries().size(), RequestBoard::kClosedKept);
  EXPECT_EQ(loaded->schedule.board.entries().back().request.id, "r249");
}

TEST_F(MissionStoreTest, ADeathLosesNothingThatWasSaved) {
  const pid_t child = fork();
  if (child == 0) {
    auto store = MissionStore::open(path(), "abc", true);
    MissionMemory memory = full_memory();
    memory.schedule.board.add(request("a"), RequestStatus::queued, {}, {1});
    if (store && store->save(memory)) kill(getpid(), SIGKILL);  // no destructor, no checkpoint of the WAL
    _exit(1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  MissionStore store = open();
  const auto loaded = store.load();
  ASSERT_TRUE(loaded);
  EXPECT_NE(loaded->schedule.board.find("a"), nullptr);
  EXPECT_TRUE(loaded->schedule.visit);
}

TEST_F(MissionStoreTest, SetsADamagedFileAside) {
  ASSERT_TRUE(write_file_atomically(path(), std::string(5000, 'x')));
  MissionStore store = open();
  EXPECT_EQ(store.set_aside(), path().string() + ".damaged");
  EXPECT_TRUE(std::filesystem::exists(store.set_aside()));
  EXPECT_TRUE(store.load());
  EXPECT_TRUE(store.save(full_memory()));
}

TEST_F(MissionStoreTest, AFolderThatIsNotThereIsOneClearLine) {
  const auto store = MissionStore::open(folder_ / "absent" / "mission.sqlite", "abc", false);
  ASSERT_FALSE(store);
  EXPECT_NE(store.error().message.find("mission.sqlite"), std::string::npos);
  EXPECT_EQ(store.error().message.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace docent::task_control
