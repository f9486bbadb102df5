// Whether pages that watch a run delay its control loop: the controller's tick with many pages, one
// of which never reads, over the same tick with none.
//
// One process makes the same walk at real time again and again, in short stretches with pages and
// without by turns; every second walk has them the other way round. So each tick is measured with
// and without pages, with the same numbers in it, within a minute of the same machine. What counts
// is the ratio of the quantiles of all ticks with pages to all without; its interval is from
// drawing pairs of stretches again (bootstrap), as what the machine does comes in stretches, too.
//
// The program, its server's thread included, has the first core, the pages have the others: what is
// told is what serving costs the loop, not what browsers cost. The time by the clock has in it
// whatever takes the core from the tick; the time of the processor that the tick's thread had has
// caches and memory alone.

#include "app/closed_loop.hpp"
#include "app/live_feed.hpp"
#include "app/live_view.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "surefoot/view/web_server.hpp"

#include <CLI/CLI.hpp>
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sched.h>
#include <sys/epoll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <new>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace surefoot {
namespace {

struct Arguments {
  std::string scenario = "walk_flat";
  int clients = 50;
  double minutes = 10.0;
  double walk = 30.0;     // [s]
  double stretch = 2.0;   // with pages, or without [s]
  double settling = 0.6;  // of each stretch, not counted [s]
};

constexpr int kFewest = 100;   // ticks beyond a quantile that is told
constexpr int kDraws = 4000;   // of the bootstrap
constexpr double kAim = 1.05;  // of the ratio at 99.9 %
constexpr std::array kShares{0.5, 0.99, 0.999};

/// What this process and that of the pages have in common.
struct Common {
  std::atomic<int> port{0}, pages{0};
  std::atomic<long long> bytes{0};
};

Common& make_common() {
  void* memory =
      mmap(nullptr, sizeof(Common), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw Error("there is no memory for two processes");
  return *new (memory) Common();
}

void use_cores(int first, int count) {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  for (int core = first; core < first + count; ++core) CPU_SET(core, &cores);
  if (sched_setaffinity(0, sizeof(cores), &cores) != 0) throw Error("the cores can't be chosen");
}

/// A page that watches; -1 where there is no server.
int open_page(int port, bool reads) {
  const int page = socket(AF_INET, SOCK_STREAM, 0);
  const int little = 4096;
  if (!reads) setsockopt(page, SOL_SOCKET, SO_RCVBUF, &little, sizeof(little));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const std::string host = "127.0.0.1:" + std::to_string(port);
  const std::string request = "GET /api/live HTTP/1.1\r\nHost: " + host + "\r\nOrigin: http://" +
                              host +
                              "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                              "Sec-WebSocket-Version: 13\r\n"
                              "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
  if (connect(page, reinterpret_cast<sockaddr*>(&address), sizeof(address)) == 0 &&
      send(page, request.data(), request.size(), MSG_NOSIGNAL) > 0) {
    return page;
  }
  close(page);
  return -1;
}

/// The pages' process: as many as are wanted, of which the first never reads.
[[noreturn]] void watch(Common& common) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  std::vector<int> pages;
  std::vector<char> buffer(1U << 18U);
  std::array<epoll_event, 64> ready{};
  const int poll = epoll_create1(0);
  while (true) {
    const auto wanted = static_cast<std::size_t>(common.pages.load());
    while (pages.size() < wanted) {
      const bool reads = !pages.empty();
      const int page = open_page(common.port, reads);
      if (page < 0) break;
      epoll_event event{.events = EPOLLIN, .data = {.fd = page}};
      if (reads) epoll_ctl(poll, EPOLL_CTL_ADD, page, &event);
      pages.push_back(page);
    }
    for (; pages.size() > wanted; pages.pop_back()) close(pages.back());
    const int count = epoll_wait(poll, ready.data(), static_cast<int>(ready.size()), 5);
    for (int i = 0; i < count; ++i) {
      const int page = ready[static_cast<std::size_t>(i)].data.fd;
      const ssize_t size = recv(page, buffer.data(), buffer.size(), MSG_DONTWAIT);
      if (size > 0) common.bytes += size;
      if (size == 0) epoll_ctl(poll, EPOLL_CTL_DEL, page, nullptr);
    }
  }
}

/// A feed, and how many watch it.
class CountedFeed final : public WebContent {
 public:
  explicit CountedFeed(LiveFeed& feed) : feed_(feed) {}
  WebAnswer get(std::string_view path, const Query& query) override {
    return feed_.get(path, query);
  }
  [[nodiscard]] bool is_live() const override { return true; }
  std::vector<SharedBlock> welcome() override { return feed_.welcome(); }
  std::vector<SharedBlock> blocks() override { return feed_.blocks(); }
  std::vector<std::string> messages(std::size_t clients) override {
    watching = static_cast<int>(clients);
    return feed_.messages(clients);
  }
  std::string status(std::size_t clients) override { return feed_.status(clients); }

  std::atomic<int> watching{0};

 private:
  LiveFeed& feed_;
};

/// A tick: the pair of stretches that it is of, and its times [µs].
struct Tick {
  int pair;
  float wall, cpu;
};

double thread_microseconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e6 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_nsec);
}

/// Steers walks as a live view does, asks for pages and for none by turns, and times the ticks.
class Stretches final : public RunSteering {
 public:
  Stretches(const Arguments& arguments, double period, LiveView& view, const CountedFeed& feed,
            Common& common)
      : clients_(arguments.clients),
        length_(static_cast<int>(arguments.stretch / period)),
        settling_(static_cast<int>(arguments.settling / period)),
        in_walk_(static_cast<int>(std::ceil(arguments.walk / arguments.stretch))),
        view_(view),
        feed_(feed),
        common_(common) {
    const auto most = static_cast<std::size_t>(60.0 * arguments.minutes / period);
    for (auto& list : ticks) list.reserve(most);
  }

  void begin(const RunParts& parts) override {
    view_.begin(parts);
    tick_ = 0;
    ++walk_;
  }
  RunOrder before_tick(double time) override {
    if (tick_ % length_ == 0) common_.pages = has_pages() ? clients_ : 0;
    return view_.before_tick(time);
  }
  UserCommand user(const UserCommand& planned) override {
    const UserCommand command = view_.user(planned);
    begun_ = thread_microseconds();
    return command;
  }
  void after_tick(const TickRecord& tick, const GroundTruth& truth,
                  const TickTiming& timing) override {
    const double cpu = thread_microseconds() - begun_;
    view_.after_tick(tick, truth, timing);
    if (tick_ % length_ >= settling_) count(timing.total, cpu);
    ++tick_;
  }
  void end(double time) override { view_.end(time); }

  std::array<std::vector<Tick>, 2> ticks;  // without pages, and with
  long unsettled = 0;                      // left out: not as many pages as there should be

 private:
  [[nodiscard]] bool has_pages() const { return (tick_ / length_ + walk_) % 2 == 0; }
  void count(double wall, double cpu) {
    if (feed_.watching != common_.pages) {
      ++unsettled;
      return;
    }
    const int pair = walk_ / 2 * in_walk_ + tick_ / length_;
    ticks[has_pages() ? 1 : 0].push_back({pair, static_cast<float>(wall), static_cast<float>(cpu)});
  }

  const int clients_, length_, settling_, in_walk_;
  LiveView& view_;
  const CountedFeed& feed_;
  Common& common_;
  int tick_ = 0, walk_ = -1;
  double begun_ = 0.0;
};

/// Times from the longest to the shortest, each with its pair of stretches.
class Ranking {
 public:
  Ranking(std::vector<Tick> ticks, float Tick::* time) : ticks_(std::move(ticks)), time_(time) {
    std::ranges::sort(ticks_, std::ranges::greater{}, time);
  }

  /// Where each pair of stretches counts as often as `weights` says.
  [[nodiscard]] double quantile(double share, const std::vector<int>& weights) const {
    long all = 0, passed = 0;
    for (const Tick& tick : ticks_) all += weights[static_cast<std::size_t>(tick.pair)];
    const double beyond = (1.0 - share) * static_cast<double>(all);
    for (const Tick& tick : ticks_) {
      passed += weights[static_cast<std::size_t>(tick.pair)];
      if (static_cast<double>(passed) > beyond) return tick.*time_;
    }
    return ticks_.back().*time_;
  }

 private:
  std::vector<Tick> ticks_;
  float Tick::* time_;
};

struct Ratio {
  double without = 0.0, with = 0.0;  // [µs]
  double low = 0.0, high = 0.0;      // of with / without, 95 %
  [[nodiscard]] double value() const { return with / without; }
};

Ratio compare(const std::array<std::vector<Tick>, 2>& ticks, float Tick::* time, double share) {
  const Ranking without(ticks[0], time), with(ticks[1], time);
  int pairs = 0;
  for (const auto& list : ticks) {
    for (const Tick& tick : list) pairs = std::max(pairs, tick.pair + 1);
  }
  const auto count = static_cast<std::size_t>(pairs);
  const std::vector<int> once(count, 1);
  std::mt19937 random(1);
  std::uniform_int_distribution<std::size_t> any(0, count - 1);
  std::vector<double> ratios;
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<int> weights(count, 0);
    for (int i = 0; i < pairs; ++i) ++weights[any(random)];
    ratios.push_back(with.quantile(share, weights) / without.quantile(share, weights));
  }
  std::ranges::sort(ratios);
  return {without.quantile(share, once), with.quantile(share, once),
          ratios[static_cast<std::size_t>(0.025 * kDraws)],
          ratios[static_cast<std::size_t>(0.975 * kDraws)]};
}

Ratio tell(const char* what, const Stretches& run, float Tick::* time, double share) {
  const Ratio ratio = compare(run.ticks, time, share);
  std::printf("%-10s %5.1f %%  %8.1f µs  %8.1f µs  %+6.1f %%  (95 %%: %+.1f to %+.1f %%)\n", what,
              100.0 * share, ratio.without, ratio.with, 100.0 * (ratio.value() - 1.0),
              100.0 * (ratio.low - 1.0), 100.0 * (ratio.high - 1.0));
  return ratio;
}

int report(const Stretches& run, const Arguments& arguments, double megabytes) {
  const std::size_t fewest = std::min(run.ticks[0].size(), run.ticks[1].size());
  std::printf(
      "%zu ticks without pages, %zu with %d; %ld left out, as pages came or went; the pages "
      "read %.0f MB\n\n",
      run.ticks[0].size(), run.ticks[1].size(), arguments.clients, run.unsettled, megabytes);
  if (fewest == 0) throw Error("there is nothing to compare; valid are more --minutes");
  std::printf("%17s  %11s  %11s\n", "", "alone", "watched");
  Ratio last;
  for (const double share : kShares) {
    (void)tell("processor", run, &Tick::cpu, share);
    last = tell("clock", run, &Tick::wall, share);
  }
  if ((1.0 - kShares.back()) * static_cast<double>(fewest) < kFewest) {
    std::printf("\nfewer than %d ticks lie beyond 99.9 %%: its interval is a guess\n", kFewest);
  }
  const char* verdict = last.high <= kAim ? "shown"
                        : last.low > kAim ? "refuted"
                                          : "neither shown nor refuted: the interval is too wide";
  std::printf("\nthat 99.9 %% by the clock are within +5 %%: %s\n", verdict);
  return last.high <= kAim ? 0 : 1;
}

int run(const Arguments& arguments) {
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  if (cores < 2) throw Error("the pages need a core of their own; this machine has one");
  Common& common = make_common();
  if (fork() == 0) {
    use_cores(1, cores - 1);
    watch(common);
  }
  use_cores(0, 1);
  const Scenario scenario =
      load_scenario({arguments.scenario, 0, {"duration=" + std::to_string(arguments.walk)}});
  LiveOperator wishes(scenario, ViewLimits());
  LiveFeed feed(scenario, wishes, "");
  CountedFeed counted(feed);
  LiveView view(wishes, feed, [] { return false; });
  Stretches stretches(arguments, scenario.controller.period, view, counted, common);
  std::optional<WebServer> server;
  ClosedLoopOptions options;
  options.steering = &stretches;
  options.ready = [&] {
    if (server) return;
    server.emplace(WebServerOptions{.max_clients = arguments.clients + 1}, counted);
    common.port = server->port();
  };
  std::array<double, 3> load{};
  getloadavg(load.data(), 3);
  const int walks = 2 * std::max(1, static_cast<int>(30.0 * arguments.minutes / arguments.walk));
  std::printf("%d walks of %g s, load %.1f before the first\n", walks, arguments.walk, load[0]);
  for (int walk = 0; walk < walks; ++walk) {
    const RunResult result = run_closed_loop(scenario, options);
    if (result.ending != Ending::finished)
      throw Error("a walk ended early: " + result.metrics.reason);
    std::fprintf(stderr, "walk %d of %d\n", walk + 1, walks);
  }
  common.pages = 0;
  server.reset();
  return report(stretches, arguments, 1e-6 * static_cast<double>(common.bytes));
}

}  // namespace
}  // namespace surefoot

int main(int argc, char** argv) {
  surefoot::Arguments arguments;
  CLI::App app("The controller's tick with many pages that watch, over the same tick with none.");
  app.add_option("--scenario", arguments.scenario, "a walk")->capture_default_str();
  app.add_option("--clients", arguments.clients,
                 "pages, of which one never reads; 0: what the comparison itself is worth")
      ->check(CLI::Range(0, 64))
      ->capture_default_str();
  app.add_option("--minutes", arguments.minutes, "in all")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--walk", arguments.walk, "length of a walk [s]")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--stretch", arguments.stretch, "length of a stretch with pages, or without [s]")
      ->check(CLI::Range(1.0, 10.0))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    return surefoot::run(arguments);
  } catch (const surefoot::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
