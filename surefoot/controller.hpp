#pragma once

// The whole-body controller: one call of `step` a tick. It takes any `StateEstimator` and
// `MotionPlanner`; `LegInertialEstimator` is the one for IMU and encoders.

#include "surefoot/control/controller.hpp"
#include "surefoot/estimation/leg_inertial_estimator.hpp"
#include "surefoot/gaits/gait.hpp"
#include "surefoot/gaits/own_gaits.hpp"
