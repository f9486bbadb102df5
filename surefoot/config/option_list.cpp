#include "surefoot/config/option_list.hpp"

#include "surefoot/base/formatted.hpp"
#include "surefoot/config/scaling.hpp"
#include "surefoot/config/scenario_fields.hpp"
#include "surefoot/tasks/catalog.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::config {
namespace {

constexpr const char* kNone = "–";

template <typename Texts>
std::string joined(const Texts& texts, const char* between) {
  std::string all;
  for (const auto& text : texts) all += (all.empty() ? "" : between) + std::string(text);
  return all;
}

std::string number(double value) { return std::isfinite(value) ? formatted("%g", value) : kNone; }

/// The default of an option.
struct DefaultText {
  std::string operator()(double* value) const { return number(*value); }
  std::string operator()(int* value) const { return std::to_string(*value); }
  std::string operator()(std::uint64_t* value) const { return std::to_string(*value); }
  std::string operator()(bool* value) const { return *value ? "true" : "false"; }
  std::string operator()(std::string* value) const { return value->empty() ? kNone : *value; }
  std::string operator()(const Choice& choice) const {
    return choice.given < choice.names.size() ? choice.names[choice.given] : kNone;
  }
  std::string operator()(const Numbers& numbers) const {
    const std::vector<double> all(numbers.data, numbers.data + numbers.names.size());
    if (std::ranges::any_of(all, [](double value) { return std::isnan(value); })) return kNone;
    if (std::ranges::count(all, all.front()) == std::ssize(all))
      return formatted("%zu × %g", all.size(), all.front());
    std::vector<std::string> texts;
    for (const double value : all) texts.push_back(number(value));
    return joined(texts, ", ");
  }
  std::string operator()(const Order& order) const {
    std::vector<std::string> names;
    for (const std::size_t place : order.given) names.push_back(order.names[place]);
    return joined(names, ", ");
  }
  template <typename Value>
  std::string operator()(const Value& /*value*/) const {
    return kNone;
  }
};

std::string range_of(const Field& field) {
  if (const auto* choice = std::get_if<Choice>(&field.value)) return joined(choice->names, " | ");
  if (std::holds_alternative<bool*>(field.value)) return "true | false";
  return text_of(field.range);
}

void add_tasks(std::vector<OptionRow>& rows, const Scale& scale, const tasks::OwnTasks& own) {
  for (const tasks::TaskInfo& task : tasks::task_infos(own)) {
    const std::string path = "tasks." + std::string(task.name) + ".";
    const Scale as_given, &used = own.find(task.name) == nullptr ? scale : as_given;
    for (const tasks::TaskParameter& one : task.parameters) {
      rows.push_back({path + std::string(one.name), number(default_of(one, used)),
                      std::string(one.unit == kNone ? "" : one.unit),
                      formatted("≥ %g", one.minimum), std::string(one.help)});
    }
    for (const tasks::TaskChoice& one : task.choices) {
      rows.push_back({path + std::string(one.name), std::string(one.default_value), "",
                      joined(words_of(one), " | "), std::string(one.help)});
    }
  }
}

}  // namespace

void for_each_option(const Group& group,
                     const std::function<void(const std::string&, const Field&)>& visit,
                     const std::string& prefix) {
  for (const Field& field : group.fields) {
    const std::string path = prefix + field.key;
    if (const auto* below = std::get_if<Group>(&field.value)) {
      for_each_option(*below, visit, path + ".");
    } else if (const auto* entries = std::get_if<Entries>(&field.value)) {
      for (const Entries::Shape& shape : entries->shapes) {
        const std::string name = *shape.name == '\0' ? "name" : shape.name;
        for_each_option(shape.add(), visit,
                        path + (entries->of_list == nullptr ? ".<" + name + ">." : "[]."));
      }
    } else {
      visit(path, field);
    }
  }
}

bool has_default(const Field& field) {
  const auto* number = std::get_if<double*>(&field.value);
  return !field.is_required && (number == nullptr || field.range.holds(**number));
}

std::vector<OptionRow> list_options(const std::string& prefix, const model::RobotDescription& robot,
                                    const tasks::OwnTasks& own) {
  Scenario scenario;
  Group options = scenario_fields(scenario, robot.num_legs());
  fit_defaults(options, robot, scenario);
  std::vector<OptionRow> rows;
  for_each_option(options, [&](const std::string& path, const Field& field) {
    if (path == "tasks") return add_tasks(rows, robot.scale, own);
    const std::string value = field.is_required    ? "required"
                              : has_default(field) ? std::visit(DefaultText{}, field.value)
                                                   : kNone;
    rows.push_back({path, value, field.unit, range_of(field), field.help});
  });
  std::erase_if(rows, [&](const OptionRow& row) { return !row.key.starts_with(prefix); });
  return rows;
}

}  // namespace surefoot::config
