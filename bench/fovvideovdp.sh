#!/usr/bin/env bash
# FovVideoVDP's verdict (JOD, 10 is no difference) on sequences of PNG frames, one JSON line a clip.
# Usage: fovvideovdp.sh BUILD-DIRECTORY REFERENCE TEST... [--display D] [--eye E] [--gaze SPEC]
#   [--tracker LIST] [--fps N] [--luminance CD/M2] [--contrast C]
# Its licence (CC BY-NC) keeps it out of this repository. It lives in a virtual environment in the
# build directory, installed from PyPI (3.5 GB with PyTorch) where MACULA_PYPI=1 permits that. Exit
# code 77, and the reason: it is not to be had here.
set -euo pipefail
(($# >= 3)) || { sed -n '2,8s/^# \?//p' "$0" >&2; exit 2; }
build=$(realpath "$1")
shift
script=$(dirname "$(realpath "${BASH_SOURCE[0]}")")/fovvideovdp.py
environment=$build/fovvideovdp
clips=$(mktemp)
trap 'rm -f "$clips"' EXIT

skip() {
  echo "fovvideovdp: skipped ($1)"
  exit 77
}

has_metric() {
  "$environment/bin/python" -c 'import pyfvvdp, imageio' >/dev/null 2>&1
}

python3 "$script" prepare "$build/macula" "$@" >"$clips"
if ! has_metric; then
  [[ ${MACULA_PYPI:-0} == 1 ]] ||
    skip 'pyfvvdp is not installed; MACULA_PYPI=1 permits its installation from PyPI, 3.5 GB'
  python3 -m venv "$environment" >/dev/null 2>&1 || skip 'python3 -m venv does not work here'
  # PyTorch 1.13 is the last that comes without the larger part of CUDA.
  "$environment/bin/pip" install -q --no-cache-dir torch==1.13.1 'numpy<2' pyfvvdp==1.2.2 \
    >"$build/fovvideovdp.log" 2>&1 || skip "pip could not install it: see $build/fovvideovdp.log"
  has_metric || skip 'pyfvvdp is installed but cannot be imported'
fi
"$environment/bin/python" "$script" judge <"$clips"
