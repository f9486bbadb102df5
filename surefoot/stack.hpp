#pragma once

// Tasks and their order, without the controller: a state's dynamics and a plan become a
// hierarchy. And what a task of your own needs.

#include "surefoot/control/task_stack.hpp"
#include "surefoot/model/robot_model.hpp"
#include "surefoot/tasks/catalog.hpp"
#include "surefoot/tasks/check_task.hpp"
#include "surefoot/tasks/task_entry.hpp"
