#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <atomic>
#include <functional>
#include <memory>

#include "arguments.h"
#include "bindings.h"
#include "docent/recording/mcap/reader.h"
#include "exclusive.h"
#include "message_decoder.h"

namespace docent::python {
namespace {

using namespace recording;

/// A channel with what decodes its messages; why nothing does, else.
struct Channel {
  std::string topic, type;
  Result<MessageDecoder> decoder;
};

/// A message that outlives the reading.
struct KeptMessage {
  std::shared_ptr<const Channel> channel;
  Time log_time, publish_time;
  std::vector<std::uint8_t> bytes;
};

class Recording {
 public:
  explicit Recording(McapReader reader, std::string path) : reader_{std::move(reader)}, path_{std::move(path)} {}

  /// May be asked by a handler, too, while it reads; what reading changes may not.
  [[nodiscard]] const McapReader& reader() const { return reader_; }
  [[nodiscard]] std::vector<std::string> damage() const {
    if (is_read_) throw Failed{path_ + ": is being read"};
    return reader_.damage();
  }

  void read(const McapReader::Selection& selection, const std::function<bool(KeptMessage)>& handle) {
    if (is_read_.exchange(true)) throw Failed{path_ + ": is being read already; open it once more"};
    const auto ends = std::shared_ptr<void>{nullptr, [this](void*) { is_read_ = false; }};
    value_or_raise(without_interpreter([&] {
      return reader_.read(selection, [&](const McapMessage& message) {
        KeptMessage kept{channel_of(message.channel),
                         message.log_time,
                         message.publish_time,
                         {message.data.begin(), message.data.end()}};
        const py::gil_scoped_acquire interpreter;
        if (PyErr_CheckSignals() != 0) throw py::error_already_set{};
        return handle(std::move(kept));
      });
    }));
  }

 private:
  std::shared_ptr<const Channel> channel_of(const McapChannel& channel) {
    auto& known = channels_[channel.topic + " " + channel.type + " " + channel.schema];
    if (known) return known;
    Result<MessageDecoder> decoder = fail(channel.topic + ": " + channel.encoding + " with " + channel.schema_encoding +
                                          " is not decoded, only cdr with ros2msg");
    if (channel.encoding == "cdr" && channel.schema_encoding == "ros2msg")
      decoder = MessageDecoder::parse(channel.type, channel.schema);
    known = std::make_shared<const Channel>(Channel{channel.topic, channel.type, std::move(decoder)});
    return known;
  }

  McapReader reader_;
  std::string path_;
  std::map<std::string, std::shared_ptr<const Channel>> channels_;
  std::atomic<bool> is_read_ = false;
};

McapReader::Selection selection_of(const std::set<std::string>& topics, std::optional<Time> from,
                                   std::optional<Time> to, bool skip_damaged) {
  McapReader::Selection selection;
  selection.topics = topics;
  selection.from = from;
  selection.to = to;
  selection.skip_damaged = skip_damaged;
  return selection;
}

/// Topic to type. Reads until each topic of the summary was met; all of a file that has none.
std::map<std::string, std::string> types_of(Recording& recording) {
  const std::size_t count = recording.reader().counts_by_topic().size();
  std::map<std::string, std::string> types;
  McapReader::Selection selection;
  selection.skip_damaged = true;
  recording.read(selection, [&](const KeptMessage& message) {
    types.emplace(message.channel->topic, message.channel->type);
    return count == 0 || types.size() < count;
  });
  return types;
}

/// What a handler answers: None is False.
bool truth_of(const py::object& answer, const char* name) {
  py::detail::make_caster<bool> truth;
  if (!truth.load(answer, true))
    throw py::type_error(std::string{name} + ": True or False is the answer expected, not " + type_name(answer));
  return py::detail::cast_op<bool>(truth);
}

void bind_message(py::module_& module) {
  py::class_<KeptMessage>(module, "McapMessage", "A message of a recording.")
      .def_property_readonly("topic", [](const KeptMessage& message) { return text_of(message.channel->topic); })
      .def_property_readonly("type", [](const KeptMessage& message) { return text_of(message.channel->type); })
      .def_readonly("log_time", &KeptMessage::log_time)
      .def_readonly("publish_time", &KeptMessage::publish_time)
      .def_property_readonly(
          "data",
          [](const KeptMessage& message) {
            return py::bytes(reinterpret_cast<const char*>(message.bytes.data()), message.bytes.size());
          },
          "The bytes as they lie in the file.")
      .def(
          "decode",
          [](const KeptMessage& message) {
            const auto& decoder = message.channel->decoder;
            if (!decoder) throw Failed{message.channel->topic + ": " + decoder.error().message};
            return decoder->decode(message.bytes);
          },
          "A types.SimpleNamespace with the fields of the message, which may be such themselves; sequences of numbers "
          "are "
          "arrays. Error: of another encoding than cdr with ros2msg, or damaged.");
}

void bind_reader(py::module_& module) {
  py::class_<Recording>(module, "McapReader", "Reads MCAP files, also those that end early.")
      .def_static(
          "open",
          [](const std::filesystem::path& path) {
            return std::make_unique<Recording>(
                value_or_raise(without_interpreter([&] { return McapReader::open(path); })), path.string());
          },
          py::arg("path"), "PATH, or PATH.part where the recorder did not come to an end. Error: no MCAP file.")
      .def("profile", [](const Recording& self) { return text_of(self.reader().profile()); })
      .def(
          "is_complete", [](const Recording& self) { return self.reader().is_complete(); },
          "False: the file has no sound end.")
      .def(
          "message_count", [](const Recording& self) { return self.reader().message_count(); },
          "By the file's own summary; None without one.")
      .def(
          "counts_by_topic", [](const Recording& self) { return texts_of(self.reader().counts_by_topic()); },
          "Likewise; empty without a summary.")
      .def(
          "types_by_topic", [](Recording& self) { return texts_of(types_of(self)); },
          "Topic to type, of the topics that have messages.")
      .def(
          "damage", [](const Recording& self) { return texts_of(self.damage()); }, "What the last read left out.")
      .def(
          "read",
          [](Recording& self, const py::function& handler, const std::set<std::string>& topics,
             std::optional<Time> from, std::optional<Time> to, bool skip_damaged) {
            self.read(selection_of(topics, from, to, skip_damaged),
                      [&](KeptMessage message) { return truth_of(handler(std::move(message)), "handler"); });
          },
          py::arg("handler"), py::kw_only(), py::arg("topics") = std::set<std::string>{}, py::arg("from_") = py::none{},
          py::arg("to") = py::none{}, py::arg("skip_damaged") = false,
          "Hands over messages in the order of their log times until handler(message) returns False. No topics: all. "
          "from_, to: log times, both included.")
      .def(
          "messages",
          [](Recording& self, const std::set<std::string>& topics, std::optional<Time> from, std::optional<Time> to,
             bool skip_damaged) {
            std::vector<KeptMessage> all;
            self.read(selection_of(topics, from, to, skip_damaged), [&](KeptMessage message) {
              all.push_back(std::move(message));
              return true;
            });
            return all;
          },
          py::kw_only(), py::arg("topics") = std::set<std::string>{}, py::arg("from_") = py::none{},
          py::arg("to") = py::none{}, py::arg("skip_damaged") = false,
          "The same as a list; of long recordings choose topics or times.");
}

}  // namespace

void bind_recordings(py::module_& module) {
  bind_message(module);
  bind_reader(module);
}

}  // namespace docent::python
