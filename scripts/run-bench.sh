#!/usr/bin/env bash
# Runs every benchmark of a build folder, one after the other.
# usage: run-bench.sh DIR
set -euo pipefail

for program in "${1:?"usage: run-bench.sh DIR"}"/bench_*; do
  [[ -f $program && -x $program ]] || continue
  echo "== ${program##*/}"
  "$program"
done
