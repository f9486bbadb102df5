#include "surefoot/tasks/check_task.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/math/rotation.hpp"
#include "surefoot/model/robot_model.hpp"
#include "surefoot/tasks/catalog.hpp"
#include "surefoot/tasks/task_rows.hpp"

#include <algorithm>
#include <random>

// Of this thread; only in a program that links surefoot::count_allocations.
extern "C" [[gnu::weak]] long surefoot_count_allocations();

namespace surefoot::tasks {
namespace {

constexpr int kNumStates = 64;

long allocations() {
  return &surefoot_count_allocations == nullptr ? 0 : surefoot_count_allocations();
}

/// A robot in random states, with random feet down.
class Trial {
 public:
  explicit Trial(const model::RobotDescription& robot) : model_(robot) {
    plan_.feet.resize(robot.num_legs());
  }

  /// Bit k of `lifted`: foot k is in the air.
  TaskInput draw(int lifted) {
    const model::RobotDescription& robot = model_.description();
    RobotState state;
    state.time = 0.0;
    state.p_WB = Vec3(0.0, 0.0, 0.5 * robot.scale.length) + vector(0.03);
    state.q_WB = exp_rotation(vector(0.3));
    state.v_WB = vector(0.3);
    state.w_WB_B = vector(0.5);
    state.q = state.qd = state.torque = robot.q_nominal;
    for (Eigen::Index j = 0; j < state.q.size(); ++j) {
      state.q[j] += uniform(0.2);
      state.qd[j] = uniform(1.0);
      state.torque[j] = uniform(10.0);
    }
    const model::Dynamics& dynamics = model_.update(state, Vec3::UnitZ());
    for (const Leg leg : plan_.feet.legs()) {
      FootPlan& foot = plan_.feet[index(leg)];
      foot.phase = (lifted >> index(leg)) % 2 == 0 ? LegPhase::stance : LegPhase::swing;
      foot.p_WF = dynamics.foot[index(leg)].p + vector(0.05);
      foot.v_WF = vector(0.2);
      foot.force_max = 400.0;
    }
    plan_.torso.q_WB = exp_rotation(vector(0.2));
    plan_.torso.height = state.p_WB.z() + uniform(0.05);
    plan_.com.p = dynamics.com.p.head<2>();
    support_.update(dynamics, plan_);
    return {dynamics, plan_, support_, robot};
  }

 private:
  double uniform(double bound) {
    return std::uniform_real_distribution<double>(-bound, bound)(random_);
  }
  Vec3 vector(double bound) {
    const double x = uniform(bound), y = uniform(bound);
    return {x, y, uniform(bound)};
  }

  model::RobotModel model_;
  MotionPlan plan_;
  model::SupportDynamics support_;
  std::mt19937_64 random_{1};
};

bool are_same(const solver::Level& a, const solver::Level& b) {
  return a.num_rows() == b.num_rows() && a.A() == b.A() && a.lower() == b.lower() &&
         a.upper() == b.upper();
}

/// What is wrong with the task in one state.
std::string fault_of(const Task& task, const TaskInput& input) {
  const Eigen::Index unknowns = 6 + 2 * input.robot.num_joints();
  solver::Level first(std::string(task.name()), task.max_rows(), unknowns), second = first;
  try {
    task.write(input, first);
    const long before = allocations();
    task.write(input, second);
    if (allocations() != before)
      return "write() allocates; make its memory in the constructor or in fixed-size matrices";
  } catch (const std::exception& error) {
    return "write() threw: " + std::string(error.what());
  } catch (...) {
    return "write() threw something that is no std::exception";
  }
  const std::string wrong = what_is_wrong(task, first, 0);
  if (!wrong.empty()) return wrong;
  if (!are_same(first, second)) return "wrote other rows for the same input; keep no state";
  return "";
}

std::string fault_of_names(const Task& task) {
  std::vector<std::string> names;
  for (int id = 0; id < task.num_ids(); ++id) {
    names.push_back(task.row_name(id));
    if (names.back().empty()) return "row_name(" + std::to_string(id) + ") is empty";
  }
  std::ranges::sort(names);
  const auto twice = std::ranges::adjacent_find(names);
  return twice == names.end() ? "" : "row_name() calls two rows \"" + *twice + "\"";
}

/// The defaults, and each choice.
std::vector<TaskParameters> variants(const TaskInfo& info) {
  std::vector<TaskParameters> all(1);
  for (const TaskChoice& choice : info.choices) {
    for (const std::string& word : choice.values)
      all.push_back({.numbers = {}, .choices = {{choice.name, word}}});
  }
  return all;
}

}  // namespace

std::vector<std::string> check_task(std::string_view name, const model::RobotDescription& robot,
                                    const OwnTasks& own) {
  const TaskInfo& info = task_info(name, own);
  std::vector<std::string> faults;
  const auto note = [&](const std::string& fault) {
    const std::string text = "task \"" + info.name + "\": " + fault;
    if (!fault.empty() && std::ranges::find(faults, text) == faults.end()) faults.push_back(text);
  };
  Trial trial(robot);
  for (const TaskParameters& parameters : variants(info)) {
    try {
      const std::unique_ptr<Task> task = make_task(name, parameters, own);
      task->prepare(robot);
      task->set_first_id(7);  // as behind another task of its level
      check_sizes(*task, name);
      note(fault_of_names(*task));
      for (int i = 0; i < kNumStates; ++i) note(fault_of(*task, trial.draw(i)));
    } catch (const std::exception& error) {
      note(error.what());
    } catch (...) {
      note("it threw something that is no std::exception");
    }
  }
  return faults;
}

}  // namespace surefoot::tasks
