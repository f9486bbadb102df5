#include "server/log_server.hpp"

#include "server/log_content.hpp"
#include "surefoot/base/printable.hpp"
#include "surefoot/runtime/interrupt.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>

namespace surefoot::server {

namespace {

constexpr std::size_t kMostPrinted = 10;

void warn(const std::string& text) {
  std::fprintf(stderr, "surefoot: warning: %s\n", printable(text).c_str());
}

/// Prints damage that was found since; `printed` pieces were printed before.
std::size_t print_damage(LogContent& content, std::size_t printed) {
  const std::vector<std::string> damage = content.damage();
  for (std::size_t i = printed; i < std::min(damage.size(), kMostPrinted); ++i) warn(damage[i]);
  if (printed <= kMostPrinted && damage.size() > kMostPrinted)
    warn("and more that can't be read: `surefoot info` names it all");
  return damage.size();
}

}  // namespace

void serve_log(const std::string& path, const ViewArguments& arguments) {
  runtime::watch_for_interrupt();
  LogContent content(path);
  const WebServer server(server_options(arguments), content);
  for (const std::string& note : content.notes()) warn(note);
  print_link(server.link(), "^C     closes it", arguments.listen);
  for (std::size_t printed = 0; !runtime::interrupted();) {
    printed = print_damage(content, printed);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

}  // namespace surefoot::server
