#!/usr/bin/env bash
# Builds one sanitized variant (asan: address and undefined behaviour, all tests; tsan: threads, the tests of parallel loops) and
# runs it.
# usage: sanitize.sh asan|tsan [FOLDER...]   (only the tests of these folders)
set -euo pipefail
cd "$(dirname "$0")/.."

variant=${1:?"usage: sanitize.sh asan|tsan [FOLDER...]"}
shift
targets=() only=()
if [[ $# -gt 0 ]]; then
  targets=(--target "${@/#/test_}")
  only=(--tests-regex "^($(IFS='|'; echo "$*"))$")
fi
jobs=${JOBS:-$(nproc)}

cmake --preset "$variant"
cmake --build --preset "$variant" --parallel "$jobs" "${targets[@]}"

# The thread sanitizer dies on kernels that randomise addresses widely; setarch -R switches that off where it may.
launcher=()
if [[ $variant == tsan ]] && setarch --addr-no-randomize true 2> /dev/null; then
  launcher=(setarch --addr-no-randomize)
fi
"${launcher[@]}" ctest --preset "$variant" --parallel "$jobs" "${only[@]}"
