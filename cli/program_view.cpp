#include "cli/program_view.hpp"

#include <algorithm>
#include <charconv>

namespace surefoot::cli {

namespace {

bool is_digits(const std::string& text) {
  return !text.empty() &&
         std::ranges::all_of(text, [](char letter) { return letter >= '0' && letter <= '9'; });
}

/// Of digits; kNoMax + 1 if it is larger than kNoMax.
int value_of(const std::string& digits) {
  int value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return error == std::errc() ? std::min(value, kNoMax + 1) : kNoMax + 1;
}

}  // namespace

CLI::Validator whole_number(int min, int max, const char* largest) {
  const auto check = [min, max, largest](std::string& text) -> std::string {
    const int value = is_digits(text) ? value_of(text) : -1;
    if (value >= min && value <= max) return "";
    const std::string given = "\"" + text + "\" is ";
    if (max == kNoMax && value > max)
      return given + "above " + std::to_string(max) + ", " + largest;
    const std::string valid = max == kNoMax
                                  ? "of at least " + std::to_string(min)
                                  : "from " + std::to_string(min) + " to " + std::to_string(max);
    return given + "not a whole number " + valid;
  };
  return CLI::Validator(check, "");
}

static_assert(config::kLargestSeed == kNoMax);  // else the error for a larger seed is wrong

CLI::Validator seed_number() { return whole_number(0, config::kLargestSeed, "the largest seed"); }

void add_server(CLI::App& command, server::ViewArguments& view) {
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

void add_view(CLI::App& command, server::ViewArguments& view) {
  command.add_flag("--view", view.view,
                   "Run at real time and serve a page on this machine that shows it; ^C ends it");
  command.add_flag("--no-wait", view.no_wait,
                   "Begin at once and at real time; else the robot calibrates as fast as it can, "
                   "and walks once the page is open");
  add_server(command, view);
}

}  // namespace surefoot::cli
