#include "docent/transport/dds_bus.h"

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "docent/base/check.h"
#include "docent/messages/schema.h"
#include "docent/messages/topics.h"
#include "docent/transport/cdr_sertype.h"
#include "docent/transport/dds_reach.h"
#include "docent/transport/ros_graph.h"
#include "docent/transport/stamped_twist.h"
#include "docent/transport/type_hash.h"
#include "docent/transport/wire_qos.h"

namespace docent::transport {
namespace {

constexpr std::size_t kStepsKept = 512;
constexpr Duration kReaderWatch = std::chrono::milliseconds{500};
constexpr Duration kRetryPeriod = std::chrono::milliseconds{100};

}  // namespace

Result<std::unique_ptr<DdsBus>> DdsBus::create(DdsOptions options) {
  if (options.domain < 0 || options.domain > kMaxDdsDomain) {
    return fail("DDS domain " + std::to_string(options.domain) + " is not in 0 … " + std::to_string(kMaxDdsDomain));
  }
  const auto domain_id = static_cast<dds_domainid_t>(options.domain);
  const auto refused = [&options](dds_return_t why) {
    std::ifstream ports{"/proc/net/udp"};
    const std::string table{std::istreambuf_iterator<char>{ports}, {}};
    return fail(cannot_join(dds_reach(options.domain, options.interface), dds_strretcode(-why),
                            participants_here(options.domain, table)));
  };
  dds_entity_t own_domain = 0;
  if (const char* uri = std::getenv("CYCLONEDDS_URI"); uri != nullptr) {
    if (auto named = check_uri(uri); !named) return tl::unexpected<Error>(named.error());
  } else {
    if (auto there = check_interface(options.interface, network_interfaces()); !there)
      return tl::unexpected<Error>(there.error());
    own_domain = dds_create_domain(domain_id, dds_configuration(options.interface).c_str());
    if (own_domain == DDS_RETCODE_PRECONDITION_NOT_MET) own_domain = 0;  // another bus of this process made it
    if (own_domain < 0) return refused(own_domain);
  }
  const DdsQos qos{dds_create_qos()};
  dds_qset_userdata(qos.get(), kParticipantUserData.data(), kParticipantUserData.size());
  const dds_entity_t participant = dds_create_participant(domain_id, qos.get(), nullptr);
  if (participant < 0) {
    if (own_domain > 0) dds_delete(own_domain);
    return refused(participant);
  }
  if (own_domain == 0) own_domain = dds_get_parent(participant);
  return std::unique_ptr<DdsBus>{new DdsBus{std::move(options), participant, own_domain}};
}

DdsBus::DdsBus(DdsOptions options, std::int32_t participant, std::int32_t own_domain)
    : options_{std::move(options)},
      participant_{participant},
      own_domain_{own_domain},
      graph_{std::make_unique<RosGraph>(participant, options_.name_prefix, options_.node)} {
  steps_ms_.reserve(kStepsKept);
}

DdsBus::~DdsBus() {
  dds_delete(participant_);  // with all readers and writers: no listener runs after this
  if (own_domain_ > 0 && dds_get_children(own_domain_, nullptr, 0) == 0) dds_delete(own_domain_);
}

void DdsBus::run(std::stop_token stop) {
  while (!stop.stop_requested()) {
    if (graph_->is_new()) graph_->publish();
    std::vector<std::function<void()>> posts;
    Subscription* subscription = nullptr;
    {
      std::unique_lock lock{mutex_};
      const auto has_work = [this] { return !posts_.empty() || !ready_.empty(); };
      if (timers_.empty()) {
        wake_.wait(lock, stop, has_work);
      } else {
        wake_.wait_until(lock, stop, timers_.top().due, has_work);
      }
      posts.swap(posts_);
      if (!ready_.empty()) {
        subscription = ready_.front();
        ready_.erase(ready_.begin());
        subscription->is_ready = false;
      }
    }
    for (const auto& action : posts) time_step(action);
    run_due_timers();
    if (subscription != nullptr) take(*subscription);
  }
}

Time DdsBus::now() const {
  const auto wall = std::chrono::system_clock::now().time_since_epoch();
  const auto at = Steady::now();
  std::int64_t time = std::chrono::duration_cast<Duration>(wall).count();
  const std::scoped_lock lock{clock_mutex_};
  if (time < last_now_) time = last_now_ + std::max<std::int64_t>(0, Duration{at - last_now_at_}.count());
  last_now_ = time;
  last_now_at_ = at;
  return Time{time};
}

void DdsBus::every(Duration period, std::function<void()> action) {
  DOCENT_CHECK(period.count() > 0);
  add_timer(Steady::now() + period, period, std::move(action));
}

void DdsBus::after(Duration delay, std::function<void()> action) {
  add_timer(Steady::now() + delay, Duration{0}, std::move(action));
}

void DdsBus::add_timer(Steady::time_point due, Duration period, std::function<void()> action) {
  timers_.push({due, next_order_++, period, std::make_shared<std::function<void()>>(std::move(action))});
}

void DdsBus::run_due_timers() {
  // Not those that become due meanwhile: messages come first then.
  const auto now_at = Steady::now();
  while (!timers_.empty() && timers_.top().due <= now_at) {
    Timer timer = timers_.top();
    timers_.pop();
    if (timer.period.count() > 0) {
      const auto action = timer.action;
      const auto missed = (now_at - timer.due) / timer.period;  // beats that are lost, never made good
      timer.due += timer.period * (missed + 1);
      timers_.push(timer);
    }
    time_step(*timer.action);
  }
}

void DdsBus::post(std::function<void()> action) {
  {
    const std::scoped_lock lock{mutex_};
    posts_.push_back(std::move(action));
  }
  wake_.notify_one();
}

std::string DdsBus::wire_name(const TopicInfo& info) const {
  // A service's request is a topic, too, by ROS 2's rules for names.
  const std::string kind = std::string_view{info.type->name}.ends_with("_Request") ? "rq" : "rt";
  const auto renamed = options_.renamed.find(info.name);
  const std::string name = renamed == options_.renamed.end() ? info.name : renamed->second;
  if (name.starts_with('/')) return kind + name;
  return kind + "/" + (options_.name_prefix.empty() ? "" : options_.name_prefix + "/") + name;
}

const TypeSupport* DdsBus::wire_support(const TopicInfo& info) const {
  const bool is_command = std::string_view{info.name} == topics::kCommandVelocity.name;
  return options_.stamped_commands && is_command ? &stamped_twist_support() : info.type;
}

std::string DdsBus::wire_type(const TopicInfo& info) const { return dds_type_name(wire_support(info)->name); }

DdsBus::DdsTopic DdsBus::find_or_create(const TopicInfo& info) {
  const TypeSupport* support = wire_support(info);
  const auto known = topics_.find(info.name);
  if (known != topics_.end()) {
    DOCENT_CHECK(known->second.support == support);
    return known->second;
  }
  ddsi_sertype* type = make_cdr_sertype(dds_type_name(support->name));
  const dds_entity_t entity =
      dds_create_topic_sertype(participant_, wire_name(info).c_str(), &type, nullptr, nullptr, nullptr);
  DOCENT_CHECK(entity > 0);
  return topics_.emplace(info.name, DdsTopic{entity, type, support}).first->second;
}

int DdsBus::add_publisher(const TopicInfo& info) {
  const DdsTopic topic = find_or_create(info);
  dds_listener_t* listener = dds_create_listener(this);
  dds_lset_offered_incompatible_qos(
      listener, [](dds_entity_t writer, const dds_offered_incompatible_qos_status_t status, void* bus) {
        char name[256] = "?";
        dds_get_name(dds_get_topic(writer), name, sizeof(name));
        static_cast<DdsBus*>(bus)->warn_later(std::string{"a reader of "} + name + " asks for a " +
                                              policy_name(status.last_policy_id) + " that is not offered");
      });
  const dds_entity_t writer =
      dds_create_writer(participant_, topic.entity, dds_writer_qos(info, topic.support->name).get(), listener);
  dds_delete_listener(listener);
  DOCENT_CHECK(writer > 0);
  graph_->add_writer(writer);
  writers_.push_back({writer, topic, info.qos == Qos::state, nullptr});
  return static_cast<int>(writers_.size()) - 1;
}

void DdsBus::publish(int publisher, std::shared_ptr<const void> message) {
  write(writers_[static_cast<std::size_t>(publisher)], message);
}

void DdsBus::write(Writer& writer, const std::shared_ptr<const void>& message) {
  writer.unsent = nullptr;
  const dds_return_t done =
      dds_writecdr(writer.entity, make_cdr_sample(writer.topic.type, writer.topic.support->encode(message.get())));
  if (done == DDS_RETCODE_OK) return;
  ++counters_.unsent;
  // A reader holds the writer up. Commands grow old; a state must arrive, so its newest value is tried again.
  if (!writer.is_state) return;
  writer.unsent = message;
  if (!retry_is_due_) {
    retry_is_due_ = true;
    after(kRetryPeriod, [this] { retry_unsent(); });
  }
}

void DdsBus::retry_unsent() {
  retry_is_due_ = false;
  for (auto& writer : writers_) {
    if (writer.unsent) write(writer, std::shared_ptr<const void>{writer.unsent});
  }
}

void DdsBus::on_data(std::int32_t /*reader*/, void* argument) {
  auto& subscription = *static_cast<Subscription*>(argument);
  DdsBus& bus = *subscription.bus;
  {
    const std::scoped_lock lock{bus.mutex_};
    if (subscription.is_ready) return;
    subscription.is_ready = true;
    bus.ready_.push_back(&subscription);
  }
  bus.wake_.notify_one();
}

void DdsBus::add_subscription(const TopicInfo& info, Handler handler) {
  const DdsTopic topic = find_or_create(info);
  auto& subscription = *subscriptions_.emplace_back(std::make_unique<Subscription>());
  subscription.bus = this;
  subscription.name = info.name;
  subscription.support = topic.support;
  subscription.handler = std::move(handler);
  subscription.max_age = seconds(info.max_age_s);
  subscription.topic = topic.entity;
  subscription.info = info;
  subscription.info.name = subscription.name.c_str();
  open_reader(subscription);
  if (info.qos != Qos::sensor || watches_readers_) return;
  watches_readers_ = true;
  every(kReaderWatch, [this] { renew_deaf_readers(); });
}

void DdsBus::open_reader(Subscription& subscription) {
  dds_listener_t* listener = dds_create_listener(&subscription);
  dds_lset_data_available(listener, on_data);
  dds_lset_requested_incompatible_qos(
      listener, [](dds_entity_t, const dds_requested_incompatible_qos_status_t status, void* argument) {
        const auto& asking = *static_cast<Subscription*>(argument);
        asking.bus->warn_later("a writer of " + asking.name + " does not offer the " +
                               policy_name(status.last_policy_id) + " that is asked for");
      });
  const dds_entity_t reader = dds_create_reader(
      participant_, subscription.topic, dds_reader_qos(subscription.info, subscription.support->name).get(), listener);
  dds_delete_listener(listener);
  DOCENT_CHECK(reader > 0);
  subscription.reader = reader;
  graph_->add_reader(reader);
}

void DdsBus::renew_deaf_readers() {
  for (const auto& each : subscriptions_) {
    if (each->info.qos != Qos::sensor || !each->watch.is_deaf(Steady::now(), alive_writers(each->name) > 0)) continue;
    graph_->remove_reader(each->reader);
    dds_delete(each->reader);  // no listener runs after this
    open_reader(*each);
    ++counters_.renewed;
    warn_later("nothing came on " + each->name + " though its writer lives: a new reader is made");
  }
}

Duration DdsBus::AgeFilter::excess(Duration age, Steady::time_point at) {
  // Longer than a process may be stopped, so that the first stale sample does not become the measure; short enough that
  // a step of a clock is forgiven.
  constexpr auto kWindow = std::chrono::minutes{1};
  if (at - begin > kWindow) {
    previous = current;
    current = age;
    begin = at;
  }
  current = std::min(current, age);
  return age - std::min(current, previous);
}

bool DdsBus::is_stale(Subscription& subscription, std::uint64_t writer, std::int64_t written_at) {
  if (subscription.max_age.count() == 0) return false;
  const auto wall = std::chrono::duration_cast<Duration>(std::chrono::system_clock::now().time_since_epoch());
  return subscription.ages[writer].excess(wall - Duration{written_at}, Steady::now()) > subscription.max_age;
}

void DdsBus::take(Subscription& subscription) {
  constexpr std::uint32_t kBatch = 16;
  ddsi_serdata* samples[kBatch] = {};
  dds_sample_info_t infos[kBatch];
  const dds_return_t count = dds_takecdr(subscription.reader, samples, kBatch, infos, DDS_ANY_STATE);
  for (dds_return_t i = 0; i < count; ++i) {
    if (infos[i].valid_data && is_stale(subscription, infos[i].publication_handle, infos[i].source_timestamp)) {
      ++counters_.stale;
    } else if (infos[i].valid_data) {
      const auto message = subscription.support->decode(cdr_bytes(samples[i]));
      if (message) {
        ++counters_.received;
        subscription.watch.hear(Steady::now());
        time_step([&] { subscription.handler(message); });
      } else {
        refuse(subscription.name, {"it", "does not decode"});
        if (counters_.damaged++ == 0) warn_later("damaged sample on " + subscription.name + ", dropped");
      }
    }
    ddsi_serdata_unref(samples[i]);
  }
  // There may be more, but others and the timers have their turn first.
  if (count == static_cast<dds_return_t>(kBatch)) on_data(subscription.reader, &subscription);
}

void DdsBus::time_step(const std::function<void()>& step) {
  const auto start = Steady::now();
  step();
  const auto ms = std::chrono::duration<float, std::milli>(Steady::now() - start).count();
  if (steps_ms_.size() < kStepsKept) {
    steps_ms_.push_back(ms);
  } else {
    steps_ms_[next_step_++ % kStepsKept] = ms;
  }
}

double DdsBus::step_p99_ms() const {
  if (steps_ms_.empty()) return 0.0;
  std::vector<float> sorted = steps_ms_;
  const auto place = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() * 99 / 100);
  std::nth_element(sorted.begin(), place, sorted.end());
  return static_cast<double>(*place);
}

int DdsBus::alive_writers(const std::string& topic) const {
  for (const auto& subscription : subscriptions_) {
    if (subscription->name != topic) continue;
    dds_liveliness_changed_status_t status{};
    if (dds_get_liveliness_changed_status(subscription->reader, &status) != DDS_RETCODE_OK) return -1;
    return static_cast<int>(status.alive_count);
  }
  return -1;
}

int DdsBus::foreign_endpoints(const std::string& wire_name) {
  constexpr std::uint32_t kMost = 1024;
  if (publications_ == 0)
    publications_ = dds_create_reader(participant_, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr);
  dds_guid_t own{};
  if (publications_ < 0 || dds_get_guid(participant_, &own) != DDS_RETCODE_OK) return 0;
  std::vector<void*> samples(kMost, nullptr);
  std::vector<dds_sample_info_t> infos(kMost);
  const dds_return_t count = dds_read_mask(publications_, samples.data(), infos.data(), kMost, kMost,
                                           DDS_ANY_SAMPLE_STATE | DDS_ANY_VIEW_STATE | DDS_ALIVE_INSTANCE_STATE);
  int found = 0;
  for (dds_return_t i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (!infos[k].valid_data) continue;
    const auto& endpoint = *static_cast<const dds_builtintopic_endpoint_t*>(samples[k]);
    dds_liveliness_kind_t kind = DDS_LIVELINESS_AUTOMATIC;
    dds_duration_t lease = DDS_INFINITY;
    if (endpoint.qos != nullptr) dds_qget_liveliness(endpoint.qos, &kind, &lease);
    // One with a lease of its own is asked for its life elsewhere.
    if (wire_name == endpoint.topic_name && lease == DDS_INFINITY &&
        !std::equal(std::begin(own.v), std::end(own.v), std::begin(endpoint.participant_key.v)))
      ++found;
  }
  if (count > 0) dds_return_loan(publications_, samples.data(), count);
  return found;
}

int DdsBus::other_writers(const TopicInfo& topic) {
  auto [probe, is_new] = probes_.try_emplace(topic.name, 0);
  if (is_new) {
    const DdsTopic probed = find_or_create(topic);
    const DdsQos qos = dds_probe_qos(topic, probed.support->name);
    probe->second = dds_create_reader(participant_, probed.entity, qos.get(), nullptr);
    graph_->add_reader(probe->second);
  }
  const auto own = std::count_if(
      writers_.begin(), writers_.end(),
      [entity = find_or_create(topic).entity](const Writer& writer) { return writer.topic.entity == entity; });
  dds_liveliness_changed_status_t status{};
  const bool is_told = probe->second > 0 && dds_get_liveliness_changed_status(probe->second, &status) == DDS_RETCODE_OK;
  const int alive = is_told ? static_cast<int>(status.alive_count) - static_cast<int>(own) : 0;
  return std::max({alive, foreign_endpoints(wire_name(topic)), 0});
}

void DdsBus::warn_later(std::string text) {
  post([this, text = std::move(text)] {
    if (options_.warn) options_.warn(text);
  });
}

}  // namespace docent::transport
