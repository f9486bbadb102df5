#include "surefoot/logging/recorder.hpp"

#include "surefoot/base/background.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/logging/hierarchy_namer.hpp"
#include "surefoot/logging/logged_model.hpp"
#include "surefoot/logging/logged_timing.hpp"
#include "surefoot/logging/mcap_writer.hpp"
#include "surefoot/logging/message_codec.hpp"
#include "surefoot/logging/write_lock.hpp"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <exception>
#include <filesystem>
#include <mutex>
#include <thread>
#include <vector>

namespace surefoot::logging {
namespace {

std::uint64_t nanoseconds(double time) {
  return time > 0.0 ? static_cast<std::uint64_t>(std::llround(1e9 * time)) : 0;
}

void check_place(const std::string& path) {
  if (path.empty()) throw FileError("the log's name is an empty text; run.mcap would be valid");
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder)) {
    throw FileError(path + ": there is no folder " + folder.string() +
                    " to write it into; create it first");
  }
  if (std::filesystem::is_directory(path)) {
    throw FileError(path + " is a folder; the name of a file would be valid, e.g. " + path +
                    "/run.mcap");
  }
  if (std::filesystem::path(path).extension() != ".mcap") {
    throw FileError(path +
                    ": logs are written as MCAP; a name that ends with .mcap would be valid");
  }
}

constexpr Recorder::Channel kTick = -1;
constexpr Recorder::Channel kNames = -2;  // not a message: names for the following ticks

// A message waiting for the writer.
struct Job {
  Recorder::Channel channel = kTick;
  double time = 0.0;
  Recorder::Encode encode;
  TickRecord tick;
  LevelNames names;
};

// Channels of a TickRecord, in the order of their messages.
struct TickChannels {
  std::uint16_t readings, health, user, state, plan, model, hierarchy, command;
};

}  // namespace

struct Recorder::Implementation {
  Implementation(const std::string& path, const LogHeader& header, RecorderOptions options)
      : write_lock(partial_path(path), path),
        writer(partial_path(path), {.profile = "surefoot"}),
        namer({header.level_names, header.row_name}),
        num_legs(header.robot.num_legs),
        least_load(header.robot.least_load()),
        orders{{0, header.level_names}},
        queue(std::max<std::size_t>(options.queue_ticks, 1)) {
    write_header(header);
    channels = {.readings = json_channel<SensorReading>("/readings", "surefoot.SensorReading"),
                .health = json_channel<SensorHealth>("/health", "surefoot.SensorHealth"),
                .user = json_channel<UserCommand>("/user", "surefoot.UserCommand"),
                .state = json_channel<RobotState>("/state", "surefoot.RobotState"),
                .plan = json_channel<MotionPlan>("/plan", "surefoot.MotionPlan"),
                .model = json_channel<logged::Model>("/model", "surefoot.ModelRecord"),
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
    return add_channel(topic, schema_name, logged::schema<T>(schema_name, "", num_legs));
  }

  // Takes a free place of the queue, fills it, and hands it to the writer.
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
    become_background("log-writer");
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
    if (job.channel == kTick) return write(job.tick);
    if (job.channel == kNames) {
      namer = HierarchyNamer(job.names);
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
    message(channels.model, time, logged::model_of(tick, least_load));
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

  // After the thread's end: writes timings, summary and the end of the file.
  void finish(std::string_view summary) {
    if (failure) std::rethrow_exception(failure);
    writer.flush();
    write_timings();
    writer.attach("summary.json", "application/json", summary);
    writer.close();
  }

  void write_timings() {
    const std::uint16_t channel = json_channel<logged::Timing>("/timings", "surefoot.TickTiming");
    auto order = orders.begin();
    for (std::size_t i = 0; i < timings.size(); ++i) {
      while (order + 1 != orders.end() && (order + 1)->first <= i) ++order;
      message(channel, nanoseconds(timings[i].time), logged::timing_of(timings[i], order->second));
    }
  }

  WriteLock write_lock;  // until the file is renamed
  McapWriter writer;
  HierarchyNamer namer;
  int num_legs;
  double least_load;  // see LogRobot [N]
  TickChannels channels{};
  std::deque<TickTiming> timings;  // grows without moving entries, on the loop's thread
  // Names of the levels, with the index of the first timing that has them.
  std::vector<std::pair<std::size_t, std::vector<std::string>>> orders;
  std::string text;  // of the current message

  std::mutex mutex;
  std::condition_variable not_empty, not_full;
  std::vector<Job> queue;  // a ring: `count` jobs from `first` on
  std::size_t first = 0, count = 0;
  bool stopping = false;
  std::exception_ptr failure;
  std::thread thread;
};

Recorder::Recorder(std::string path, LogHeader header, RecorderOptions options)
    : path_(std::move(path)) {
  check_place(path_);
  implementation_ = std::make_unique<Implementation>(path_, header, options);
}

Recorder::~Recorder() {
  if (!implementation_) return;
  implementation_->stop();
  try {
    implementation_->finish("{}");
  } catch (const FileError&) {
    // The ticks so far are in the file; `record` reports the error, too.
  }
}

void Recorder::record(const TickRecord& tick) {
  implementation_->push([&](Job& job) {
    job.channel = kTick;
    job.tick = tick;
  });
}

int Recorder::num_legs() const { return implementation_->num_legs; }

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

void Recorder::rename(LevelNames names) {
  implementation_->orders.emplace_back(implementation_->timings.size(), names.levels);
  implementation_->push([&](Job& job) {
    job.channel = kNames;
    job.names = std::move(names);
  });
}

std::unique_ptr<Recorder::Implementation> Recorder::finish(std::string_view summary) {
  std::unique_ptr<Implementation> finished = std::move(implementation_);
  finished->stop();
  finished->finish(summary);
  return finished;
}

void Recorder::close_partial(std::string_view summary) { (void)finish(summary); }

void Recorder::close(std::string_view summary) {
  const std::unique_ptr<Implementation> locked = finish(summary);
  std::error_code error;
  std::filesystem::rename(partial_path(path_), path_, error);
  if (error) throw FileError(path_ + ": can't get its name (" + error.message() + ")");
}

}  // namespace surefoot::logging
