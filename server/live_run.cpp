#include "server/live_run.hpp"

#include "server/live_view.hpp"
#include "server/view_robot.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/base/printable.hpp"
#include "surefoot/logging/output_files.hpp"
#include "surefoot/logging/recorder.hpp"

#include <algorithm>
#include <cstdio>

namespace surefoot::server {

bool says_where(const ViewArguments& arguments) {
  const ViewArguments usual;
  return arguments.port != usual.port || !arguments.listen.empty() || !arguments.token.empty() ||
         arguments.clients != usual.clients || arguments.no_wait;
}

void check(const ViewArguments& arguments) {
  if (says_where(arguments) && !arguments.view) {
    throw Error(
        "--port, --listen, --token, --view-clients and --no-wait belong to --view, which is not "
        "given");
  }
}

WebServerOptions server_options(const ViewArguments& arguments) {
  return {.listen = arguments.listen,
          .port = static_cast<std::uint16_t>(arguments.port),
          .token = arguments.token,
          .max_clients = arguments.clients};
}

void print_link(const std::string& link, const std::string& how_it_ends,
                const std::string& listen) {
  std::fprintf(stderr, "\n  open   %s\n  %s\n\n", link.c_str(), how_it_ends.c_str());
  if (listen.empty() || listen.starts_with("127.") || listen == "::1") return;
  std::fprintf(stderr,
               "surefoot: warning: --listen %s: everyone who can reach this address can watch, and "
               "who has the whole link, with its token, can command; nothing is encrypted\n\n",
               listen.c_str());
}

namespace {

constexpr const char* kWaits =
    "\n  waits for the page: the robot calibrates, and walks once the link is open (--no-wait: at "
    "once)";

/// Of its gaits by a clock; 0 without one [m/s].
double fastest(const control::ControllerOptions& controller) {
  const gaits::RhythmOptions& own = controller.planner.rhythm;
  double speed = own.enabled ? own.speed_max : 0.0;
  for (const gaits::NamedGait& gait : controller.gaits) {
    const gaits::RhythmOptions& rhythm = gait.options.rhythm;
    if (rhythm.enabled) speed = std::max(speed, rhythm.speed_max);
  }
  return speed;
}

/// Says that the log before a reset is kept.
void print_kept(const LiveResult& before, const std::string& next) {
  const bool is_cut = before.run.ending == closed_loop::Ending::reset;
  const std::string kept = is_cut ? logging::partial_path(before.record_path) : before.record_path;
  std::fprintf(stderr, "  the log of the run before the reset is %s; the next goes into %s\n",
               kept.c_str(), next.c_str());
}

}  // namespace

LiveResult run_live(const config::Scenario& scenario, closed_loop::ClosedLoopOptions options,
                    const ViewArguments& arguments,
                    const std::function<void(const closed_loop::RunResult&)>& ended) {
  LiveOperator wishes(scenario, limits_for(scenario.robot.scale, fastest(scenario.controller)));
  LiveFeed feed(scenario, wishes, options.record_path);
  LiveView view(wishes, feed, options.interrupted, !arguments.no_wait);
  options.steering = &view;
  options.interrupted = {};  // the view asks
  std::optional<WebServer> server;
  options.ready = [&] {
    if (server) return;
    server.emplace(server_options(arguments), feed);
    const std::string missing = missing_meshes_text(feed.meshes());
    if (!missing.empty())
      std::fprintf(stderr, "surefoot: warning: %s\n", printable(missing).c_str());
    print_link(server->link(),
               std::string("^C     ends the run") + (arguments.no_wait ? "" : kWaits),
               arguments.listen);
  };
  const std::string first_log = options.record_path;
  while (true) {
    const closed_loop::RunResult result = closed_loop::run_closed_loop(scenario, options);
    if (result.ending == closed_loop::Ending::interrupted) return {result, options.record_path};
    if (result.ending != closed_loop::Ending::reset) {
      ended(result);
      std::fprintf(stderr, "\n  the page stays open: reset begins the run again, ^C ends it\n\n");
      if (!view.wait_for_reset(result.metrics.reason)) return {result, options.record_path};
    }
    if (first_log.empty()) continue;
    const LiveResult before{result, options.record_path};
    options.record_path = logging::next_free_log(first_log);
    print_kept(before, options.record_path);
    feed.set_recording(options.record_path);
  }
}

}  // namespace surefoot::server
