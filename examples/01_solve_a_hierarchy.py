"""The solver alone: a mass of 2 kg, pushed by at most 10 N, that should accelerate with 8 m/s²."""

import surefoot

# Unknowns x = (acceleration, force), highest priority first. It gets 5 m/s²; each level says how far it was missed.
solution = surefoot.solve(
    [
        {"name": "dynamics", "A": [[2, -1]], "b": [0]},  # 2 a − f = 0
        {"name": "force limit", "D": [[0, 1]], "lower": [-10], "f": [10]},
        {"name": "wish", "A": [[1, 0]], "b": [8]},
    ],
    certify=True,
)
print(f"acceleration {solution.x[0]:.3f} m/s², force {solution.x[1]:.3f} N")
for level in solution.levels:
    print(f"{level.name:12} missed by {level.residual:.3f}, {level.verdict}")
print(solution.explain())
assert abs(solution.x - [5, 10]).max() < 1e-9
