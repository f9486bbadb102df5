// Whether pages that watch a run delay its control loop: the controller's tick with many pages, one
// of which never reads, over the same tick with none.
//
// One process makes the same walk at real time again and again, in short stretches with pages and
// without by turns; every second walk has them the other way round. So each tick is measured with
// and without pages, with the same numbers in it, within a minute of the same machine. Two ratios
// are told: of the quantiles of all ticks, which have in them what else the machine does; and of
// those of the walk's ticks, each as long as its median over all walks, with how many ticks were
// later than that, so that what pages cost is seen on machines that are shared with others.
//
// The program, its server's thread included, has the first core, the pages have the others: what is
// told is what serving costs the loop, not what browsers cost. The time by the clock has in it
// whatever takes the core from the tick; the time of the processor that the tick's thread had has
// caches and memory alone.

#include "benchmarks/live_clients/paired_ticks.hpp"
#include "server/live_feed.hpp"
#include "server/live_view.hpp"
#include "server/web_server.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/closed_loop/closed_loop.hpp"
#include "surefoot/config/scenario_file.hpp"

#include <CLI/CLI.hpp>
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sched.h>
#include <sys/epoll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
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
constexpr double kAim = 1.05;  // of the ratio at 99.9 %
constexpr std::array kShares{0.5, 0.99, 0.999};
constexpr std::array kDelays{50.0F, 200.0F, 1000.0F};  // [µs]

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
class CountedFeed final : public server::WebContent {
 public:
  explicit CountedFeed(server::LiveFeed& feed) : feed_(feed) {}
  server::WebAnswer get(std::string_view path, const Query& query) override {
    return feed_.get(path, query);
  }
  [[nodiscard]] bool is_live() const override { return true; }
  std::vector<server::SharedBlock> welcome() override { return feed_.welcome(); }
  std::vector<server::SharedBlock> blocks() override { return feed_.blocks(); }
  std::vector<std::string> messages(std::size_t clients) override {
    watching = static_cast<int>(clients);
    return feed_.messages(clients);
  }
  std::string status(std::size_t clients) override { return feed_.status(clients); }

  std::atomic<int> watching{0};

 private:
  server::LiveFeed& feed_;
};

/// How often others took the processor from the calling thread.
long interruptions() {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_nivcsw;
}

double thread_microseconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e6 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_nsec);
}

/// Steers walks as a live view does, asks for pages and for none by turns, and times the ticks.
class Stretches final : public closed_loop::RunSteering {
 public:
  Stretches(const Arguments& arguments, double period, server::LiveView& view,
            const CountedFeed& feed, Common& common)
      : clients_(arguments.clients),
        length_(static_cast<int>(arguments.stretch / period)),
        settling_(static_cast<int>(arguments.settling / period)),
        view_(view),
        feed_(feed),
        common_(common) {
    const auto most = static_cast<std::size_t>(60.0 * arguments.minutes / period);
    for (auto& list : ticks) list.reserve(most);
  }

  void begin(const closed_loop::RunParts& parts) override {
    view_.begin(parts);
    tick_ = 0;
    ++walk_;
  }
  closed_loop::RunOrder before_tick(double time) override {
    if (tick_ % length_ == 0) common_.pages = has_pages() ? clients_ : 0;
    return view_.before_tick(time);
  }
  UserCommand user(const UserCommand& planned) override {
    const UserCommand command = view_.user(planned);
    interruptions_ = interruptions();
    begun_ = thread_microseconds();
    return command;
  }
  void after_tick(const TickRecord& tick, const simulation::GroundTruth& truth,
                  const TickTiming& timing) override {
    const double cpu = thread_microseconds() - begun_;
    const bool interrupted = interruptions() > interruptions_;
    view_.after_tick(tick, truth, timing);
    if (tick_ % length_ >= settling_) {
      count({tick_, walk_ / 2, static_cast<float>(timing.total), static_cast<float>(cpu),
             interrupted});
    }
    ++tick_;
  }

  TickPairs ticks;     // without pages, and with
  long unsettled = 0;  // left out: not as many pages as there should be

 private:
  [[nodiscard]] bool has_pages() const { return (tick_ / length_ + walk_) % 2 == 0; }
  void count(const TimedTick& tick) {
    if (feed_.watching != common_.pages) {
      ++unsettled;
    } else {
      ticks[has_pages() ? 1 : 0].push_back(tick);
    }
  }

  const int clients_, length_, settling_;
  server::LiveView& view_;
  const CountedFeed& feed_;
  Common& common_;
  int tick_ = 0, walk_ = -1;
  double begun_ = 0.0;
  long interruptions_ = 0;
};

void tell(const char* what, double share, const QuantileRatio& ratio) {
  std::printf("  %-10s %5.1f %%  %8.1f µs  %8.1f µs  %+6.1f %%  (95 %%: %+.1f to %+.1f %%)\n", what,
              100.0 * share, ratio.without, ratio.with, 100.0 * (ratio.value() - 1.0),
              100.0 * (ratio.low - 1.0), 100.0 * (ratio.high - 1.0));
}

void tell(const std::string& what, const std::array<double, 2>& shares) {
  std::printf("  %-18s  %8.0f     %8.0f\n", what.c_str(), shares[0], shares[1]);
}

const char* verdict(const QuantileRatio& last) {
  return last.high <= kAim ? "shown"
         : last.low > kAim ? "refuted"
                           : "neither shown nor refuted: the interval is too wide";
}

int report(const Stretches& run, const Arguments& arguments, int stretch, double megabytes) {
  const std::size_t fewest = std::min(run.ticks[0].size(), run.ticks[1].size());
  std::printf(
      "%zu ticks without pages, %zu with %d; %ld left out, as pages came or went; the pages "
      "read %.0f MB\n\n",
      run.ticks[0].size(), run.ticks[1].size(), arguments.clients, run.unsettled, megabytes);
  if (fewest == 0) throw Error("there is nothing to compare; valid are more --minutes");
  std::printf("%17s     %11s  %11s\nall ticks\n", "", "alone", "watched");
  QuantileRatio all, typical;
  for (const double share : kShares) {
    tell("processor", share, compare_all(run.ticks, &TimedTick::cpu, share, stretch));
    tell("clock", share, all = compare_all(run.ticks, &TimedTick::wall, share, stretch));
  }
  std::printf("the walk's ticks, each its median over the walks\n");
  for (const double share : kShares) {
    tell("processor", share, compare_typical(run.ticks, &TimedTick::cpu, share));
    tell("clock", share, typical = compare_typical(run.ticks, &TimedTick::wall, share));
  }
  std::printf("of a million ticks\n");
  for (const float delay : kDelays) {
    tell("later by " + std::to_string(static_cast<int>(delay)) + " µs",
         late_per_million(run.ticks, delay));
  }
  tell("interrupted", interrupted_per_million(run.ticks));
  if ((1.0 - kShares.back()) * static_cast<double>(fewest) < kFewest) {
    std::printf("\nfewer than %d ticks lie beyond 99.9 %%: the interval of all ticks is a guess\n",
                kFewest);
  }
  std::printf(
      "\nthat 99.9 %% by the clock are within +5 %%\n  of all ticks: %s\n  of the walk's: %s\n",
      verdict(all), verdict(typical));
  return all.high <= kAim && typical.high <= kAim ? 0 : 1;
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
  const config::Scenario scenario = config::load_scenario(
      {arguments.scenario, 0, {"duration=" + std::to_string(arguments.walk)}});
  server::LiveOperator wishes(scenario, server::ViewLimits());
  server::LiveFeed feed(scenario, wishes, "");
  CountedFeed counted(feed);
  server::LiveView view(wishes, feed, [] { return false; });
  Stretches stretches(arguments, scenario.controller.period, view, counted, common);
  std::optional<server::WebServer> server;
  closed_loop::ClosedLoopOptions options;
  options.steering = &stretches;
  options.ready = [&] {
    if (server) return;
    server.emplace(server::WebServerOptions{.max_clients = arguments.clients + 1}, counted);
    common.port = server->port();
  };
  std::array<double, 3> load{};
  getloadavg(load.data(), 3);
  const int walks = 2 * std::max(1, static_cast<int>(30.0 * arguments.minutes / arguments.walk));
  std::printf("%d walks of %g s, load %.1f before the first\n", walks, arguments.walk, load[0]);
  for (int walk = 0; walk < walks; ++walk) {
    const closed_loop::RunResult result = closed_loop::run_closed_loop(scenario, options);
    if (result.ending != closed_loop::Ending::finished)
      throw Error("a walk ended early: " + result.metrics.reason);
    std::fprintf(stderr, "walk %d of %d\n", walk + 1, walks);
  }
  common.pages = 0;
  server.reset();
  return report(stretches, arguments,
                static_cast<int>(arguments.stretch / scenario.controller.period),
                1e-6 * static_cast<double>(common.bytes));
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
