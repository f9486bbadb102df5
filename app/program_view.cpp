#include "app/program_view.hpp"

#include <algorithm>

namespace surefoot {

CLI::Validator whole_number(int min, int max) {
  const auto check = [min, max](std::string& text) -> std::string {
    const bool digits =
        !text.empty() && text.size() < 10 &&
        std::ranges::all_of(text, [](char letter) { return letter >= '0' && letter <= '9'; });
    if (digits && std::stoi(text) >= min && std::stoi(text) <= max) return "";
    const std::string valid = max == kNoMax
                                  ? "of at least " + std::to_string(min)
                                  : "from " + std::to_string(min) + " to " + std::to_string(max);
    return "\"" + text + "\" is not a whole number " + valid;
  };
  return CLI::Validator(check, "");
}

void add_server(CLI::App& command, ViewArguments& view) {
  command.add_option("--port", view.port, "Port of the page; 0: any that is free")
      ->check(whole_number(0, 65535))
      ->capture_default_str();
  command.add_option("--listen", view.listen,
                     "Serve the page on this address of the machine, not on loopback alone; needs "
                     "--token");
  command.add_option("--token", view.token,
                     "Secret that commands from the page need; by default a random one");
  command.add_option("--view-clients", view.clients, "Pages that may watch at once, up to 64")
      ->check(whole_number(1, 64))
      ->capture_default_str();
}

void add_view(CLI::App& command, ViewArguments& view) {
  command.add_flag("--view", view.view,
                   "Run at real time and serve a page on this machine that shows it; ^C ends it");
  add_server(command, view);
}

}  // namespace surefoot
