#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "docent/messages/standard_messages.h"

// What the robot says and how it asks for way.

namespace docent::docent_msgs {

/// A step of the reaction ladder ([Rhino1999] 5.3): for the interaction, the mission and the report.
struct Reaction {
  static constexpr const char* kType = "docent_msgs/msg/Reaction";
  std_msgs::Header header;
  std::string goal_id;
  std::string step;        ///< slow, horn, local_detour, global_detour, wait, ask, give_up, free
  std::string cause;       ///< what is in the way: a word of ReasonWord, or a diagnosis in English
  double after = 0;        ///< [s] since the way was blocked
  std::int32_t count = 0;  ///< how often this step was taken since then, from 1
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("goal_id", m.goal_id);
    v("step", m.step);
    v("cause", m.cause);
    v("after", m.after);
    v("count", m.count);
  }
};

/// Speak.
struct Say {
  static constexpr const char* kType = "docent_msgs/msg/Say";
  std::string id;
  std::string text;
  std::string language;
  std::string mood;  ///< neutral, happy, sad, angry
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("id", m.id);
    v("text", m.text);
    v("language", m.language);
    v("mood", m.mood);
  }
};

/// What is being said; latched.
struct SpeechState {
  static constexpr const char* kType = "docent_msgs/msg/SpeechState";
  std_msgs::Header header;
  std::string id;
  std::string state;  ///< speaking, done, failed
  std::string text;
  std::string language;
  builtin_interfaces::Time start;
  double duration = 0;  ///< [s]
  std::string audio;    ///< file name of the audio, its hash; empty where there is none
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("id", m.id);
    v("state", m.state);
    v("text", m.text);
    v("language", m.language);
    v("start", m.start);
    v("duration", m.duration);
    v("audio", m.audio);
  }
};

/// The horn sounds once.
struct Horn {
  static constexpr const char* kType = "docent_msgs/msg/Horn";
  std_msgs::Header header;
  std::string reason;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("reason", m.reason);
  }
};

/// Play music, or stop it; latched. Once ordered, music no longer follows the task.
struct Music {
  static constexpr const char* kType = "docent_msgs/msg/Music";
  std_msgs::Header header;
  bool plays = false;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("plays", m.plays);
  }
};

/// How loud the robot is and what music it plays; latched.
struct SoundState {
  static constexpr const char* kType = "docent_msgs/msg/SoundState";
  std_msgs::Header header;
  double volume = 1;                     ///< 0..1, of speech and horn
  std::string music;                     ///< file name of the music that plays, its hash; empty: none plays
  double music_volume = 0;               ///< amplitude ratio for that file, less while the robot speaks
  builtin_interfaces::Time music_start;  ///< since when the file is played round and round
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("volume", m.volume);
    v("music", m.music);
    v("music_volume", m.music_volume);
    v("music_start", m.music_start);
  }
};

/// What head, face and voice show, decided in one place; 10 Hz.
struct Expression {
  static constexpr const char* kType = "docent_msgs/msg/Expression";
  std_msgs::Header header;  ///< frame base_link
  std::string mood;         ///< neutral, happy, sad, angry
  double valence = 0;       ///< -1 (angry) .. 1 (happy), for a face between the moods
  bool is_speaking = false;
  std::string gaze;  ///< at what the head looks: goal, person, visitor, way, none
  double pan = 0;    ///< [rad], base_link, to the left
  double tilt = 0;   ///< [rad], upwards
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("mood", m.mood);
    v("valence", m.valence);
    v("is_speaking", m.is_speaking);
    v("gaze", m.gaze);
    v("pan", m.pan);
    v("tilt", m.tilt);
  }
};

/// One of the four coloured buttons beside the screen was pressed.
struct Button {
  static constexpr const char* kType = "docent_msgs/msg/Button";
  std_msgs::Header header;
  std::int32_t number = 0;  ///< 1 red, 2 yellow, 3 green, 4 blue
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("number", m.number);
  }
};

/// Which buttons lead somewhere now, so that their lamps can follow; latched.
struct ButtonLamps {
  static constexpr const char* kType = "docent_msgs/msg/ButtonLamps";
  std_msgs::Header header;
  std::vector<std::int32_t> lit;  ///< numbers of buttons, rising
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("lit", m.lit);
  }
};

}  // namespace docent::docent_msgs
