"""What the demo runs: the paper's experiments, and some that ask a question about it."""

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Experiment:
    """A scenario run once as it stands, with a report, and perhaps over some random seeds."""

    name: str  # also of its folder
    shown: list  # metrics of the single run that tell the result
    scenario: str = ""  # the name by default
    assignments: list = field(default_factory=list)  # as for --set
    seeds: bool = False  # also over random seeds; the same ones in every experiment
    as_found: bool = False  # an open question: any result is one

    def words(self):
        return ["run", self.scenario or self.name, *(f"--set={assignment}" for assignment in self.assignments)]


WALK = ["com_error_max_m", "com_lateral_sway_m", "speed_mps"]
STEP = ["goal_reached", "max_tilt_rad", "torque_max_nm", "com_error_max_m"]
OUTCOME = ["reason", "distance_m", "com_error_max_m"]
TORQUE = ["torque_step_max_nm"]
EXPERIMENTS = [
    Experiment("walk_flat", WALK),
    Experiment("walk_flat_sea", WALK),
    Experiment("step_down", STEP, seeds=True),
    Experiment("step_down_regular_stack", ["goal_reached", "reason"], seeds=True),
    Experiment("step_down_without_limits", ["goal_reached", "reason"], seeds=True, as_found=True),
    Experiment("step_up", STEP),
    Experiment("manipulability_standing", ["base_height_end_m"]),
    Experiment("manipulability", ["base_height_end_m", "com_error_max_m"]),
    *(Experiment(name, OUTCOME, as_found=True) for name in ("slope_up", "slope_along", "slope_down", "push", "slippery")),
    Experiment("torque_continuity", TORQUE),
    Experiment("torque_continuity_without_ramps", TORQUE, "torque_continuity", ["planner.force.ramps=false"], as_found=True),
]
