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
if [[ ${1:-} == --fix ]]; then
  "$formatter" -i "${files[@]}"
else
  "$formatter" --dry-run --Werror "${files[@]}"
  echo "${#files[@]} files are formatted"
fi
