#pragma once

#include "surefoot/tasks/task_definition.hpp"

#include <algorithm>
#include <string_view>
#include <type_traits>
#include <utility>

namespace surefoot::tasks {

/// Writes the definition of a task T: binds the names of a stack file to members of T::Options,
/// which alone hold the defaults. T is made from its Options, or from nothing if it has none.
///
///     TaskEntry<LevelHead>("level_head", "the head stays level", "–", "rad/s²")
///         .number("kp", &LevelHead::Options::kp, "1/s²", "orientation gain")
///         .add_to(stack.own_tasks);
template <typename T>
class TaskEntry {
  struct NoOptions {};
  template <typename Of, typename = void>
  struct OptionsOf {
    using type = NoOptions;
  };
  template <typename Of>
  struct OptionsOf<Of, std::void_t<typename Of::Options>> {
    using type = typename Of::Options;
  };

 public:
  using Options = typename OptionsOf<T>::type;

  /// `unit` of the rows.
  TaskEntry(std::string_view name, std::string_view summary, std::string_view equation,
            std::string_view unit)
      : info_{.name = std::string(name),
              .summary = std::string(summary),
              .equation = std::string(equation),
              .unit = std::string(unit)} {}

  TaskEntry&& number(std::string_view name, double Options::* member, std::string_view unit,
                     std::string_view help, double minimum = 0.0) && {
    return std::move(*this).number_at(
        name, [member](Options& options) -> double& { return options.*member; }, unit, help,
        minimum);
  }

  /// The last number does not go with the robot's size as its unit says.
  TaskEntry&& sized(Sizing sizing) && {
    info_.parameters.back().sizing = sizing;
    return std::move(*this);
  }

  TaskEntry&& number_per_leg(std::string_view help, PerLeg<double> Options::* member,
                             const PerLeg<std::string_view>& names, std::string_view unit) && {
    for (std::size_t i = 0; i < names.size(); ++i) {
      (void)std::move(*this).number_at(
          names[i], [member, i](Options& options) -> double& { return (options.*member)[i]; }, unit,
          help, 0.0);
    }
    return std::move(*this);
  }

  /// `values` in the order of the enumerators.
  template <typename Enum>
  TaskEntry&& choice(std::string_view name, Enum Options::* member, std::vector<std::string> values,
                     std::string_view help) && {
    const std::string& standard = values[static_cast<std::size_t>(defaults_.*member)];
    info_.choices.push_back({std::string(name), values, standard, std::string(help)});
    set_choice_.emplace(name, [=](Options& options, const std::string& word) {
      options.*member = static_cast<Enum>(std::ranges::find(values, word) - values.begin());
    });
    return std::move(*this);
  }

  /// A name of the robot's, or one of `values`. `others`: what kind of name, for lists.
  TaskEntry&& text(std::string_view name, std::string Options::* member,
                   std::vector<std::string> values, std::string_view others,
                   std::string_view help) && {
    info_.choices.push_back({std::string(name), std::move(values), defaults_.*member,
                             std::string(help), std::string(others)});
    set_choice_.emplace(
        name, [member](Options& options, const std::string& word) { options.*member = word; });
    return std::move(*this);
  }

  template <typename Catalog>
  void add_to(Catalog& catalog) && {
    catalog.add({std::move(info_),
                 [set_number = std::move(set_number_), set_choice = std::move(set_choice_)](
                     const TaskParameters& given) -> std::unique_ptr<Task> {
                   Options options;
                   for (const auto& [name, value] : given.numbers)
                     set_number.at(name)(options, value);
                   for (const auto& [name, word] : given.choices)
                     set_choice.at(name)(options, word);
                   if constexpr (std::is_constructible_v<T, const Options&>) {
                     return std::make_unique<T>(options);
                   } else {
                     return std::make_unique<T>();
                   }
                 }});
  }

 private:
  template <typename Value>
  using Setters = std::map<std::string, std::function<void(Options&, const Value&)>>;

  template <typename Access>
  TaskEntry&& number_at(std::string_view name, Access access, std::string_view unit,
                        std::string_view help, double minimum) && {
    info_.parameters.push_back({.name = std::string(name),
                                .default_value = access(defaults_),
                                .minimum = minimum,
                                .unit = std::string(unit),
                                .help = std::string(help)});
    set_number_.emplace(name,
                        [=](Options& options, const double& value) { access(options) = value; });
    return std::move(*this);
  }

  TaskInfo info_;
  Options defaults_;
  Setters<double> set_number_;
  Setters<std::string> set_choice_;
};

}  // namespace surefoot::tasks
