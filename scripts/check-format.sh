#!/usr/bin/env bash
# Checks that every C++ source is formatted as .clang-format says; with --fix, formats them.
# Another release of clang-format would format a few lines differently, so only release 14 (Debian 12) will do; without it the
# check fails, because a check that did not run has not passed.
set -euo pipefail
cd "$(dirname "$0")/.."

formatter=
for candidate in clang-format-14 clang-format; do
  if "$candidate" --version 2> /dev/null | grep --quiet 'version 14\.'; then
    formatter=$candidate
    break
  fi
done
if [[ -z $formatter ]]; then
  echo "check-format.sh: clang-format 14 is not installed (on Debian 12, scripts/install-deps.sh dev installs it)" >&2
  exit 1
fi
# A Heidenhain program ends in .h, too.
mapfile -t files < <(find src include apps python tests bench examples -path tests/fuzz/corpus -prune -o \( -name '*.h' -o -name '*.cpp' \) -print | sort)
# A hundred files a process, on all processors.
on_all() { printf '%s\0' "${files[@]}" | xargs --null --max-args 100 --max-procs "$(nproc)" "$formatter" "$@"; }
if [[ ${1:-} == --fix ]]; then
  on_all -i
else
  on_all --dry-run --Werror
  echo "${#files[@]} files are formatted"
fi
