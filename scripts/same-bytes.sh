#!/usr/bin/env bash
# Whether two builds of the command give the same bytes: tool.json, path.json and verify.json of fits and covers of the parts
# that the benchmarks claim figures of. A change that moves code and nothing else must pass.
# usage: same-bytes.sh OLD_COMMAND NEW_COMMAND [TEXT]   (only the runs whose name holds TEXT)
set -euo pipefail

old=$(realpath "${1:?"usage: same-bytes.sh OLD_COMMAND NEW_COMMAND [TEXT]"}")
new=$(realpath "${2:?"usage: same-bytes.sh OLD_COMMAND NEW_COMMAND [TEXT]"}")
only=${3:-}
data=${FLANK_DATA:-$(dirname "$0")/../../shared/data}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for example in twisted-blade ruled-blade envelope-barrel-1 envelope-hyperbolic-2; do
  "$old" example "$example" -o "$work/$example.step" --quiet
done

runs=0 different=0
# compare NAME ARGUMENTS...: one run of each command.
compare() {
  local name=$1 file
  shift
  [[ $name == *"$only"* ]] || return 0
  runs=$((runs + 1))
  for build in old new; do
    "${!build}" "$@" --quiet -o "$work/$build" || [[ $? -eq 1 ]]
  done
  for file in tool.json path.json verify.json; do
    if ! cmp --silent "$work/old/$file" "$work/new/$file"; then
      echo "$name: $file differs"
      different=$((different + 1))
    fi
  done
  rm -rf "$work/old" "$work/new"
  echo "$name: done"
}

r37=$data/r37_blade.step kj66=$data/kj66_impeller.step blisk=$data/r37_blisk_sector_2blades.step
compare twisted fit "$work/twisted-blade.step" --face F1 --tolerance 0.05
compare ruled fit "$work/ruled-blade.step" --face F1 --tolerance 0.1
compare barrel fit "$work/envelope-barrel-1.step" --face F1 --tolerance 0.001
compare hyperbolic fit "$work/envelope-hyperbolic-2.step" --face F1 --tool hyperbolic --tolerance 0.001
compare given fit "$work/twisted-blade.step" --face F1 --tool cone:radius=4,angle=2 --tolerance 0.1
compare r37-f1 fit "$r37" --face F1 --tolerance 0.1 --radius-min 4 --radius-max 8 --avoid off
compare r37-strips fit "$r37" --face F3 --strips 4 --tolerance 0.05 --radius-min 4 --radius-max 8 --avoid off
compare kj66-f1 fit "$kj66" --face F1 --tolerance 0.02 --reach-radius 1.5
compare blisk-f9 fit "$blisk" --face F9 --tolerance 0.1 --reach-radius 5 --shank-length 30 --holder 30:10,70:10 --clearance 0.5
compare cover-f1 cover "$r37" --face F1 --tool cylinder:radius=5 --axis-length 20 --tolerance 0.05
compare cover-curves cover "$r37" --face F3 --tool cylinder:radius=5 --axis-length 20 --tolerance 0.05 --strategy curves
compare cover-kj66 cover "$kj66" --face F1 --tool cylinder:radius=2 --axis-length 25 --tolerance 0.01
compare cover-barrel cover "$work/twisted-blade.step" --face F1 --tool barrel --tolerance 0.1
compare cover-blisk cover "$blisk" --face F9 --tool cylinder:radius=5 --tolerance 0.05 --axis-length 20

echo "$runs runs, $different files differ"
[[ $different -eq 0 && $runs -gt 0 ]]
