#include "app/live_run.hpp"

#include "app/live_view.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/view/web_server.hpp"

#include <cstdio>

namespace surefoot {

bool says_where(const ViewArguments& arguments) {
  const ViewArguments usual;
  return arguments.port != usual.port || !arguments.listen.empty() || !arguments.token.empty() ||
         arguments.clients != usual.clients;
}

void check(const ViewArguments& arguments) {
  if (says_where(arguments) && !arguments.view) {
    throw Error(
        "--port, --listen, --token and --view-clients belong to --view, which is not given");
  }
}

void tell_link(const std::string& link, const std::string& how_it_ends) {
  std::fprintf(stderr, "\n  open   %s\n  %s\n\n", link.c_str(), how_it_ends.c_str());
}

RunResult run_live(const Scenario& scenario, ClosedLoopOptions options,
                   const ViewArguments& arguments,
                   const std::function<void(const RunResult&)>& ended) {
  LiveOperator wishes(scenario, ViewLimits());
  LiveFeed feed(scenario, wishes, options.record_path);
  LiveView view(wishes, feed, options.interrupted);
  options.steering = &view;
  options.interrupted = {};  // asked by the view
  std::optional<WebServer> server;
  options.ready = [&] {
    if (server) return;
    server.emplace(WebServerOptions{.listen = arguments.listen,
                                    .port = static_cast<std::uint16_t>(arguments.port),
                                    .token = arguments.token,
                                    .max_clients = arguments.clients},
                   feed);
    tell_link(server->link(), "^C     ends the run");
  };
  while (true) {
    const RunResult result = run_closed_loop(scenario, options);
    if (result.ending == Ending::interrupted) return result;
    if (result.ending == Ending::reset) continue;
    ended(result);
    std::fprintf(stderr, "\n  the page stays open: reset begins the run again, ^C ends it\n\n");
    if (!view.wait_for_reset(result.metrics.reason)) return result;
  }
}

}  // namespace surefoot
