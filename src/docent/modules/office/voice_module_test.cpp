#include "docent/modules/office/voice_module.h"

#include <sys/wait.h>

#include "docent/interaction/speech/child_process.h"
#include "docent/messages/topics.h"
#include "docent/modules/shared/module_bench.h"

namespace docent::modules::voice_module_test {
namespace {

class VoiceTest : public ModuleBench {
 protected:
  VoiceTest() : ModuleBench{"voice", make_voice} {
    museum.languages = {"en"};
    museum.rooms = {{"kitchen", {{"en", "The kitchen"}}, {3.0, 3.0}}};
    EXPECT_TRUE(config.set("voice.enabled=true"));
    EXPECT_TRUE(config.set("voice.orders=true"));
    keep(topics::kOfficeOrder, order_, orders_);
    keep(topics::kRequest, request_, requests_);
    keep(topics::kSay, said_, lines_);
  }
  /// Somebody presses the button and says that.
  void speak(const std::string& text) {
    const std::string file = (state / "said.wav").string();
    ASSERT_TRUE(config.set("voice.input=" + file));
    const auto child = interaction::start_quietly({"espeak-ng", "-v", "en-us", "-s", "140", "-w", file, "--", text});
    ASSERT_TRUE(child && waitpid(*child, nullptr, 0) >= 0);
    start();
    press(4);
    run(8.0);
  }
  void press(int number) {
    buttons_.publish({{}, number});
    run(0.2);
  }

  transport::Publisher<docent_msgs::Button> buttons_ = world->publisher(topics::kButton);
  docent_msgs::OfficeOrder order_;
  docent_msgs::Request request_;
  docent_msgs::Say said_;
  int orders_ = 0, requests_ = 0, lines_ = 0;
};

TEST_F(VoiceTest, WhatIsSaidAfterThePressBecomesAnOrder) {
  speak("deliver this to the kitchen");
  ASSERT_EQ(orders_, 1) << said_.text;
  EXPECT_EQ(order_.kind, "deliver");
  EXPECT_EQ(order_.room, "kitchen");
  EXPECT_EQ(module->health().reason, "");
}

TEST_F(VoiceTest, AWishForARoomIsSaidUntilItIsOnTheBoard) {
  speak("take me to the kitchen");
  EXPECT_GE(requests_, 3) << said_.text;
  EXPECT_EQ(request_.kind, "room");
  EXPECT_EQ(request_.target, "kitchen");
  EXPECT_EQ(request_.source, "visitor");
  docent_msgs::RequestBoard board;
  board.requests.push_back({request_, "queued", "", {}, {}});
  world->publisher(topics::kRequestBoard).publish(board);
  run(0.2);
  const int before = requests_;
  run(5.0);
  EXPECT_EQ(requests_, before);
}

TEST_F(VoiceTest, TalkIsNotActedUpon) {
  speak("my feet hurt, can we sit down somewhere");
  EXPECT_EQ(orders_ + requests_, 0);
  EXPECT_EQ(lines_, 1) << "it says that it has not understood, or asks back";
}

TEST_F(VoiceTest, WithoutAPressNothingIsHeard) {
  EXPECT_TRUE(config.set("voice.input=/nowhere/said.wav"));
  start();
  press(2);
  run(8.0);
  EXPECT_EQ(module->health().reason, "") << "the microphone was not even opened";
}

TEST_F(VoiceTest, AMicrophoneThatFailsIsNamed) {
  EXPECT_TRUE(config.set("voice.input=hw:77"));
  start();
  press(4);
  EXPECT_EQ(module->health().state, "degraded");
  EXPECT_NE(module->health().reason.find("microphone 'hw:77'"), std::string::npos) << module->health().reason;
}

}  // namespace
}  // namespace docent::modules::voice_module_test
