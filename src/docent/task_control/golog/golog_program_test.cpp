#include "docent/task_control/golog/golog_program.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <thread>

#include "docent/base/shipped_files.h"
#include "docent/task_control/tour_scheduler/route.h"

namespace docent::task_control {
namespace {

using Kind = GologStep::Kind;
namespace fs = std::filesystem;

/// As in [Rhino1999] Figs. 21 and 22: exhibit 5 lies between 1 and 12. Ids need not be Prolog's atoms.
Programme line_museum() {
  Programme programme;
  programme.exhibits = {
      {"e1", {4.0, 0.0, Angle{}}, {}}, {"tv-sat", {9.0, 1.0, Angle{}}, {}}, {"e12", {20.0, 0.0, Angle{}}, {}}};
  programme.charger = Pose2{-2.0, 0.0, Angle{}};
  return programme;
}

GologTerm requested(const std::string& exhibit) { return {"requested", {exhibit}}; }

class GologProgramTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "docent-golog-XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path write(const std::string& text) {
    const fs::path file = folder_ / "tour.pl";
    std::ofstream{file} << text;
    return file;
  }
  Result<GologProgram> load(const std::string& text, GologParams params = {}) {
    return GologProgram::load(params, write(text), line_museum(), straight_distance());
  }
  static GologProgram shipped(const std::string& main) {
    return std::move(
        GologProgram::load({}, shipped_path("prolog/tour_guide.pl"), line_museum(), straight_distance(), main).value());
  }
  /// Steps at 0 s until the program waits or ends; each action succeeds at once.
  static std::vector<std::string> run(GologProgram& program, std::vector<GologTerm> events, Kind* end = nullptr) {
    std::vector<std::string> actions;
    for (int i = 0; i < 100; ++i) {
      const auto step = program.step(Time{}, {}, events);
      events.clear();
      if (!step) return {step.error().message};
      if (end != nullptr) *end = step->kind;
      if (step->kind == Kind::waits || step->kind == Kind::finished) break;
      actions.push_back((step->kind == Kind::stop ? "stop " : "") + to_text(step->action));
      if (step->kind == Kind::begin && !program.outcome(step->action, {})) return {"the outcome was refused"};
    }
    return actions;
  }

  fs::path folder_;
};

using Actions = std::vector<std::string>;

TEST_F(GologProgramTest, ServesTheNearestFirstAndGoesHome) {
  GologProgram program = shipped("internet_tourguide");
  Kind end{};
  EXPECT_EQ(run(program, {requested("e12"), requested("e1")}, &end),
            (Actions{"drive(e1)", "explain(e1)", "drive(e12)", "explain(e12)", "drive(home)"}));
  EXPECT_EQ(end, Kind::finished);
}

TEST_F(GologProgramTest, ChoosesAnewAfterEachExplanation) {
  GologProgram program = shipped("internet_tourguide");
  const std::vector<GologTerm> first{requested("e1"), requested("e12")};
  ASSERT_EQ(program.step(Time{}, {}, first)->action, (GologTerm{"drive", {"e1"}}));
  ASSERT_TRUE(program.outcome({"drive", {"e1"}}, {}));
  ASSERT_EQ(program.step(Time{}, {})->action, (GologTerm{"explain", {"e1"}}));
  const std::vector<GologTerm> then{requested("tv-sat")};
  ASSERT_EQ(program.step(Time{}, {}, then)->kind, Kind::waits);
  ASSERT_TRUE(program.outcome({"explain", {"e1"}}, {}));
  EXPECT_EQ(run(program, {}),
            (Actions{"drive(tv-sat)", "explain(tv-sat)", "drive(e12)", "explain(e12)", "drive(home)"}));
}

TEST_F(GologProgramTest, TakesTheOrderOfManyFromTheScheduler) {
  Programme programme;
  std::vector<Point2> points;
  std::vector<GologTerm> wishes;
  for (int i = 0; i < 13; ++i) {
    const Point2 point{static_cast<double>(i * 37 % 29), static_cast<double>(i * 53 % 31)};
    points.push_back(point);
    programme.exhibits.push_back({"x" + std::to_string(i), {point.x, point.y, Angle{}}, {}});
    for (int wish = 0; wish < 3; ++wish) wishes.push_back(requested(programme.exhibits.back().id));
  }
  auto program = GologProgram::load({}, shipped_path("prolog/tour_guide.pl"), programme, straight_distance(),
                                    "internet_tourguide");
  ASSERT_TRUE(program) << program.error().message;
  // The points stand in the order of the names, as the program's sets do.
  std::vector<std::string> ids;
  for (const auto& exhibit : programme.exhibits) ids.push_back(exhibit.id);
  std::sort(ids.begin(), ids.end());
  std::vector<StopPlaces> sorted;
  for (const std::string& id : ids) {
    const Pose2& pose = programme.find_exhibit(id)->pose;
    sorted.push_back({pose.position()});
  }
  const std::string nearest = ids[shortest_route({}, sorted, straight_distance()).front().stop];
  const auto step = program->step(Time{}, {}, wishes);
  ASSERT_TRUE(step) << step.error().message;
  EXPECT_EQ(to_text(step->action), "drive(" + nearest + ")");
  ASSERT_TRUE(program->outcome(step->action, {}));
  const auto foresight = program->foresee({});
  ASSERT_TRUE(foresight) << foresight.error().message;
  EXPECT_EQ(foresight->actions.size(), 13U + 12U + 1U);
  EXPECT_EQ(foresight->end, Kind::finished);
}

TEST_F(GologProgramTest, TimeIsTheCallers) {
  auto program = load(
      "proc(main, [within(20, ?(closing), explain('tv-sat')), drive(e1)]).\n"
      "initially(robot_location('tv-sat')).\n");
  ASSERT_TRUE(program) << program.error().message;
  EXPECT_EQ(program->step(time_from_seconds(1e9), {})->kind, Kind::waits);
  EXPECT_EQ(program->step(time_from_seconds(1e9 + 19.9), {})->kind, Kind::waits);
  EXPECT_EQ(program->step(time_from_seconds(1e9 + 20.0), {})->action, (GologTerm{"explain", {"tv-sat"}}));
}

TEST_F(GologProgramTest, OutcomesCount) {
  GologProgram program = shipped("tour_guide");
  const std::vector<GologTerm> wish{requested("e1")};
  ASSERT_EQ(program.step(Time{}, {}, wish)->action, (GologTerm{"drive", {"e1"}}));
  ASSERT_TRUE(program.outcome({"drive", {"e1"}}, {}));
  ASSERT_EQ(program.step(Time{}, {})->action, (GologTerm{"explain", {"e1"}}));
  ASSERT_TRUE(program.outcome({"explain", {"e1"}}, {}));
  ASSERT_EQ(program.step(Time{}, {})->action, (GologTerm{"ask_more", {"e1"}}));
  ASSERT_TRUE(program.outcome({"ask_more", {"e1"}}, {GologOutcome::Kind::sensed, "more"}));
  EXPECT_EQ(run(program, {}), (Actions{"explain_more(e1)", "drive(home)"}));
  // A way that failed is tried again later.
  ASSERT_EQ(program.step(Time{}, {}, wish)->action, (GologTerm{"drive", {"e1"}}));
  ASSERT_TRUE(program.outcome({"drive", {"e1"}}, {GologOutcome::Kind::failed, ""}));
  EXPECT_EQ(run(program, {}), (Actions{"drive(home)"}));
  EXPECT_EQ(program.step(time_from_seconds(121.0), {})->action, (GologTerm{"drive", {"e1"}}));
}

TEST_F(GologProgramTest, NumbersComeInAsNumbers) {
  GologProgram program = shipped("tour_guide");
  EXPECT_EQ(run(program, {requested("e1"), {"battery", {0.15}}}),
            (Actions{"drive(charger)", "charge_battery", "drive(e1)", "explain(e1)", "ask_more(e1)", "drive(home)"}));
}

TEST_F(GologProgramTest, FaultsNameFileAndLine) {
  const auto file = write("proc(main, go).\nproc(go, [drive(e99), jump]).\nproc(stay, ?(X > 3)).\n");
  std::vector<std::string> found;
  for (const Error& fault : GologProgram::faults(file, line_museum())) found.push_back(fault.message);
  const std::string at = file.string() + ":";
  EXPECT_EQ(found, (Actions{at + "3: the variable X stands here only once"}));
  write("proc(main, go).\nproc(go, [drive(e99), jump]).\n");
  found.clear();
  for (const Error& fault : GologProgram::faults(file, line_museum())) found.push_back(fault.message);
  EXPECT_EQ(found, (Actions{at + "2: drive(e99): there is no place(e99)",
                            at + "2: jump is neither an action nor a procedure"}));
  EXPECT_EQ(load("proc(main, [").error().message.substr(0, at.size() + 2), at + "1:");
  EXPECT_EQ(GologProgram::load({}, folder_ / "none.pl", line_museum(), straight_distance())
                .error()
                .message.substr(0, folder_.string().size() + 10),
            (folder_ / "none.pl:1").string());
}

TEST_F(GologProgramTest, AFaultWhileItRunsNamesItsProcedureAndChangesNothing) {
  auto program = load("proc(main, [drive(e1), go]).\nproc(go, ?(some(X, (X = a, X > 3)))).\n");
  ASSERT_TRUE(program) << program.error().message;
  ASSERT_EQ(program->step(Time{}, {})->kind, Kind::begin);
  ASSERT_TRUE(program->outcome({"drive", {"e1"}}, {}));
  const std::string before = program->snapshot().value();
  const auto step = program->step(time_from_seconds(7.0), {});
  ASSERT_FALSE(step);
  EXPECT_EQ(step.error().message.find(folder_.string() + "/tour.pl:2: in go/0: "), 0U) << step.error().message;
  EXPECT_EQ(program->snapshot().value(), before);
}

TEST_F(GologProgramTest, ARunawayProgramIsCut) {
  auto program = load("proc(main, spin).\nproc(spin, while(true, ?(true))).\n", {100'000});
  ASSERT_TRUE(program) << program.error().message;
  for (int i = 0; i < 2; ++i) {
    const auto step = program->step(Time{}, {});
    ASSERT_FALSE(step);
    EXPECT_EQ(step.error().message, folder_.string() +
                                        "/tour.pl:2: in spin/0: Prolog time-out: the step took more than "
                                        "100,000 inferences");
  }
}

TEST_F(GologProgramTest, AProgramThatEatsMemoryIsCut) {
  auto program = load("proc(main, ?(grow([]))).\ngrow(L) :- grow([L, L | L]).\n", {1'000'000'000});
  ASSERT_TRUE(program) << program.error().message;
  const auto step = program->step(Time{}, {});
  ASSERT_FALSE(step);
  EXPECT_NE(step.error().message.find("Stack limit"), std::string::npos) << step.error().message;
  GologProgram other = shipped("internet_tourguide");
  EXPECT_EQ(run(other, {requested("e1")}), (Actions{"drive(e1)", "explain(e1)", "drive(home)"}));
}

TEST_F(GologProgramTest, KnowsItsActions) {
  auto program = load("proc(main, hello).\naction(hello).\nposs(hello, true).\n");
  ASSERT_TRUE(program) << program.error().message;
  const auto actions = program->actions();
  ASSERT_TRUE(actions) << actions.error().message;
  std::map<std::string, std::string> places;
  for (const GologAction& action : *actions)
    EXPECT_TRUE(places.emplace(action.name, action.place).second) << action.name;
  EXPECT_EQ(places["hello"], (folder_ / "tour.pl").string() + ":2");
  for (const char* name : {"drive", "explain", "charge_battery"})
    EXPECT_NE(places[name].find("museum.pl:"), std::string::npos) << name;
}

TEST_F(GologProgramTest, UnknownEventsAreErrors) {
  GologProgram program = shipped("tour_guide");
  const std::vector<GologTerm> nonsense{{"earthquake"}};
  EXPECT_EQ(program.step(Time{}, {}, nonsense).error().message, "earthquake is no event of the domain");
  const std::vector<GologTerm> hostile{requested("e1), shell(reboot")};
  EXPECT_FALSE(program.step(Time{}, {}, hostile));
  EXPECT_TRUE(program.step(Time{}, {}));
}

TEST_F(GologProgramTest, ASnapshotGoesOnInAnotherProcess) {
  GologProgram program = shipped("tour_guide");
  const std::vector<GologTerm> wishes{requested("e1"), requested("tv-sat")};
  ASSERT_EQ(program.step(time_from_seconds(0.1), {}, wishes)->action, (GologTerm{"drive", {"e1"}}));
  const std::string snapshot = program.snapshot().value();
  EXPECT_EQ(snapshot.find('\n'), std::string::npos);
  GologProgram other = shipped("tour_guide");
  ASSERT_TRUE(other.restore(snapshot));
  EXPECT_EQ(other.snapshot().value().size(), snapshot.size());
  for (GologProgram* one : {&program, &other}) {
    ASSERT_TRUE(one->outcome({"drive", {"e1"}}, {}));
    EXPECT_EQ(run(*one, {}),
              (Actions{"explain(e1)", "drive(tv-sat)", "explain(tv-sat)", "ask_more(tv-sat)", "drive(home)"}));
  }
  EXPECT_EQ(other.restore("golog_agent(1,[jump],[])").error().message, "jump is neither an action nor a procedure");
  EXPECT_EQ(other.restore("nonsense(").error().message, "this is no snapshot of a program");
  EXPECT_TRUE(other.step(Time{}, {}));
}

TEST_F(GologProgramTest, ProgramsLiveSideBySideInAnyThread) {
  auto run_one = [](const std::string& exhibit, Actions& actions) {
    for (int i = 0; i < 20; ++i) {
      GologProgram program = shipped("internet_tourguide");
      actions = run(program, {requested(exhibit)});
    }
  };
  Actions left;
  Actions right;
  std::thread other{run_one, "e12", std::ref(right)};
  run_one("e1", left);
  other.join();
  EXPECT_EQ(left, (Actions{"drive(e1)", "explain(e1)", "drive(home)"}));
  EXPECT_EQ(right, (Actions{"drive(e12)", "explain(e12)", "drive(home)"}));
}

TEST_F(GologProgramTest, ALongDayLeavesNothingBehind) {  // what it costs is counted by plunit
  auto program = load("proc(main, while(true, [drive(e1), drive(home)])).\n");
  ASSERT_TRUE(program) << program.error().message;
  for (int i = 0; i < 5000; ++i) {
    const auto step = program->step(time_from_seconds(i), {});
    ASSERT_TRUE(step && step->kind == Kind::begin && program->outcome(step->action, {}));
  }
  EXPECT_LT(program->snapshot()->size(), 400U);
}

/// Programs that no inference limit reaches, and the words that name their fault.
class HostilePrograms : public GologProgramTest {
 protected:
  /// Of one that may run and goes wrong in its first step.
  void expect_named(const std::string& goal, const std::string& words, GologParams params = {}) {
    auto program = load(
        "proc(main, ?(go_wrong)).\ngo_wrong :- " + goal + ".\ngrow(S) :- atom_concat(S, S, T), grow(T).\n", params);
    ASSERT_TRUE(program) << program.error().message;
    const auto step = program->step(Time{}, {});
    ASSERT_FALSE(step) << goal;
    EXPECT_NE(step.error().message.find(words), std::string::npos) << goal << ": " << step.error().message;
    EXPECT_NE(step.error().message.find("tour.pl"), std::string::npos) << step.error().message;
  }
  GologParams quick_{.answer_s = 0.4};
};

TEST_F(HostilePrograms, SleepForEver) { expect_named("sleep(100000)", "no answer for 0.4 s", quick_); }

TEST_F(HostilePrograms, WaitForWhatNobodySends) {
  expect_named("thread_self(Me), thread_get_message(Me, word)", "no answer for 0.4 s", quick_);
}

TEST_F(HostilePrograms, ComputeForEverInAnotherThread) {
  expect_named("thread_create((repeat, fail), _), sleep(1000)", "no answer for 0.4 s", quick_);
}

TEST_F(HostilePrograms, Halt) {
  expect_named("halt", "ended by the program itself (halt, exit status 0)");
  expect_named("halt(9)", "exit status 9");
  expect_named("abort", "ended by the program itself");
}

TEST_F(HostilePrograms, TakeAllMemory) {
  expect_named("findall(x, repeat, L), length(L, _)", "Stack limit");
  expect_named("X is 7 ** (7 ** 12) mod 1000, X > 0", "Stack limit");
  // Atoms do not lie on Prolog's stacks.
  expect_named("grow(x)", "perhaps no memory was left");
  expect_named("set_prolog_flag(stack_limit, 100000000000), numlist(1, 100000000, L), length(L, _)", "");
}

TEST_F(HostilePrograms, BreakDown) {
  expect_named("current_prolog_flag(pid, P), format(atom(C), 'kill -SEGV ~d', [P]), shell(C), sleep(100)", "SIGSEGV");
  expect_named("nb_setval(golog_line, none)", "", quick_);
  expect_named("throw(nonsense)", "the program throws nonsense");
  expect_named("forall(stream_property(S, file_no(1)), (write(S, 'l9:s0:'), flush_output(S)))", "Prolog");
}

TEST_F(HostilePrograms, WriteAndReadWhereTheyLike) {
  auto program = load("proc(main, [?((write(user_output, 'l1:s2:no'), read(user_input, end_of_file))), drive(e1)]).\n");
  ASSERT_TRUE(program) << program.error().message;
  EXPECT_EQ(program->step(Time{}, {})->action, (GologTerm{"drive", {"e1"}}));
}

TEST_F(HostilePrograms, GoWrongWhileTheyAreRead) {
  for (const char* text :
       {":- halt.\nproc(main, []).\n", ":- sleep(1000).\nproc(main, []).\n", ":- repeat, fail.\nproc(main, []).\n"}) {
    const auto program = load(text, quick_);
    ASSERT_FALSE(program) << text;
    EXPECT_NE(program.error().message.find("tour.pl: the program's Prolog"), std::string::npos)
        << program.error().message;
  }
}

TEST_F(HostilePrograms, BeginAnewWithTheNextCall) {
  auto program = load("proc(main, if(request(e1), ?(halt), drive(e1))).\n");
  ASSERT_TRUE(program) << program.error().message;
  const std::vector<GologTerm> wish{requested("e1")};
  ASSERT_FALSE(program->step(Time{}, {}, wish));
  EXPECT_FALSE(program->is_alive());
  EXPECT_EQ(program->step(Time{}, {})->action, (GologTerm{"drive", {"e1"}}));
  EXPECT_TRUE(program->is_alive());
}

TEST_F(HostilePrograms, LeaveOthersAlone) {
  GologProgram other = shipped("internet_tourguide");
  expect_named("halt", "halt");
  EXPECT_EQ(run(other, {requested("e1")}), (Actions{"drive(e1)", "explain(e1)", "drive(home)"}));
}

TEST_F(GologProgramTest, ExpectsDurations) {
  GologProgram program = shipped("tour_guide");
  EXPECT_NEAR(program.expected_s({}, {"drive", {"e1"}}).value(), 4.0 / 0.35, 1e-9);
  EXPECT_FALSE(program.expected_s({}, {"dance"}));
}

TEST_F(GologProgramTest, TheMuseumsOwnFileCounts) {
  EXPECT_EQ(golog_file(folder_), shipped_path("prolog/tour_guide.pl"));
  const auto own = write("proc(main, []).\n");
  EXPECT_EQ(golog_file(folder_), own);
}

TEST(GologParams, NameTheirBounds) {
  EXPECT_TRUE(GologParams{}.validate());
  EXPECT_EQ(GologParams{.most_inferences = 0}.validate().error().message, "golog.most_inferences must be > 0");
  EXPECT_FALSE(GologParams{.answer_s = 0.0}.validate());
  EXPECT_FALSE(GologParams{.memory_mb = 16}.validate());
}

}  // namespace
}  // namespace docent::task_control
