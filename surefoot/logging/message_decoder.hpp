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
/// value and unknown ones are skipped, so that logs of other minor versions are readable. Lists per
/// leg get the robot's size. Throws JsonError for anything else.
class Decoder {
 public:
  template <typename T>
  static void decode(std::string_view message, T& signal, int num_legs = kNumLegs) {
    logging::JsonCursor json(message);
    Decoder(json, num_legs).value(signal);
  }

  /// Called by `fields` for each member.
  template <typename T>
  void operator()(std::string_view name, T& content, std::string_view) {
    if (find(name) || find(name_before_3(name))) {
      value(content);
      next_ = json_.position();
    }
  }
  /// Logs before 2.12 have one event a tick, without its leg.
  void operator()(std::string_view name, EventList& events, std::string_view) {
    events = {};
    const bool is_list = find(name);
    if (!is_list && !find("event")) return;
    std::vector<GaitEvent> read(is_list ? 0 : 1);
    is_list ? value(read) : value(read.front().kind);
    for (const GaitEvent& event : read) events.add(event);
    next_ = json_.position();
  }
  void operator()(std::string_view name, FrameList& frames, std::string_view description) {
    std::vector<FramePlan> read;
    (*this)(name, read, description);
    frames = {};
    for (const FramePlan& plan : read) frames.add(plan);
  }

 private:
  // Of an object, `json` is after its opening brace.
  Decoder(logging::JsonCursor& json, int num_legs)
      : json_(json), num_legs_(num_legs), first_(json.position()), next_(json.position()) {}

  // Goes to a member's value, most likely the next one.
  bool find(std::string_view name) {
    json_.go_to(next_);
    if (find_before_end(name)) return true;
    json_.go_to(first_);
    return find_before_end(name);
  }

  /// Logs before 3.0 call the simulator's world W, too: p_SB is p_WB in them.
  static std::string name_before_3(std::string_view name) {
    std::string old(name);
    if (old.size() > 2 && old[1] == '_' && old[2] == 'S') old[2] = 'W';
    return old;
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
  void value(T& content) {
    if constexpr (std::same_as<T, bool>) {
      content = json_.truth();
    } else if constexpr (std::integral<T>) {
      content = integer<T>(json_.number());
    } else if constexpr (Number<T>) {
      content = json_.number();
    } else if constexpr (std::same_as<T, std::string>) {
      content = json_.string();
    } else if constexpr (Name<T>) {
      content = enumerator(json_.string(), content);
    } else if constexpr (std::same_as<T, PlanEvent>) {
      content = static_cast<PlanEvent>(integer<int>(json_.number()));
    } else if constexpr (OptionalLeg<T>) {
      content = leg();
    } else if constexpr (std::same_as<T, Quat>) {
      Eigen::Vector4d wxyz;
      value(wxyz);
      content = Quat(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
    } else if constexpr (Matrix<T>) {
      matrix(content);
    } else if constexpr (kIsPerLeg<T>) {
      json_.expect('{');
      Decoder decoder(json_, num_legs_);
      if (std::ssize(content) != num_legs_) content = T(num_legs_, content[0]);
      for (const Leg leg : content.legs())
        decoder(leg_name(leg, num_legs_), content[index(leg)], "");
      decoder.leave();
    } else if constexpr (kIsList<T>) {
      list(content);
    } else {
      json_.expect('{');
      Decoder decoder(json_, num_legs_);
      fields(decoder, content);
      decoder.leave();
    }
  }

  template <typename T>
  void matrix(T& content) {
    json_.expect('[');
    if constexpr (T::RowsAtCompileTime == Eigen::Dynamic) {
      joints(content);
      return;
    }
    for (Eigen::Index i = 0; i < content.rows(); ++i) {
      if (i > 0) json_.expect(',');
      if constexpr (T::ColsAtCompileTime == 1) {
        content[i] = json_.number();
      } else {
        Eigen::Vector<double, T::ColsAtCompileTime> row;
        matrix(row);
        content.row(i) = row;
      }
    }
    json_.expect(']');
  }

  void joints(JointVector& content) {
    content.resize(0);
    if (json_.accept(']')) return;
    do {
      if (content.size() == kMaxJoints) throw logging::JsonError{"expected fewer joints"};
      content.conservativeResize(content.size() + 1);
      content[content.size() - 1] = json_.number();
    } while (json_.accept(','));
    json_.expect(']');
  }

  template <typename T>
  void list(T& content) {
    content.clear();
    json_.expect('[');
    if (json_.accept(']')) return;
    do {
      value(content.emplace_back());
    } while (json_.accept(','));
    json_.expect(']');
  }

  std::optional<Leg> leg() {
    if (json_.peek() == 'n') {
      static_cast<void>(json_.number());
      return {};
    }
    const std::string name = json_.string();
    const auto names = leg_names(num_legs_);
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) throw logging::JsonError{"unknown leg \"" + name + "\""};
    return static_cast<Leg>(found - names.begin());
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
  int num_legs_;
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
