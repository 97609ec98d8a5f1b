#include "docent/evaluation/run_logs/request_log.h"

#include <gtest/gtest.h>

#include "docent/messages/topics.h"
#include "docent/messages/truth_messages.h"

namespace docent::evaluation {
namespace {

template <class T>
void tell(RequestLog& log, const Topic<T>& topic, double time, T message) {
  log.add(transport::topic_info(topic), time_from_seconds(time), std::make_shared<const T>(std::move(message)));
}

TEST(RequestLog, FollowsARequestFromTheWishToTheExplanation) {
  RequestLog log;
  docent_msgs::TrueState state;
  state.x = 1.5;
  state.theta = 1.0;
  tell(log, topics::kTrueState, 100.0, state);
  const docent_msgs::Request request{"r1", {}, "web", "Ida", "exhibit", "airbus", 3, "de"};
  tell(log, topics::kRequest, 101.0, request);
  tell(log, topics::kRequest, 102.0, request);  // sent again until it is on the board
  docent_msgs::RequestBoard board;
  board.requests = {{request, "queued", "", {}, {}}};
  tell(log, topics::kRequestBoard, 103.0, board);
  tell(log, topics::kRequestBoard, 104.0, board);
  tell(log, topics::kEvent, 105.0, {{}, "order_chosen", "airbus", "airbus/3 zuse", 0.0});
  tell(log, topics::kTask, 105.0, {"t-1", "visit", "airbus", 0, 0, 0, "de", true, "highlights", {}, {}, {}});
  docent_msgs::SpeechState speech;
  speech.state = "speaking";
  for (const char* line : {"t-0/short", "t-1/announcement", "t-1/short", "t-1/short", "t-1/long"}) {
    speech.id = line;
    tell(log, topics::kSpeechState, 110.0, speech);
  }
  board.requests[0].state = "fulfilled";
  board.requests[0].reason = "well, done";
  tell(log, topics::kRequestBoard, 120.0, board);
  board.requests.clear();  // closed long ago
  tell(log, topics::kRequestBoard, 130.0, board);
  EXPECT_EQ(log.rows(),
            "1.00,asked,r1,web,exhibit,airbus,3,,,1.500,0.000,57.3\n"
            "3.00,board,r1,web,exhibit,airbus,3,queued,,1.500,0.000,57.3\n"
            "5.00,chosen,,,exhibit,airbus,-1,,airbus/3 zuse,1.500,0.000,57.3\n"
            "10.00,heard,t-1,,exhibit,airbus,-1,short,highlights,1.500,0.000,57.3\n"
            "10.00,heard,t-1,,exhibit,airbus,-1,long,highlights,1.500,0.000,57.3\n"
            "20.00,board,r1,web,exhibit,airbus,3,fulfilled,well; done,1.500,0.000,57.3\n");
}

}  // namespace
}  // namespace docent::evaluation
