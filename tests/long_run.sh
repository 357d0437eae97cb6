#!/usr/bin/env bash
# Method weier over many frames of atrium, with little of the machine: memory flat, no NaN, no
# drift. Usage: tests/long_run.sh [FRAMES (10000)] [BUILD-DIRECTORY (build/release)]
set -euo pipefail
frames=${1:-10000}
build=$(realpath "${2:-build/release}")
if [[ ! $frames =~ ^[1-9][0-9]*$ || ! -x $build/tests/long_run_test ]]; then
  echo "usage: $0 [FRAMES] [BUILD-DIRECTORY]: the build needs the target long_run_test" >&2
  exit 2
fi
MACULA_LONG_RUN_FRAMES=$frames exec nice -n 15 "$build/tests/long_run_test"
