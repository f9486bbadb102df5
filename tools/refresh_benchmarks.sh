#!/usr/bin/env bash
# Measures the solver again and writes the table and the plot of docs/benchmarks.md.
#   bash tools/refresh_benchmarks.sh [OPTIONS OF benchmark_solver]
set -euo pipefail
root=$(dirname "$(dirname "$(realpath "${BASH_SOURCE[0]}")")")
build=$root/build/release
ninja -C "$build" benchmark_solver
"$build/benchmark_solver" --json "$root/build/solver.json" "$@"
"$build/benchmark_solver" --growth --json "$root/build/growth.json"
python3 "$root/tools/solver_benchmark_table.py" "$root/build/solver.json" "$root/docs/benchmarks.md"
python3 "$root/tools/plot_solver_growth.py" "$root/build/growth.json" "$root/docs/images/solver_growth.svg"
