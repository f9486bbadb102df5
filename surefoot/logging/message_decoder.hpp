#pragma once

#include "surefoot/logging/json_cursor.hpp"
#include "surefoot/logging/message_codec.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::logged {

/// Reads a signal from its JSON message, by `fields`. Members missing in the message keep their
/// value and unknown ones are skipped, so that logs of other minor versions are readable. Throws
/// JsonError for anything else.
class Decoder {
 public:
  template <typename T>
  static void decode(std::string_view message, T& signal) {
    logging::JsonCursor json(message);
    value(json, signal);
  }

  /// Called by `fields` for each member.
  template <typename T>
  void operator()(std::string_view name, T& content, std::string_view) {
    if (find(name)) {
      value(json_, content);
      next_ = json_.position();
    }
  }
  /// Logs before 2.12 have one event a tick, without its leg.
  void operator()(std::string_view name, EventList& events, std::string_view) {
    events = {};
    const bool is_list = find(name);
    if (!is_list && !find("event")) return;
    std::vector<GaitEvent> read(is_list ? 0 : 1);
    is_list ? value(json_, read) : value(json_, read.front().kind);
    for (const GaitEvent& event : read) events.add(event);
    next_ = json_.position();
  }

 private:
  // `json` is after the opening brace.
  explicit Decoder(logging::JsonCursor& json)
      : json_(json), first_(json.position()), next_(json.position()) {}

  // Goes to a member's value, most likely the next one.
  bool find(std::string_view name) {
    json_.go_to(next_);
    if (find_before_end(name)) return true;
    json_.go_to(first_);
    return find_before_end(name);
  }

  bool find_before_end(std::string_view name) {
    while (true) {
      static_cast<void>(json_.accept(','));
      if (json_.peek() == '}') return false;
      if (json_.key() == name) return true;
      json_.skip();
    }
  }

  void leave() {
    json_.go_to(next_);
    while (!json_.accept('}')) {
      static_cast<void>(json_.accept(','));
      if (json_.peek() == '}') continue;
      static_cast<void>(json_.key());
      json_.skip();
    }
  }

  template <typename T>
  static void value(logging::JsonCursor& json, T& content) {
    if constexpr (std::same_as<T, bool>) {
      content = json.truth();
    } else if constexpr (std::integral<T>) {
      content = integer<T>(json.number());
    } else if constexpr (Number<T>) {
      content = json.number();
    } else if constexpr (std::same_as<T, std::string>) {
      content = json.string();
    } else if constexpr (Name<T>) {
      content = enumerator(json.string(), content);
    } else if constexpr (std::same_as<T, PlanEvent>) {
      content = static_cast<PlanEvent>(integer<int>(json.number()));
    } else if constexpr (OptionalLeg<T>) {
      content = leg(json);
    } else if constexpr (std::same_as<T, Quat>) {
      Eigen::Vector4d wxyz;
      value(json, wxyz);
      content = Quat(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
    } else if constexpr (Matrix<T>) {
      matrix(json, content);
    } else if constexpr (kIsPerLeg<T>) {
      json.expect('{');
      Decoder decoder(json);
      for (const Leg leg : kLegs) decoder(kLegNames[index(leg)], content[index(leg)], "");
      decoder.leave();
    } else if constexpr (kIsList<T>) {
      list(json, content);
    } else {
      json.expect('{');
      Decoder decoder(json);
      fields(decoder, content);
      decoder.leave();
    }
  }

  template <typename T>
  static void matrix(logging::JsonCursor& json, T& content) {
    json.expect('[');
    if constexpr (T::RowsAtCompileTime == Eigen::Dynamic) {
      joints(json, content);
      return;
    }
    for (Eigen::Index i = 0; i < content.rows(); ++i) {
      if (i > 0) json.expect(',');
      if constexpr (T::ColsAtCompileTime == 1) {
        content[i] = json.number();
      } else {
        Eigen::Vector<double, T::ColsAtCompileTime> row;
        matrix(json, row);
        content.row(i) = row;
      }
    }
    json.expect(']');
  }

  static void joints(logging::JsonCursor& json, JointVector& content) {
    content.resize(0);
    do {
      if (content.size() == kMaxJoints) throw logging::JsonError{"expected fewer joints"};
      content.conservativeResize(content.size() + 1);
      content[content.size() - 1] = json.number();
    } while (json.accept(','));
    json.expect(']');
  }

  template <typename T>
  static void list(logging::JsonCursor& json, T& content) {
    content.clear();
    json.expect('[');
    if (json.accept(']')) return;
    do {
      value(json, content.emplace_back());
    } while (json.accept(','));
    json.expect(']');
  }

  static std::optional<Leg> leg(logging::JsonCursor& json) {
    if (json.peek() == 'n') {
      static_cast<void>(json.number());
      return {};
    }
    const std::string name = json.string();
    const auto found = std::ranges::find(kLegNames, name);
    if (found == kLegNames.end()) throw logging::JsonError{"unknown leg \"" + name + "\""};
    return static_cast<Leg>(found - kLegNames.begin());
  }

  template <typename T>
  static T integer(double number) {
    const bool fits = number >= static_cast<double>(std::numeric_limits<T>::min()) &&
                      number <= static_cast<double>(std::numeric_limits<T>::max());
    if (!fits) throw logging::JsonError{"expected an integer"};
    return static_cast<T>(number);
  }

  template <typename T>
  static T enumerator(const std::string& name, T any) {
    const auto& all = names(any);
    const auto found = std::find(all.begin(), all.end(), name);
    if (found == all.end()) throw logging::JsonError{"unknown value \"" + name + "\""};
    return static_cast<T>(found - all.begin());
  }

  logging::JsonCursor& json_;
  std::size_t first_, next_;  // after the opening brace, and after the last member read
};

/// Throws JsonError unless all of a signal's joint vectors have this size.
template <typename Signal>
void check_joints(const Signal& signal, std::size_t num_joints) {
  const auto check = [num_joints](const JointVector& values) {
    if (static_cast<std::size_t>(values.size()) != num_joints)
      throw logging::JsonError{"expected a number for each of " + std::to_string(num_joints) +
                               " joints"};
  };
  if constexpr (requires { signal.q; }) check(signal.q);
  if constexpr (requires { signal.qd; }) check(signal.qd);
  if constexpr (requires { signal.torque; }) check(signal.torque);
}

}  // namespace surefoot::logged
