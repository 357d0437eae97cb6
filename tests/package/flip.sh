#!/usr/bin/env bash
# FLIP and HDR-FLIP of `macula compare` against flip-evaluator, the authors' own, on rendered frames.
# Usage: flip.sh BUILD-DIRECTORY. The evaluator lives in a virtual environment there; it is installed
# from PyPI where MACULA_PYPI=1 permits that. Exit code 77: it is not to be had.
set -euo pipefail
build=$(realpath "$1")
environment=$build/flip-evaluator

skip() {
  echo "flip: skipped ($1)"
  exit 77
}

has_evaluator() {
  "$environment/bin/python" -c 'import flip_evaluator, numpy' >/dev/null 2>&1
}

if ! has_evaluator; then
  [[ ${MACULA_PYPI:-0} == 1 ]] ||
    skip 'flip-evaluator is not installed; MACULA_PYPI=1 permits its installation from PyPI'
  python3 -m venv "$environment" >/dev/null 2>&1 || skip 'python3 -m venv does not work here'
  "$environment/bin/pip" install -q flip-evaluator==1.7 'numpy<3' >/dev/null 2>&1 || true
  has_evaluator || skip 'flip-evaluator 1.7 could not be installed from PyPI'
fi
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$environment/bin/python" "$(dirname "${BASH_SOURCE[0]}")/flip.py" "$build/macula" "$scratch"
