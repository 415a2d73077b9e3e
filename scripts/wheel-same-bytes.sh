#!/usr/bin/env bash
# Whether a run of `flank wheel` that is killed and started again, and a run with one thread, write the same bytes as one that is left alone.
# usage: wheel-same-bytes.sh COMMAND PART [KILLS]   (KILLS: how many times the second run is killed, default 4, at even shares of the first one's time)
set -euo pipefail

command=$(realpath "${1:?"usage: wheel-same-bytes.sh COMMAND PART [KILLS]"}")
part=$(realpath "${2:?"usage: wheel-same-bytes.sh COMMAND PART [KILLS]"}")
kills=${3:-4}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# All into a folder of the same name: results name the tools that they were made with.
run() { "$command" wheel "$part" -o "$work/out" --quiet "$@" || [[ $? -eq 1 ]]; }
begin=$(date +%s)
run
whole=$(($(date +%s) - begin))
mv "$work/out" "$work/whole"
echo "left alone: $whole s"

for ((k = 1; k <= kills; ++k)); do
  "$command" wheel "$part" -o "$work/out" --quiet &
  child=$!
  sleep $((whole / (kills + 1) + 1))
  kill -KILL "$child" 2>/dev/null && echo "killed, $k of $kills" || echo "had ended, $k of $kills"
  wait "$child" 2>/dev/null || true
done
run
different=0
diff -rq "$work/whole" "$work/out" && echo "killed and started again: the same bytes" || different=1
rm -rf "$work/out"
run --threads 1
diff -rq "$work/whole" "$work/out" && echo "one thread: the same bytes" || different=1
exit $different
