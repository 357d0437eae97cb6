#!/usr/bin/env bash
# Runs every kernel on small frames inside Oclgrind, an OpenCL device that is an interpreter: no data
# race, no access out of bounds, no uninitialised read. Usage: oclgrind.sh BUILD-DIRECTORY
# Code 77: Oclgrind is not there.
# Oclgrind's exit code says nothing of what it found, so its log is read.
set -euo pipefail
macula=$(realpath "$1/macula")
if ! command -v oclgrind >/dev/null; then
  echo 'oclgrind: skipped (package oclgrind is not installed)'
  exit 77
fi
scratch=$(mktemp -d)
trap 'kill $(jobs -p) 2>/dev/null || true; rm -rf "$scratch"' EXIT
# What the wrapper /usr/bin/oclgrind preloads.
runtime=$(dirname "$(readlink -f "$(command -v oclgrind)")")/../lib/oclgrind/liboclgrind-rt.so
cc -shared -fPIC -O1 -o "$scratch/fill.so" tests/package/oclgrind_fill.c
export MACULA_CACHE_DIR=$scratch/cache
# Oclgrind 21.10 does not know llvm.usub.sat, which clang's optimiser makes, nor the scopes that it
# leaves where a function with a struct result is always inlined.
export OCLGRIND_BUILD_OPTIONS='-cl-opt-disable -Dalways_inline=unused'
failures=0
runs=0
at_work=0

# findings LOG: the first line of each. One race is meant and left out: draw_mesh reads a key before it
# lowers it by atomic_min, and since keys only fall, an old value costs an atomic and nothing else.
findings() {
  awk '/^[^\t]/ {if (held != "") print held; held = $0}
    /Kernel: draw_mesh/ && held ~ /^Read-write data race/ {held = ""}
    END {if (held != "") print held}' "$1"
}

# under_one FOLDER NAME CHECK=1 MACULA-ARGUMENT...: one run in a folder of its own; fails on a finding.
under_one() {
  local name=$2 check=$3 log=$1/log out=$1/out
  mkdir "$1"
  cd "$1"
  shift 3
  : >"$log"
  if ! env "$check" OCLGRIND_LOG="$log" LD_PRELOAD="$scratch/fill.so:$runtime" \
    timeout 300 "$macula" "$@" --device 0 >"$out" 2>&1; then
    printf 'oclgrind: %s, %s: macula failed\n%s\n' "$name" "$check" "$(tail -n 5 "$out")"
    return 1
  elif [[ -n $(findings "$log") ]]; then
    printf 'oclgrind: %s, %s:\n%s\n' "$name" "$check" "$(head -n 12 "$log")"
    return 1
  fi
}

collect() {
  wait -n || failures=$((failures + 1))
  at_work=$((at_work - 1))
}

# under NAME CHECK=1 MACULA-ARGUMENT...: CHECK is OCLGRIND_DATA_RACES or OCLGRIND_UNINITIALIZED. As
# many runs as there are processors go side by side: Oclgrind uses one each.
under() {
  ((at_work < $(nproc))) || collect
  runs=$((runs + 1))
  under_one "$scratch/$runs" "$@" &
  at_work=$((at_work + 1))
}

races=OCLGRIND_DATA_RACES=1
uninitialised=OCLGRIND_UNINITIALIZED=1
picture=(--size 16x16 --out pictures)
frame=(render cornell "${picture[@]}")
# Read first: a process that gives lines would be one of those that `wait -n` waits for.
variants=$("$macula" variants --names)
methods=$("$macula" explain)
printf '%s\n' 'width = 16' 'height = 16' '[screen]' 'width_mm = 90' 'distance_mm = 45' \
  '[distortion]' 'red = [0.1]' 'green = [0.2, 0.1]' >"$scratch/lens.toml"
aovs=albedo,irradiance,depth,position,normal,shading_normal,triangle,material,motion

# Not for uninitialised reads: of two prefix sums, 256 and then 4095 elements, Oclgrind 21.10 calls
# the second one's input uninitialised, and of the second one alone it does not. The frames below
# run the same kernels.
under 'layout, arithmetic and prefix sum' "$races" selftest --quick
for check in "$races" "$uninitialised"; do
  for lights in point area soft ao; do
    under "cornell, $lights lights" "$check" "${frame[@]}" --lights "$lights"
  done
  under 'highlights and every image' "$check" render whitted "${picture[@]}" --aov "$aovs"
  while read -r variant; do
    # Oclgrind 21.10 itself crashes in its check for uninitialised reads of these three.
    if [[ $check == "$uninitialised" && $variant =~ ^(packet|stream) ]]; then
      continue
    fi
    under "variant $variant" "$check" "${frame[@]}" --lights point --variant "$variant"
  done <<<"$variants"
done
while read -r method _; do
  # Two frames: the second one reads the first one's history.
  under "method $method" "$races" render whitted --size 24x24 --out pictures \
    --frames 0:2 --method "$method"
done <<<"$methods"
# Not for uninitialised reads: with that check, Oclgrind 21.10 crashes in the kernel `prewarp`.
under 'a lens' "$races" "${frame[@]}" --display "$scratch/lens.toml" --distort
under 'textures' "$races" render tunnel_maps "${picture[@]}" --lights ao

while ((at_work > 0)); do
  collect
done
echo "oclgrind: $runs runs, $failures with findings"
((failures == 0))
