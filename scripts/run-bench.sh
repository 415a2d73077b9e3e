#!/usr/bin/env bash
# Runs every benchmark of a build folder, one after the other; fails at the end if one of them failed or a claim is missed.
# usage: run-bench.sh DIR
set -euo pipefail

failed=()
for program in "${1:?"usage: run-bench.sh DIR"}"/bench_*; do
  [[ -f $program && -x $program ]] || continue
  echo "== ${program##*/}"
  "$program" || failed+=("${program##*/}")
done
if [[ ${#failed[@]} -gt 0 ]]; then
  echo "failed: ${failed[*]}"
  exit 1
fi
