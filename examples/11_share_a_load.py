"""Two feet at x = ±0.3 m carry 20 kg, whose centre is 0.5 m high and pushed with 60 N along x. Which forces x₁ z₁ x₂ z₂ [N] hold it? Friction
first, then balance; where more than one answer is left the solver gives the smallest."""

import surefoot

friction = {"D": [[1, -0.5, 0, 0], [-1, -0.5, 0, 0], [0, 0, 1, -0.5], [0, 0, -1, -0.5]], "f": [0, 0, 0, 0], "name": "friction"}  # ±x ≤ 0.5 z
balance = {"A": [[1, 0, 1, 0], [0, 1, 0, 1], [0.5, -0.3, 0.5, 0.3]], "b": [-60, 20 * 9.81, 0], "name": "balance"}  # of push, weight, moment
solution = surefoot.solve([friction, balance])
x = solution.x
print(f"rear ({x[0]:.1f}, {x[1]:.1f}) N, front ({x[2]:.1f}, {x[3]:.1f}) N")
assert solution.levels[1].residual < 1e-9
