#pragma once

#include "surefoot/logging/message_codec.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::server {

/// A field of the log in a frame: `size` floats from `offset` on.
struct ViewChannel {
  std::string name;                 ///< "plan.feet.LF.p_WF"
  std::string unit, about;          ///< as the log describes it
  std::vector<std::string> labels;  ///< of the numbers; empty where there is one
  std::vector<std::string> values;  ///< names of the number's values 0, 1, …; empty: a quantity
  std::size_t offset = 0, size = 1;
};

/// All channels of a run, in the order of a frame's floats, made from the log's `fields`.
struct ViewChannels {
  int num_legs = kNumLegs;
  std::vector<std::string> level_names;  ///< of the hierarchy: each level has its channels
  std::vector<double> level_visible;     ///< of these levels, see `visible_residual`
  double least_load = 0.0;               ///< see LogRobot [N]
  std::vector<std::string> joint_names =
      std::vector<std::string>(kNumLegJoints);  ///< as in messages
  std::vector<ViewChannel> channels;
  std::vector<std::size_t> list_sizes;  ///< of lists of numbers, in order
  std::size_t floats = 0;               ///< of a frame
};

}  // namespace surefoot::server

namespace surefoot::logged {

/// Lists whose elements are found by the name of their level.
template <typename T>
inline constexpr bool kIsByLevel =
    std::same_as<T, std::vector<Level>> || std::same_as<T, std::vector<LevelTime>>;

/// A level that a tick lacks.
template <typename OfLevel>
[[nodiscard]] OfLevel unknown() {
  return {};
}
template <>
[[nodiscard]] inline Level unknown() {
  return {.name = "", .report = {.residual = kNaN, .degrees_of_freedom_left = -1, .iterations = 0}};
}

/// Appends the channels of a signal to a table, by `fields`. The signal's time and lists of rows
/// are no channels: a frame has them separately.
class ChannelLister {
 public:
  explicit ChannelLister(server::ViewChannels& table) : table_(table) {}

  /// `example` has the sizes of its lists.
  template <typename T>
  void add(std::string_view topic, const T& example) {
    name_ = topic;
    fields(*this, example);
  }

  template <typename T>
  void operator()(std::string_view name, const T& content, std::string_view about) {
    if (name != "time") below(name, content, about);
  }

 private:
  template <typename T>
  void below(std::string_view name, const T& content, std::string_view about) {
    const std::string outer = name_;
    name_ += "." + std::string(name);
    value(content, about);
    name_ = outer;
  }

  template <typename T>
  void value(const T& content, std::string_view about) {
    if constexpr (Number<T>) {
      add_channel(about, {});
    } else if constexpr (Name<T>) {
      add_channel(about, {});
      for (const std::string_view name : names(content)) {
        table_.channels.back().values.emplace_back(name);
      }
    } else if constexpr (std::same_as<T, Quat>) {
      add_channel(about, {"w", "x", "y", "z"});
    } else if constexpr (std::same_as<T, JointVector>) {
      add_channel(about, labels(num_joints(), 1));
    } else if constexpr (Matrix<T>) {
      add_channel(about,
                  labels(static_cast<int>(content.rows()), static_cast<int>(content.cols())));
    } else if constexpr (kIsPerLeg<T>) {
      for (const Leg leg : first_legs(table_.num_legs))
        below(leg_name(leg, table_.num_legs), content[index(leg)], about);
    } else if constexpr (kIsByLevel<T>) {
      levels<typename T::value_type>();
    } else if constexpr (std::same_as<T, std::vector<double>>) {
      table_.list_sizes.push_back(content.size());
      if (!content.empty()) add_channel(about, labels(static_cast<int>(content.size()), 1));
    } else if constexpr (!kIsList<T> && !std::same_as<T, std::string>) {
      fields(*this, content);
    }
  }

  template <typename OfLevel>
  void levels() {
    const std::string outer = name_.substr(0, name_.rfind('.'));
    for (const std::string& level : table_.level_names) {
      name_ = outer + ".level." + level;
      const OfLevel example{};
      fields(*this, example);
    }
  }
  void add_channel(std::string_view about, std::vector<std::string> labels);
  [[nodiscard]] std::vector<std::string> labels(int rows, int columns) const;
  [[nodiscard]] int num_joints() const { return static_cast<int>(table_.joint_names.size()); }

  server::ViewChannels& table_;
  std::string name_;
};

/// Writes the floats of a signal in the order of its channels.
class ChannelWriter {
 public:
  /// `floats` has room for all of the table's.
  ChannelWriter(const server::ViewChannels& table, std::span<float> floats)
      : table_(table), floats_(floats) {}

  template <typename T>
  void add(const T& signal) {
    fields(*this, signal);
  }

  template <typename T>
  void operator()(std::string_view name, const T& content, std::string_view) {
    if (name != "time") value(content);
  }

 private:
  template <typename T>
  void value(const T& content) {
    if constexpr (Number<T>) {
      put(static_cast<float>(content));
    } else if constexpr (Name<T>) {
      put(static_cast<float>(static_cast<int>(content)));
    } else if constexpr (std::same_as<T, Quat>) {
      for (const double number : {content.w(), content.x(), content.y(), content.z()})
        value(number);
    } else if constexpr (std::same_as<T, JointVector>) {  // a plan may have none
      const auto size = std::ssize(table_.joint_names);
      for (Eigen::Index i = 0; i < size; ++i) value(i < content.size() ? content[i] : kNaN);
    } else if constexpr (Matrix<T>) {
      for (Eigen::Index i = 0; i < content.rows(); ++i) {
        for (Eigen::Index j = 0; j < content.cols(); ++j) value(content(i, j));
      }
    } else if constexpr (kIsPerLeg<T>) {
      for (const Leg leg : first_legs(table_.num_legs)) value(content[index(leg)]);
    } else if constexpr (kIsByLevel<T>) {
      levels(content);
    } else if constexpr (std::same_as<T, std::vector<double>>) {
      const std::size_t size = table_.list_sizes[next_list_++];
      for (std::size_t i = 0; i < size; ++i) value(i < content.size() ? content[i] : kNaN);
    } else if constexpr (!kIsList<T> && !std::same_as<T, std::string>) {
      fields(*this, content);
    }
  }

  void put(float number) {
    if (next_ < floats_.size()) floats_[next_++] = number;
  }
  template <typename OfLevel>
  void levels(const std::vector<OfLevel>& levels) {
    for (const std::string& name : table_.level_names) {
      const auto found = std::ranges::find(levels, name, &OfLevel::name);
      fields(*this, found == levels.end() ? unknown<OfLevel>() : *found);
    }
  }

  const server::ViewChannels& table_;
  std::span<float> floats_;
  std::size_t next_ = 0, next_list_ = 0;
};

}  // namespace surefoot::logged

namespace surefoot::server {

/// The channels' descriptions as a JSON array, for the session.
[[nodiscard]] std::string to_json(const std::vector<ViewChannel>& channels);

}  // namespace surefoot::server
