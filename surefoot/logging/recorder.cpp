#include "surefoot/logging/recorder.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/logging/mcap_writer.hpp"
#include "surefoot/logging/message_codec.hpp"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <cstring>
#include <exception>
#include <filesystem>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

namespace surefoot {
namespace {

std::uint64_t nanoseconds(double time) {
  return time > 0.0 ? static_cast<std::uint64_t>(std::llround(1e9 * time)) : 0;
}

McapWriter open(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder)) {
    throw FileError(path + ": there is no folder " + folder.string() +
                    " to write it into; create it first");
  }
  if (std::filesystem::is_directory(path)) {
    throw FileError(path + " is a folder; the name of a file would be valid, e.g. " + path +
                    "/run.mcap");
  }
  return McapWriter(partial_path(path), {.profile = "surefoot"});
}

// Gives HierarchyReport its names.
class Namer {
 public:
  explicit Namer(const LogHeader& header)
      : levels_(header.level_names), row_name_(header.row_name) {}

  const logged::Hierarchy& name(const HierarchyReport& report) {
    named_.status = report.status;
    named_.failed_level = report.failed_level;
    named_.levels.resize(
        static_cast<std::size_t>(std::clamp<int>(report.num_levels, 0, kMaxLevels)));
    for (std::size_t i = 0; i < named_.levels.size(); ++i) {
      named_.levels[i].name = level(static_cast<int>(i));
      named_.levels[i].report = report.levels[i];
    }
    named_.active.resize(
        static_cast<std::size_t>(std::clamp<int>(report.num_active, 0, kMaxReportedRows)));
    for (std::size_t i = 0; i < named_.active.size(); ++i) {
      const ActiveRow& row = report.active[i];
      named_.active[i] = {level(row.level), row_name(row.level, row.id), row.id, row.state};
    }
    name_blockers(report);
    named_.transition_share = report.transition_share;
    name_switch(report.level_switch);
    return named_;
  }

 private:
  void name_blockers(const HierarchyReport& report) {
    named_.blocking_is_known = report.blocking_is_known;
    named_.blocked_by.resize(
        static_cast<std::size_t>(std::clamp<int>(report.num_blocking, 0, kMaxReportedBlockers)));
    for (std::size_t i = 0; i < named_.blocked_by.size(); ++i) {
      const BlockingRow& row = report.blocking[i];
      named_.blocked_by[i] = {level(row.level), level(row.by_level), row_name(row.by_level, row.id),
                              row};
    }
  }

  void name_switch(const LevelSwitchReport& change) {
    named_.level_switches.clear();
    if (!change.begins) return;
    logged::LevelSwitch& named = named_.level_switches.emplace_back();
    named.duration = change.duration;
    for (std::size_t k = 0; k < change.change.size(); ++k) {
      if (change.change[k] == LevelChange::comes) named.add.push_back(level(static_cast<int>(k)));
      if (change.change[k] == LevelChange::goes) named.remove.push_back(level(static_cast<int>(k)));
    }
  }

  std::string level(int i) const {
    const bool known = i >= 0 && static_cast<std::size_t>(i) < levels_.size();
    return known ? levels_[static_cast<std::size_t>(i)] : "level " + std::to_string(i + 1);
  }

  const std::string& row_name(int level, std::int32_t id) {
    const auto [entry, is_new] = rows_.try_emplace({level, id});
    if (is_new) entry->second = row_name_ ? row_name_(level, id) : "row " + std::to_string(id);
    return entry->second;
  }

  std::vector<std::string> levels_;
  std::function<std::string(int, std::int32_t)> row_name_;
  std::map<std::pair<int, std::int32_t>, std::string> rows_;
  logged::Hierarchy named_;
};

// A message that waits for the writer.
struct Job {
  Recorder::Channel channel = -1;  // −1: a tick
  double time = 0.0;
  Recorder::Encode encode;
  TickRecord tick;
};

// Topics of a TickRecord, in the order of their messages.
struct TickChannels {
  std::uint16_t readings, health, user, state, plan, model, hierarchy, command;
};

}  // namespace

struct Recorder::Implementation {
  Implementation(const std::string& path, const LogHeader& header, RecorderOptions options)
      : writer(open(path)), namer(header), queue(std::max<std::size_t>(options.queue_ticks, 1)) {
    write_header(header);
    channels = {.readings = json_channel<SensorReading>("/readings", "surefoot.SensorReading"),
                .health = json_channel<SensorHealth>("/health", "surefoot.SensorHealth"),
                .user = json_channel<UserCommand>("/user", "surefoot.UserCommand"),
                .state = json_channel<RobotState>("/state", "surefoot.RobotState"),
                .plan = json_channel<MotionPlan>("/plan", "surefoot.MotionPlan"),
                .model = json_channel<ModelRecord>("/model", "surefoot.ModelRecord"),
                .hierarchy = json_channel<logged::Hierarchy>("/hierarchy", "surefoot.Hierarchy"),
                .command = json_channel<JointCommand>("/command", "surefoot.JointCommand")};
    thread = std::thread([this] { run(); });
  }

  ~Implementation() { stop(); }

  void write_header(const LogHeader& header) {
    writer.add_metadata("surefoot", {{"log_version", std::string(kLogVersion)},
                                     {"version", header.version},
                                     {"scenario", header.scenario},
                                     {"robot", header.robot.name},
                                     {"stack", header.stack},
                                     {"seed", std::to_string(header.seed)}});
    writer.attach("header.json", "application/json", to_json(header));
    for (const LogAttachment& file : header.attachments) {
      writer.attach(file.name, file.media_type, file.data);
    }
    writer.flush();
  }

  std::uint16_t add_channel(std::string_view topic, std::string_view schema_name,
                            std::string schema) {
    const std::uint16_t id =
        writer.add_schema(std::string(schema_name), "jsonschema", std::move(schema));
    return writer.add_channel(std::string(topic), id, "json",
                              {{"log_version", std::string(kLogVersion)}});
  }

  template <typename T>
  std::uint16_t json_channel(std::string_view topic, std::string_view schema_name) {
    return add_channel(topic, schema_name, logged::schema<T>(schema_name));
  }

  // Takes a free place in the queue, fills it, and hands it to the writer.
  template <typename Fill>
  void push(const Fill& fill) {
    {
      std::unique_lock lock(mutex);
      not_full.wait(lock, [this] { return count < queue.size() || failure; });
      if (failure) std::rethrow_exception(failure);
      fill(queue[(first + count) % queue.size()]);
      ++count;
    }
    not_empty.notify_one();
  }

  void run() {
    std::unique_lock lock(mutex);
    while (true) {
      not_empty.wait(lock, [this] { return count > 0 || stopping; });
      if (count == 0) return;
      Job& job = queue[first];
      lock.unlock();
      try {
        write(job);
      } catch (...) {
        lock.lock();
        failure = std::current_exception();
        not_full.notify_all();
        return;
      }
      lock.lock();
      first = (first + 1) % queue.size();
      --count;
      not_full.notify_one();
    }
  }

  void write(const Job& job) {
    if (job.channel < 0) {
      write(job.tick);
      return;
    }
    text.clear();
    job.encode(text);
    writer.write(static_cast<std::uint16_t>(job.channel), nanoseconds(job.time), text);
  }

  void write(const TickRecord& tick) {
    const std::uint64_t time = nanoseconds(tick.reading.time);
    message(channels.readings, time, tick.reading);
    message(channels.health, time, tick.health);
    message(channels.user, time, tick.user);
    message(channels.state, time, tick.state);
    message(channels.plan, time, tick.plan);
    message(channels.model, time, tick.model);
    message(channels.hierarchy, time, namer.name(tick.hierarchy));
    message(channels.command, time, tick.command);
  }

  template <typename T>
  void message(std::uint16_t channel, std::uint64_t time, const T& signal) {
    text.clear();
    logged::encode(signal, text);
    writer.write(channel, time, text);
  }

  void stop() {
    if (!thread.joinable()) return;
    {
      const std::lock_guard lock(mutex);
      stopping = true;
    }
    not_empty.notify_one();
    thread.join();
  }

  // With the thread gone: what stands apart, and the end of the file.
  void finish(std::string_view summary) {
    if (failure) std::rethrow_exception(failure);
    writer.flush();
    const std::uint16_t channel = json_channel<TickTiming>("/timings", "surefoot.TickTiming");
    for (const TickTiming& timing : timings) message(channel, nanoseconds(timing.time), timing);
    writer.attach("summary.json", "application/json", summary);
    writer.close();
  }

  McapWriter writer;
  Namer namer;
  TickChannels channels{};
  std::vector<TickTiming> timings;
  std::string text;  // of the message that is being written

  std::mutex mutex;
  std::condition_variable not_empty, not_full;
  std::vector<Job> queue;  // a ring: `count` jobs from `first` on
  std::size_t first = 0, count = 0;
  bool stopping = false;
  std::exception_ptr failure;
  std::thread thread;
};

std::string partial_path(const std::string& path) { return path + ".partial"; }

Recorder::Recorder(std::string path, LogHeader header, RecorderOptions options)
    : path_(std::move(path)),
      implementation_(std::make_unique<Implementation>(path_, header, options)) {}

Recorder::~Recorder() {
  if (!implementation_) return;
  implementation_->stop();
  try {
    implementation_->finish("{}");
  } catch (const FileError&) {
    // The ticks so far stand in the file; the error was or could have been seen in `record`.
  }
}

void Recorder::record(const TickRecord& tick) {
  implementation_->push([&](Job& job) {
    job.channel = -1;
    job.tick = tick;
  });
}

void Recorder::record(const TickTiming& timing) { implementation_->timings.push_back(timing); }

Recorder::Channel Recorder::add_channel(std::string_view topic, std::string_view schema_name,
                                        std::string schema) {
  return implementation_->add_channel(topic, schema_name, std::move(schema));
}

void Recorder::record(Channel channel, double time, Encode encode) {
  implementation_->push([&](Job& job) {
    job.channel = channel;
    job.time = time;
    job.encode = std::move(encode);
  });
}

void Recorder::close_partial(std::string_view summary) {
  const std::unique_ptr<Implementation> implementation = std::move(implementation_);
  implementation->stop();
  implementation->finish(summary);
}

void Recorder::close(std::string_view summary) {
  close_partial(summary);
  std::error_code error;
  std::filesystem::rename(partial_path(path_), path_, error);
  if (error) throw FileError(path_ + ": can't get its name (" + error.message() + ")");
}

}  // namespace surefoot
