#include "docent/apps/golog/golog_trace.h"

#include <gtest/gtest.h>

#include "docent/base/shipped_files.h"

namespace docent::apps::golog_command {
namespace {

/// As in [Rhino1999] Figs. 21 and 22: exhibit 5 lies between 1 and 12.
task_control::Programme line_museum() {
  task_control::Programme programme;
  programme.exhibits = {
      {"e1", {3.5, 0.0, Angle{}}, {}}, {"e5", {7.0, 0.0, Angle{}}, {}}, {"e12", {14.0, 0.0, Angle{}}, {}}};
  return programme;
}

std::string trace_of(const std::string& events, const std::string& main, double most_s = 3600.0) {
  const auto parsed = parse_trace_events(events, "events.txt");
  if (!parsed) return parsed.error().message;
  auto program = task_control::GologProgram::load({}, shipped_path("prolog/tour_guide.pl"), line_museum(),
                                                  task_control::straight_distance(), main);
  if (!program) return program.error().message;
  std::string text;
  const auto played = play_trace(*program, line_museum(), *parsed, "events.txt", most_s,
                                 [&](const std::string& line) { text += line + "\n"; });
  return played ? text : text + played.error().message;
}

TEST(GologTrace, ShowsThePapersExample) {
  // [Rhino1999] 4.3: requests for 1 and 12, then for 5 while 1 is explained; 0.35 m/s and 30 s an explanation.
  EXPECT_EQ(trace_of("0 requested e1\n0 requested e12\n20 requested e5\n", "internet_tourguide"),
            "     0.0 s  event    requested(e1)\n"
            "     0.0 s  event    requested(e12)\n"
            "     0.0 s  begin    drive(e1)\n"
            "    10.0 s  done     drive(e1)\n"
            "    10.0 s  begin    explain(e1)\n"
            "    20.0 s  event    requested(e5)\n"
            "    40.0 s  done     explain(e1)\n"
            "    40.0 s  begin    drive(e5)\n"
            "    50.0 s  done     drive(e5)\n"
            "    50.0 s  begin    explain(e5)\n"
            "    80.0 s  done     explain(e5)\n"
            "    80.0 s  begin    drive(e12)\n"
            "   100.0 s  done     drive(e12)\n"
            "   100.0 s  begin    explain(e12)\n"
            "   130.0 s  done     explain(e12)\n"
            "   130.0 s  begin    drive(home)\n"
            "   170.0 s  done     drive(home)\n"
            "   170.0 s  finished\n");
}

TEST(GologTrace, EndsActionsAsTheFileSays) {
  const std::string text = trace_of("0 requested e1 # the first\n\n42 sensed ask_more e1 more\n", "tour_guide");
  EXPECT_NE(text.find("    42.0 s  sensed   ask_more(e1) = more\n    42.0 s  begin    explain_more(e1)\n"),
            std::string::npos)
      << text;
  const std::string failed = trace_of("0 requested e1\n5 failed drive e1\n", "tour_guide");
  EXPECT_NE(failed.find("     5.0 s  failed   drive(e1)\n     5.0 s  begin    drive(home)\n"), std::string::npos)
      << failed;
}

TEST(GologTrace, TimeOutsCome) {
  const std::string text = trace_of("0 requested e1\n", "tour_guide");
  EXPECT_NE(text.find("    40.0 s  begin    ask_more(e1)\n    45.0 s  stop     ask_more(e1)\n"), std::string::npos)
      << text;
}

TEST(GologTrace, NamesTheLineOfAFault) {
  EXPECT_EQ(trace_of("0 requested e1\nsoon lost\n", "tour_guide"),
            "events.txt:2: a line begins with its time in seconds, not with 'soon'");
  EXPECT_EQ(trace_of("5\n", "tour_guide"), "events.txt:1: nothing happens on this line");
  EXPECT_EQ(trace_of("5 sensed more\n", "tour_guide"), "events.txt:1: 'sensed' needs an action and a value");
  EXPECT_EQ(trace_of("5 lost\n4 localized\n", "tour_guide"), "events.txt:2: events stand in the order of their times");
  EXPECT_EQ(trace_of("5 failed drive e1\n", "tour_guide"), "events.txt:1: drive(e1) is not under way");
  EXPECT_EQ(trace_of("5 earthquake\n", "tour_guide"), "events.txt:1: earthquake is no event of the domain");
  EXPECT_EQ(trace_of("0 requested e1\n5 requestd e1\n", "tour_guide"),
            "events.txt:2: requestd(e1) is no event of the domain; did you mean requested?");
}

TEST(GologTrace, SaysHowItEnds) {
  const auto last_line = [](std::string text) {
    text.pop_back();
    return text.substr(text.rfind('\n') + 1);
  };
  EXPECT_EQ(trace_of("", "tour_guide"), "    61.0 s  waits\n");
  EXPECT_EQ(trace_of("", "charge_battery"), "    61.0 s  waits    for charge_battery, which is impossible\n");
  EXPECT_EQ(last_line(trace_of("0 requested e1\n", "tour_guide", 20.0)), "    20.0 s  the time is up");
}

}  // namespace
}  // namespace docent::apps::golog_command
