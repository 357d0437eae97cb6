#!/usr/bin/env bash
# Measures a tiny case, makes its report and loads it in a browser: nothing on the console, nothing
# asked for, everything drawn. Then two pages that are wrong on purpose, which must be found out.
# Usage: report.sh BUILD-DIRECTORY [FOLDER]; with FOLDER the page and screenshots are left there.
set -euo pipefail
build=$(realpath "$1")
tests=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
if ! command -v chromium >/dev/null; then
  echo 'report: skipped: chromium is not installed'
  exit 77
fi
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
folder=${2:-$scratch}
mkdir -p "$folder"
"$build/macula" bench quality --scenes cornell --size 96x96 --frames 3 --segments 1 --warm-up 1 \
  --reference-spp 4 --gaze synthetic --head scene --out "$scratch"
"$build/macula" report "$scratch/results.jsonl" -o "$folder/report.html"
"$tests/browser.py" "$folder/report.html" --screenshots "$folder/screenshots"
echo 'report: the page is whole'

# must_fail NAME SED-SCRIPT: the page with that change is refused.
must_fail() {
  sed "$2" "$folder/report.html" >"$scratch/$1.html"
  if "$tests/browser.py" "$scratch/$1.html" >"$scratch/said"; then
    echo "report: a page that is wrong on purpose was not found out: $1"
    exit 1
  fi
  echo "report: found out, as it should be: $(head -n 1 "$scratch/said")"
}
must_fail exception 's/^facts();$/missing_function();/'
must_fail outside 's#</body>#<img src="http://127.0.0.1:9/x.png"></body>#'
