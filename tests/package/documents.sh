#!/usr/bin/env bash
# Runs every line of every ```sh block of the documents, as it stands there, in a folder that looks
# like a checkout after ./demo. Lines that need material that is not here (../shared) are counted as
# skipped. Usage: documents.sh BUILD-DIRECTORY
set -euo pipefail
build=$(realpath "$1")
repository=$PWD
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
# Its own cache: `macula tune --quick` must not leave its figures behind.
export MACULA_CACHE_DIR=$scratch/cache
mkdir -p "$scratch/checkout/build"
ln -s "$build" "$scratch/checkout/build/release"
if [[ -d ../shared ]]; then
  ln -s "$(realpath ../shared)" "$scratch/shared"
fi
cd "$scratch/checkout"

commands() {
  awk '/^```/ {inside = ($0 == "```sh"); next} inside && NF && !/^#/ && !seen[$0]++' \
    "$repository"/*.md "$repository"/docs/*.md
}

ran=0 skipped=0 failed=0
while IFS= read -r line; do
  if [[ $line == *'../shared'* && ! -d ../shared ]]; then
    skipped=$((skipped + 1))
    continue
  fi
  ran=$((ran + 1))
  if ! timeout 600 bash -euc "$line" >../log 2>&1 </dev/null; then
    failed=$((failed + 1))
    printf 'documents: failed: %s\n' "$line"
    tail -n 5 ../log
  fi
done < <(commands)
((skipped == 0)) || echo "documents: $skipped commands skipped (they need ../shared, which is not here)"
echo "documents: $ran commands ran, $failed failed"
((failed == 0 && ran > 0))
