#include "surefoot/config/field_reader.hpp"

#include "surefoot/base/nearest_name.hpp"

#include <algorithm>

namespace surefoot::config {
namespace {

/// Throws Error for an element without a shape: a new one, or a misspelt name.
void require_shape(const std::string& name, Section& elements, Section& element) {
  if (element.node("shape") != nullptr) return;
  std::vector<std::string> others = elements.keys();
  std::erase_if(others, [&](const std::string& one) {
    return one == name || elements.node(one.c_str())->kind == ConfigNode::Kind::null;
  });
  const std::string new_one = "this key is missing, and \"" + name + "\" is a new element";
  element.fail("shape", others.empty() ? new_one : new_one + "; " + valid_names(name, others));
}

/// An empty value removes an entry of the base file.
void read_named(Section& map, const Entries& entries) {
  const bool has_shapes = entries.shapes.size() > 1;
  std::vector<std::string> shapes;
  for (const Entries::Shape& shape : entries.shapes) shapes.emplace_back(shape.name);
  for (const std::string& name : map.keys()) {
    if (map.node(name.c_str())->kind == ConfigNode::Kind::null) continue;
    map.section(name.c_str(), [&](Section& entry) {
      if (has_shapes) require_shape(name, map, entry);
      const std::size_t shape = has_shapes ? *entry.choice("shape", shapes) : 0;
      read(entry, entries.shapes[shape].add());
    });
  }
}

/// Indices of the listed names in `order.names`.
std::vector<std::size_t> read_order(Section& section, const char* key, const Order& order) {
  const ConfigNode& list = *section.node(key);
  std::string all;
  for (const std::string& name : order.names) all += (all.empty() ? "" : ", ") + name;
  const std::string what = order.what, size = std::to_string(order.names.size());
  if (list.items.size() != order.names.size())
    section.fail(key, "must name each of the " + size + " " + what + "s once: " + all);
  std::vector<std::size_t> places;
  for (const ConfigNode& item : list.items) {
    const std::string name = read_text(item, section.path_of(key));
    const auto found = std::ranges::find(order.names, name);
    if (found == order.names.end())
      section.fail(key, "unknown " + what + " \"" + name + "\"; valid are: " + all);
    const auto place = static_cast<std::size_t>(found - order.names.begin());
    if (std::ranges::find(places, place) != places.end()) {
      section.fail(key, what + " " + name + " comes twice; it must name each of the " + size + " " +
                            what + "s once");
    }
    places.push_back(place);
  }
  return places;
}

/// Reads one option, by the kind of its value.
struct FieldReader {
  Section& section;
  const Field& field;
  const char* key = field.key.c_str();

  void operator()(double* value) const { section.number(key, *value, field.range); }
  void operator()(int* value) const {
    constexpr double kLargest = std::numeric_limits<int>::max();
    section.integer(key, *value, static_cast<int>(std::max(field.range.min, -kLargest)),
                    static_cast<int>(std::min(field.range.max, kLargest)));
  }
  void operator()(std::uint64_t* value) const { section.integer(key, *value); }
  void operator()(bool* value) const { section.flag(key, *value); }
  void operator()(std::string* value) const { section.text(key, *value); }
  void operator()(std::vector<double>* values) const { section.numbers(key, *values); }

  void operator()(const Choice& choice) const {
    if (const auto given = section.choice(key, choice.names, choice.what)) choice.set(*given);
  }
  void operator()(const Numbers& numbers) const {
    const ConfigNode* given = section.node(key);
    if (!numbers.or_one || given == nullptr || given->kind != ConfigNode::Kind::scalar)
      return section.elements(key, numbers.data, numbers.names, field.range);
    double one = 0.0;
    section.number(key, one, field.range);
    std::fill_n(numbers.data, numbers.names.size(), one);
  }
  void operator()(const Order& order) const {
    if (section.node(key) != nullptr) order.set(read_order(section, key, order));
  }
  void operator()(const Names& names) const {
    const ConfigNode* list = section.node(key);
    if (list == nullptr) return;
    if (names.size == 0 ? list->items.empty() : list->items.size() != names.size)
      section.fail(key, names.what);
    names.values->clear();
    for (const ConfigNode& name : list->items)
      names.values->push_back(read_text(name, section.path_of(key)));
  }
  void operator()(const Group& group) const {
    const ConfigNode* given = section.node(key);
    if (given == nullptr && field.is_required) return;  // finish() throws
    const bool is_map = given != nullptr && given->kind == ConfigNode::Kind::map;
    section.section(key, [&](Section& s) { read(s, group, is_map || field.is_required); });
  }
  void operator()(const Entries& entries) const {
    if (entries.of_list == nullptr)
      return section.section(key, [&](Section& map) { read_named(map, entries); });
    const ConfigNode* list = section.node(key);
    if (list == nullptr) return;
    if (list->kind != ConfigNode::Kind::list) section.fail(key, entries.of_list);
    for (const ConfigNode& item : list->items) {
      Section entry(item, section.path_of(key));
      read(entry, entries.shapes.front().add());
      entry.finish();
    }
  }
  void operator()(const Other& /*other*/) const { (void)section.node(key); }
};

}  // namespace

void read(Section& section, const Group& group, bool is_there) {
  for (const Field& field : group.fields) {
    if (is_there && field.is_required) section.require(field.key.c_str());
    std::visit(FieldReader{section, field}, field.value);
  }
  if (group.rule) group.rule(section);
}

}  // namespace surefoot::config
