#include "surefoot/config/data_file.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/nearest_name.hpp"
#include "surefoot/config/config_tree.hpp"
#include "surefoot/config/data_directory.hpp"

#include <algorithm>

namespace surefoot::config {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

/// "scenarios" → "scenario"
std::string singular(const std::string& folder) { return folder.substr(0, folder.size() - 1); }

/// " in /here, /beside or /data/scenarios": where a relative name was searched.
std::string searched_places(const std::string& folder, const std::string& name,
                            const fs::path& beside) {
  if (fs::path(name).is_absolute()) return "";
  std::error_code ignored;
  const fs::path here = fs::current_path(ignored);
  const fs::path besides = beside.empty() ? here : fs::absolute(beside, ignored).lexically_normal();
  return " in " + here.string() + (besides == here ? "" : ", " + besides.string()) + " or " +
         (data_directory() / folder).string();
}

/// Throws UnknownNameError if the path exists but is not a YAML file.
void refuse_other_files(const std::string& folder, const std::string& name,
                        const fs::path& beside) {
  std::error_code ignored;
  for (const fs::path& place : {fs::path(name), beside / name}) {
    if (!fs::exists(place, ignored)) continue;
    throw UnknownNameError("\"" + name + "\" is " +
                           (fs::is_directory(place, ignored) ? "a folder" : "not a YAML file") +
                           "; the name of a " + singular(folder) +
                           " or a file that ends in .yaml would be valid");
  }
}

}  // namespace

std::vector<std::string> list_data(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(data_directory() / folder, ignored)) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::ranges::sort(names);
  return names;
}

std::string describe_data(const std::string& folder, const std::string& name) {
  const ConfigNode tree = parse_yaml_file(find_data_file(folder, name));
  const ConfigNode* description = tree.find("description");
  return description == nullptr ? "" : description->text;
}

fs::path find_data_file(const std::string& folder, const std::string& name,
                        const fs::path& beside) {
  const std::string extension = fs::path(name).extension().string();
  if (extension == ".yaml" || extension == ".yml") {
    if (is_file(name)) return name;
    if (!beside.empty() && is_file(beside / name)) return beside / name;
    if (is_file(data_directory() / folder / name)) return data_directory() / folder / name;
    refuse_other_files(folder, name, beside);
    throw UnknownNameError("there is no file \"" + name + "\"" +
                           searched_places(folder, name, beside) + "; " +
                           valid_names(fs::path(name).stem().string(), list_data(folder)));
  }
  const fs::path file = data_directory() / folder / (name + ".yaml");
  // A name with a slash would leave the folder.
  if (name.find('/') == std::string::npos && is_file(file)) return file;
  refuse_other_files(folder, name, beside);
  throw UnknownNameError("unknown " + singular(folder) + " \"" + name + "\"; " +
                         valid_names(name, list_data(folder)));
}

}  // namespace surefoot::config
