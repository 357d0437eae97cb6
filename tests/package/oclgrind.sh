#!/usr/bin/env bash
# Runs every kernel on small frames inside Oclgrind, an OpenCL device that is an interpreter: no data
# race, no access out of bounds, no uninitialised read. Usage: oclgrind.sh BUILD-DIRECTORY
# Oclgrind's exit code is always 0, so its log is read.
set -euo pipefail
macula=$1/macula
if ! command -v oclgrind >/dev/null; then
  echo 'oclgrind: skipped (package oclgrind is not installed)'
  exit 0
fi
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export MACULA_CACHE_DIR=$scratch/cache
failures=0
runs=0

# under NAME OCLGRIND-OPTIONS -- MACULA-ARGUMENTS
under() {
  local name=$1 log=$scratch/log
  shift
  local -a options=()
  while [[ $1 != -- ]]; do options+=("$1"); shift; done
  shift
  runs=$((runs + 1))
  if ! timeout 300 oclgrind "${options[@]}" --log "$log" "$macula" "$@" >"$scratch/out" 2>&1; then
    echo "oclgrind: $name: macula failed"
    tail -n 5 "$scratch/out"
    failures=$((failures + 1))
  elif grep -qE 'Invalid|race|Uninitialized|OCLGRIND' "$log"; then
    echo "oclgrind: $name:"
    head -n 12 "$log"
    failures=$((failures + 1))
  fi
}

frame=(render cornell --size 16x16 --frames 0:1 --out "$scratch/out.d" --hash)
for lights in point area ao; do
  under "races and bounds, $lights" --data-races -- "${frame[@]}" --lights "$lights"
done
while read -r variant; do
  under "variant $variant" --data-races -- "${frame[@]}" --lights point --variant "$variant"
done < <("$macula" variants --names)
# False alarms with optimisation on; see docs/arithmetic.md.
under 'uninitialised reads' --uninitialized --build-options -cl-opt-disable -- \
  "${frame[@]}" --lights point --variant while_while

echo "oclgrind: $runs runs, $failures with findings"
((failures == 0))
