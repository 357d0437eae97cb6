#!/usr/bin/env bash
# Runs every command of the documents: each line of a ```sh block that starts with "build/" or
# "macula". Lines that need material this checkout does not have (../shared) are skipped by name.
# Usage: documents.sh BUILD-DIRECTORY
set -euo pipefail
macula=$(realpath "$1/macula")
repository=$PWD
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
ran=0 skipped=0 failed=0
while IFS= read -r line; do
  command=${line#build/release/macula}
  command=${command#macula}
  if [[ $command == *'../shared'* && ! -d $repository/../shared ]]; then
    skipped=$((skipped + 1))
    continue
  fi
  command=${command//..\/shared/$repository/../shared}
  ran=$((ran + 1))
  if ! (eval "timeout 600 '$macula' $command") >out.log 2>&1; then
    failed=$((failed + 1))
    printf 'documents: failed: %s\n' "$line"
    tail -n 3 out.log
  fi
done < <(cat "$repository"/README.md "$repository"/docs/*.md |
  awk '/^```/ {inside = ($0 == "```sh")} inside' |
  grep -E '^(build/release/)?macula ' | sort -u)
echo "documents: $ran commands ran, $skipped skipped, $failed failed"
((failed == 0 && ran > 0))
