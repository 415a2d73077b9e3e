#!/usr/bin/env bash
# Lints every source of the library, the command and the tests with .clang-tidy.
# usage: tidy.sh BUILD_DIR [FILE...]
set -euo pipefail
cd "$(dirname "$0")/.."

build=${1:?"usage: tidy.sh BUILD_DIR [FILE...]"}
shift
if [[ $# -eq 0 ]]; then
  mapfile -t files < <(find src apps -name '*.cpp' | sort)
else
  files=("$@")
fi
printf '%s\0' "${files[@]}" | xargs --null --max-procs="${JOBS:-$(nproc)}" --max-args=4 \
  clang-tidy -p "$build" --quiet --extra-arg=-Wno-unknown-warning-option
echo "${#files[@]} files are tidy"
