#!/usr/bin/env bash
# Bash completion knows commands, options and values. usage: completion_test.sh FILE
set -euo pipefail
# shellcheck disable=SC1090
source "$1"

failed=0
# expect WORD WORDS...: completing the last of the words offers WORD.
expect() {
  local wanted=$1
  shift
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMPREPLY=()
  _flank || true  # as compgen, where it offers nothing
  for reply in "${COMPREPLY[@]}"; do [[ $reply == "$wanted" ]] && return; done
  echo "completion_test: '$*' offers '${COMPREPLY[*]}' and not '$wanted'" >&2
  failed=1
}

expect fit flank fi
expect fit flank help fi
expect --tolerance flank fit blade.step --toler
expect --threads flank inspect --thr
expect linuxcnc-xyzac-trt flank post out --machine linuxcnc
expect linuxcnc-xyzac-trt flank machine linuxcnc
expect barrel flank fit blade.step --tool barr
expect barrel flank tool barr
expect rotor37 flank example rotor
expect quick flank fit blade.step --effort q
expect climb flank trochoid cavity.step --cut cl
expect off flank fit blade.step --avoid of
expect mm flank inspect part.stl --unit m
exit "$failed"
