#!/usr/bin/env bash
# Runs the Snakemake workflow on a tiny sweep: every case is a job, a second run has nothing to do,
# a case that was removed is run again alone. Usage: sweep.sh BUILD-DIRECTORY
set -euo pipefail
build=$(realpath "$1")
repository=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../..")
if ! command -v snakemake >/dev/null; then
  echo 'sweep: skipped: snakemake is not installed'
  exit 77
fi
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cat >"$scratch/tiny.yaml" <<CONFIG
macula: $build/macula
scenes: [cornell]
lights: [area]
cases: {full: --methods full, weier: --methods weier, lowres: --methods lowres --equal samples}
options: --size 96x96 --frames 2 --segments 1 --warm-up 1 --reference-spp 4 --gaze synthetic
  --head scene
report: --title Sweep
CONFIG

# sweep: runs what is missing and prints how many cases that were.
sweep() {
  if ! snakemake -s "$repository/bench/sweep/Snakefile" --configfile "$scratch/tiny.yaml" \
    --cores 1 --directory "$scratch/sweep" >"$scratch/log" 2>&1; then
    cat "$scratch/log" >&2
    tail -n 5 "$scratch"/sweep/results/*/*/*/log >&2 || true
    return 1
  fi
  grep -c '^rule case:' "$scratch/log" || true
}
# expect WHAT FOUND WANTED
expect() {
  if [[ $2 != "$3" ]]; then
    echo "sweep: $1: $2 cases ran, $3 were expected"
    exit 1
  fi
}
expect 'the first run' "$(sweep)" 3
expect 'a run with nothing to do' "$(sweep)" 0
rm -r "$scratch"/sweep/{results/cornell/area/weier,report.html}
expect 'a run after one case was removed' "$(sweep)" 1
grep -q '<h1>Sweep</h1>' "$scratch/sweep/report.html"
for name in full 'weier medium' 'lowres, equal samples'; do
  grep -q "\"case\":\"$name\"" "$scratch/sweep/report.html"
done
echo 'sweep: three cases and their report, again where one was missing'
