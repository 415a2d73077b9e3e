#!/usr/bin/env bash
# Builds one sanitized variant (asan: address and undefined behaviour, all tests; tsan: threads, the tests of parallel loops) and
# runs it.
# usage: sanitize.sh asan|tsan [--seconds N] [FOLDER...]   (only the tests of these folders)
# With --seconds it goes by folders, those first that the last commits changed, begins no more of them after N seconds, and names those
# that it left.
set -euo pipefail
cd "$(dirname "$0")/.."

variant=${1:?"usage: sanitize.sh asan|tsan [--seconds N] [FOLDER...]"}
shift
limit=
if [[ ${1:-} == --seconds ]]; then
  limit=${2:?"--seconds: a number is missing"}
  shift 2
fi
folders=("$@")
jobs=${JOBS:-$(nproc)}

cmake --preset "$variant"

# The thread sanitizer dies on kernels that randomise addresses widely; setarch -R switches that off where it may.
launcher=()
if [[ $variant == tsan ]] && setarch --addr-no-randomize true 2> /dev/null; then
  launcher=(setarch --addr-no-randomize)
fi

# check [FOLDER...]: builds and runs the tests of these folders, or all.
check() {
  local targets=() only=()
  if [[ $# -gt 0 ]]; then
    targets=(--target "${@/#/test_}")
    only=(--tests-regex "^($(IFS='|'; echo "$*"))$")
  fi
  cmake --build --preset "$variant" --parallel "$jobs" "${targets[@]}"
  "${launcher[@]}" ctest --preset "$variant" --parallel "$jobs" "${only[@]}"
}

# All folders with tests in this variant, those first of which the last 20 commits changed most files.
by_change() {
  ninja -C "build/$variant" -t targets all | sed -n 's/^test_\([a-z_]*\): phony$/\1/p' | sort > "build/$variant/folders.txt"
  { git log -20 --format= --name-only 2> /dev/null | sed -En 's#^(src/flank|tests)/([a-z_]+)/.*#\2#p' | sort | uniq -c | sort -k1,1nr -k2 |
      awk '{print $2}' | grep -Fxf "build/$variant/folders.txt" || true; cat "build/$variant/folders.txt"; } | awk '!seen[$0]++'
}

if [[ -z $limit ]]; then
  check "${folders[@]}"
  exit
fi
[[ ${#folders[@]} -gt 0 ]] || mapfile -t folders < <(by_change)
at=0
while [[ $at -lt ${#folders[@]} && $SECONDS -lt $limit ]]; do
  check "${folders[$at]}"
  at=$((at + 1))
done
if [[ $at -lt ${#folders[@]} ]]; then
  echo "sanitize.sh: $limit s are over; not looked at by $variant: ${folders[*]:$at}"
fi
