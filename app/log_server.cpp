#include "app/log_server.hpp"

#include "app/interrupt.hpp"
#include "app/log_content.hpp"

#include <chrono>
#include <cstdio>
#include <thread>

namespace surefoot {

void serve_log(const std::string& path, const ViewArguments& arguments) {
  watch_for_interrupt();
  LogContent content(path);
  const WebServer server({.listen = arguments.listen,
                          .port = static_cast<std::uint16_t>(arguments.port),
                          .token = arguments.token,
                          .max_clients = arguments.clients},
                         content);
  for (const std::string& note : content.notes()) {
    std::fprintf(stderr, "surefoot: warning: %s\n", note.c_str());
  }
  tell_link(server.link(), "^C     closes it");
  while (!interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
}

}  // namespace surefoot
