#include "surefoot/config/json_schema.hpp"

#include "surefoot/config/criteria_section.hpp"
#include "surefoot/config/gait_file.hpp"
#include "surefoot/config/option_list.hpp"
#include "surefoot/config/robot_fields.hpp"
#include "surefoot/config/scaling.hpp"
#include "surefoot/config/scenario_fields.hpp"
#include "surefoot/tasks/catalog.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace surefoot::config {
namespace {

using Json = nlohmann::ordered_json;

Json text() { return {{"type", "string"}}; }
Json flag() { return {{"type", "boolean"}}; }
Json or_null(const Json& schema) { return {{"anyOf", {schema, {{"type", "null"}}}}}; }
Json list_of(const Json& items) { return {{"type", "array"}, {"items", items}, {"minItems", 1}}; }
/// A map of these keys and no others.
Json map_of(const Json& properties, const std::vector<std::string>& required = {}) {
  Json map{{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!required.empty()) map["required"] = required;
  return map;
}

/// Names of what belongs to legs, as a quadruped has them.
std::vector<std::string> without_middle_legs(std::vector<std::string> names) {
  std::erase_if(names, [](const std::string& name) {
    return name.starts_with("LM") || name.starts_with("RM");
  });
  return names;
}

Json number(const NumberRange& range, const char* type = "number") {
  Json schema{{"type", type}};
  if (std::isfinite(range.min))
    schema[range.min_included ? "minimum" : "exclusiveMinimum"] = range.min;
  if (std::isfinite(range.max)) schema["maximum"] = range.max;
  return schema;
}

Json list_of_size(const Json& items, std::size_t size) {
  return {{"type", "array"}, {"items", items}, {"minItems", size}, {"maxItems", size}};
}

/// `is_whole`: no part may stand in another file, so that its required keys are required.
Json map_of(const Group& group, bool is_whole);

/// Schema of an option, by the kind of its value.
struct Form {
  const Field& field;
  bool is_whole;

  Json operator()(const double* /*value*/) const { return number(field.range); }
  Json operator()(const int* /*value*/) const { return number(field.range, "integer"); }
  Json operator()(const std::uint64_t* /*value*/) const { return number(kNotNegative, "integer"); }
  Json operator()(const bool* /*value*/) const { return flag(); }
  Json operator()(const std::string* /*value*/) const { return text(); }
  Json operator()(const std::vector<double>* /*values*/) const {
    return {{"type", "array"}, {"items", number(field.range)}};
  }
  Json operator()(const Choice& choice) const { return {{"enum", choice.names}}; }
  Json operator()(const Numbers& numbers) const {
    Json named = Json::object();
    for (const std::string& name : numbers.names) named[name] = number(field.range);
    Json forms{list_of_size(number(field.range), numbers.names.size()), map_of(named)};
    const std::size_t of_quadruped = without_middle_legs(numbers.names).size();
    if (of_quadruped < numbers.names.size())
      forms.push_back(list_of_size(number(field.range), of_quadruped));
    if (numbers.or_one) forms.push_back(number(field.range));
    return {{"anyOf", forms}};
  }
  Json operator()(const Order& order) const {
    Json forms = Json::array();
    for (const auto& names : {order.names, without_middle_legs(order.names)}) {
      forms.push_back(list_of_size({{"enum", names}}, names.size()));
      forms.back()["uniqueItems"] = true;
    }
    return {{"anyOf", forms}};
  }
  Json operator()(const Names& names) const {
    return names.size == 0 ? list_of(text()) : list_of_size(text(), names.size);
  }
  Json operator()(const Group& group) const {
    const Json map = map_of(group, is_whole);
    return is_whole ? map : or_null(map);
  }
  Json operator()(const Entries& entries) const;
  Json operator()(const Other& other) const;
};

/// Adds the default of an option with a single value.
struct Default {
  Json& schema;

  void operator()(double* value) const {
    if (std::isfinite(*value)) schema["default"] = *value;
  }
  void operator()(int* value) const { schema["default"] = *value; }
  void operator()(bool* value) const { schema["default"] = *value; }
  void operator()(const Choice& choice) const {
    if (choice.given < choice.names.size()) schema["default"] = choice.names[choice.given];
  }
  template <typename Value>
  void operator()(const Value& /*value*/) const {}
};

Json schema_of(const Field& field, bool is_whole) {
  Json schema = std::visit(Form{field, is_whole}, field.value);
  if (has_default(field)) std::visit(Default{schema}, field.value);
  const std::string unit = field.unit.empty() ? "" : " [" + field.unit + "]";
  if (!(field.help + unit).empty()) schema["description"] = field.help + unit;
  return schema;
}

Json map_of(const Group& group, bool is_whole) {
  Json properties = Json::object();
  std::vector<std::string> required;
  for (const Field& field : group.fields) {
    properties[field.key] = schema_of(field, is_whole);
    if (is_whole && field.is_required) required.push_back(field.key);
  }
  return map_of(properties, required);
}

Json Form::operator()(const Entries& entries) const {
  if (entries.of_list != nullptr)
    return {{"type", "array"}, {"items", map_of(entries.shapes.front().add(), true)}};
  Json forms = Json::array();
  forms.push_back({{"type", "null"}});
  for (const Entries::Shape& shape : entries.shapes) {
    Json map = map_of(shape.add(), false);
    if (entries.shapes.size() > 1) map["properties"]["shape"] = {{"const", shape.name}};
    forms.push_back(map);
  }
  return or_null({{"type", "object"}, {"additionalProperties", {{"anyOf", forms}}}});
}

Json words(const tasks::TaskChoice& choice) {
  if (!choice.others.empty()) return {{"anyOf", {text(), list_of(text())}}};
  Json names = choice.values;
  if (choice.values.front() == "none") names.push_back(nullptr);
  return {{"enum", names}};
}

/// Schema of a task's parameters, with additional properties.
Json task_map(const tasks::TaskInfo& task, Json properties,
              const std::vector<std::string>& required) {
  for (const tasks::TaskParameter& one : task.parameters) {
    const std::string unit(one.unit);
    properties[std::string(one.name)] = {
        {"type", "number"},
        {"minimum", one.minimum},
        {"default", one.default_value},
        {"description", std::string(one.help) + " [" + unit + "]"}};
  }
  for (const tasks::TaskChoice& one : task.choices) {
    Json schema = words(one);
    schema.update({{"default", one.default_value}, {"description", one.help}});
    properties[std::string(one.name)] = schema;
  }
  Json map = map_of(properties, required);
  map["description"] = task.summary;
  return map;
}

Json tasks_by_name(const tasks::OwnTasks& own = {}) {
  Json properties = Json::object();
  for (const tasks::TaskInfo& task : tasks::task_infos(own))
    properties[std::string(task.name)] = or_null(task_map(task, Json::object(), {}));
  return or_null(map_of(properties));
}

Json limits_by_metric() {
  const Json limits{{"type", "object"},
                    {"properties", {{"min", number(kAnyNumber)}, {"max", number(kAnyNumber)}}},
                    {"additionalProperties", false},
                    {"minProperties", 1}};
  const Json limit{{"anyOf", {limits, {{"type", "boolean"}}, {{"type", "null"}}}}};
  Json properties = Json::object();
  std::string names;
  for (const std::string& name : metric_names()) {
    properties[name] = limit;
    names += (names.empty() ? "" : "|") + name;
  }
  Json map = map_of(properties);
  map["patternProperties"] = {{"^(" + names + ")\\.", limit}};
  return or_null(map);
}

Json figures_by_metric() {
  Json properties = Json::object();
  for (const std::string& name : metric_names())
    properties[name] = {{"type", {"string", "number", "boolean", "null"}}};
  return or_null(map_of(properties));
}

/// "terrain.elements.<box>.size.x" or "user[].yaw_rate" as a regular expression.
std::string pattern_of(const std::string& path) {
  std::string pattern = "^";
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (path[i] == '<') {
      i = path.find('>', i);
      pattern += "[^.]+";
    } else if (path[i] == '[') {
      ++i;
      pattern += "\\.[0-9]+";
    } else {
      pattern += path[i] == '.' ? "\\." : std::string(1, path[i]);
    }
  }
  return pattern + "$";
}

void add_range(const std::string& path, const Json& value, const std::string& help, Json& map) {
  const Json range{{"anyOf", {list_of_size(value, 2), {{"type", "null"}}}}, {"description", help}};
  const bool is_pattern = path.find_first_of("<[") != std::string::npos;
  Json& keys = map[is_pattern ? "patternProperties" : "properties"];
  const std::string key = is_pattern ? pattern_of(path) : path;
  if (!keys.contains(key)) keys[key] = range;
}

/// Ranges of every number that a scenario has, by path.
Json ranges_by_path(const tasks::OwnTasks& own = {}) {
  Scenario scenario;
  Json map = map_of(Json{{"include", {{"anyOf", {text(), list_of(text()), {{"type", "null"}}}}}}});
  for_each_option(scenario_fields(scenario, kMaxLegs),
                  [&](const std::string& path, const Field& field) {
                    if (const auto* numbers = std::get_if<Numbers>(&field.value)) {
                      for (const std::string& name : numbers->names)
                        add_range(path + "." + name, number(field.range), field.help, map);
                      add_range(path, number(field.range), field.help, map);
                    } else if (std::holds_alternative<double*>(field.value) ||
                               std::holds_alternative<int*>(field.value) ||
                               std::holds_alternative<std::uint64_t*>(field.value)) {
                      add_range(path, std::visit(Form{field, false}, field.value), field.help, map);
                    }
                  });
  for (const tasks::TaskInfo& task : tasks::task_infos(own)) {
    for (const tasks::TaskParameter& one : task.parameters) {
      const NumberRange range{.min = one.minimum};
      add_range("tasks." + std::string(task.name) + "." + std::string(one.name), number(range),
                std::string(one.help), map);
    }
  }
  return map;
}

Json Form::operator()(const Other& other) const {
  const std::string form = other.schema;
  if (form == "tasks") return tasks_by_name();
  if (form == "randomise") return or_null(ranges_by_path());
  if (form == "criteria") return limits_by_metric();
  if (form == "gaits") return list_of(text());
  if (form == "paper") return figures_by_metric();
  if (form == "flag") return flag();
  return text();
}

Json stack(const tasks::OwnTasks& own) {
  const Json weight = number(kPositive), damping = number(kNotNegative);
  Json tasks = Json::array(), levels = Json::array();
  levels.push_back(text());
  for (const tasks::TaskInfo& task : tasks::task_infos(own)) {
    Json properties{{"task", {{"const", task.name}}}, {"weight", weight}};
    tasks.push_back(task_map(task, properties, {"task"}));
    properties.update({{"name", text()}, {"damping", damping}});
    levels.push_back(task_map(task, properties, {"task"}));
  }
  levels.push_back(map_of({{"name", text()},
                           {"weight", weight},
                           {"damping", damping},
                           {"tasks", list_of({{"anyOf", tasks}})}},
                          {"name", "tasks"}));
  Json map = map_of({{"name", text()},
                     {"description", text()},
                     {kScaled, flag()},
                     {"base", text()},
                     {"without", list_of(text())},
                     {"levels", list_of({{"anyOf", levels}})},
                     {"weights", {{"type", "object"}, {"additionalProperties", weight}}},
                     {"weighted_from", text()}},
                    {"name"});
  map["anyOf"] = {{{"required", {"base"}}}, {{"required", {"levels"}}}};
  return map;
}

Json file_of(const std::string& kind, const tasks::OwnTasks& own) {
  if (kind == "stack") return stack(own);
  if (kind == "randomisation") {
    Json ranges = ranges_by_path(own);
    ranges["properties"][kScaled] = flag();
    return ranges;
  }
  if (kind == "gait") {
    gaits::PlannerOptions planner;
    gaits::set_num_legs(planner, kMaxLegs);
    std::string description;
    return map_of(gait_fields(planner, description), false);
  }
  if (kind == "robot") {
    RobotInFile walker, biped;
    set_num_legs(walker, kMaxLegs);
    set_num_legs(biped, 2);
    return {{"anyOf", {map_of(fields(walker), true), map_of(fields(biped), true)}}};
  }
  Scenario options;
  Json scenario = map_of(scenario_fields(options, kMaxLegs), false);
  scenario["properties"]["tasks"].update(tasks_by_name(own));
  scenario["properties"]["randomise"].update(or_null(ranges_by_path(own)));
  return scenario;
}

}  // namespace

const std::vector<std::string>& kinds_of_files() {
  static const std::vector<std::string> kKinds{"scenario", "randomisation", "robot", "stack",
                                               "gait"};
  return kKinds;
}

std::string json_schema(const std::string& kind, const tasks::OwnTasks& own) {
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
              {"title", "surefoot " + kind}};
  schema.update(file_of(kind, own));
  return schema.dump(1);
}

}  // namespace surefoot::config
