#include "surefoot/simulation/mujoco_handles.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/simulation/text.hpp"

#include <algorithm>

namespace surefoot::simulation {

namespace {

thread_local std::vector<std::string>* current_notes = nullptr;

// MuJoCo ends the process if an error handler returns, so this one throws.
void handle(const mjLogMessage* message) {
  const std::string line = "MuJoCo: " + one_line(message->subject);
  if (message->level == mjLOG_ERROR) throw Error(line);
  if (message->level != mjLOG_WARNING || current_notes == nullptr) return;
  if (std::find(current_notes->begin(), current_notes->end(), line) == current_notes->end()) {
    current_notes->push_back(line);
  }
}

void install_handler_once() {
  [[maybe_unused]] static const mjfLogHandler previous = mju_setLogHandler(&handle);
}

}  // namespace

MessageCatcher::MessageCatcher(std::vector<std::string>& notes) : outer_(current_notes) {
  install_handler_once();
  current_notes = &notes;
}

MessageCatcher::~MessageCatcher() { current_notes = outer_; }

std::string name_of(mjsElement* element) {
  // MuJoCo's strings use another standard library: only its own functions may read them.
  return mjs_getString(mjs_getName(element));
}

int id_of(const mjModel& model, mjtObj type, const std::string& name) {
  return mj_name2id(&model, type, name.c_str());
}

}  // namespace surefoot::simulation
