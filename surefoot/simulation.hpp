#pragma once

// The simulated robot, a port like that of a real one, with its true state.

#include "surefoot/simulation/plant.hpp"
