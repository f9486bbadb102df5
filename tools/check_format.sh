#!/usr/bin/env bash
# Holds C++ sources against .clang-format and names the files that differ.
#   tools/check_format.sh [--fix] [FILE...]     all sources where none is named
set -euo pipefail
root=$(dirname "$(dirname "$(realpath "${BASH_SOURCE[0]}")")")

mode=--dry-run
if [[ ${1:-} == --fix ]]; then
  mode=-i
  shift
fi
files=("$@")
if ((${#files[@]} == 0)); then
  cd "$root"
  mapfile -t files < <(find surefoot server cli python tests examples benchmarks \( -name '*.[hc]pp' -o -name '*.inl' \) 2>/dev/null | sort)
fi

echo "format: ${#files[@]} files"
differ=$("$root/.venv/bin/clang-format" "$mode" "${files[@]}" 2>&1 | sed -n 's/^\([^ :]*\):[0-9]*:[0-9]*: .*/\1/p' | sort -u)
if [[ $differ ]]; then
  echo "$differ"
  echo "These differ from .clang-format; tools/check_format.sh --fix brings them in order."
  exit 1
fi
