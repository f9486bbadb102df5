#pragma once

// Tasks and their order, without the controller: a state's dynamics and a plan become a
// hierarchy.

#include "surefoot/control/task_stack.hpp"
#include "surefoot/model/robot_model.hpp"
#include "surefoot/tasks/catalog.hpp"
