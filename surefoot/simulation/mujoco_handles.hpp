#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>
#include <vector>

namespace surefoot::simulation {

/// Owning handles of MuJoCo's objects.
struct MujocoDeleter {
  void operator()(mjSpec* spec) const { mj_deleteSpec(spec); }
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using SpecHandle = std::unique_ptr<mjSpec, MujocoDeleter>;
using ModelHandle = std::unique_ptr<mjModel, MujocoDeleter>;
using DataHandle = std::unique_ptr<mjData, MujocoDeleter>;

/// While alive, collects this thread's MuJoCo warnings in `notes` (each text once) instead of
/// printing them, and throws fatal errors as Error instead of ending the program.
class MessageCatcher {
 public:
  explicit MessageCatcher(std::vector<std::string>& notes);
  MessageCatcher(const MessageCatcher&) = delete;
  MessageCatcher& operator=(const MessageCatcher&) = delete;
  ~MessageCatcher();

 private:
  std::vector<std::string>* outer_;
};

/// Name of an element of a spec.
[[nodiscard]] std::string name_of(mjsElement* element);

/// Id of a named element in the compiled model; −1 if there is none.
[[nodiscard]] int id_of(const mjModel& model, mjtObj type, const std::string& name);

}  // namespace surefoot::simulation
