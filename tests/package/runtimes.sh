#!/usr/bin/env bash
# The identity law: the same frames, bit for bit, on every OpenCL implementation that can be had
# here, and with every traversal variant. Usage: runtimes.sh BUILD-DIRECTORY
# PoCL's two CPU devices always; Mesa's rusticl where installed; Intel's CPU runtime from PyPI
# (intel-opencl-rt) where pip can install it into a virtual environment.
set -euo pipefail
macula=$(realpath "$1/macula")
intel=$(realpath "$1")/intel-opencl
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0
compared=0

# hashes ENVIRONMENT... -- MACULA-ARGUMENTS: the frame hashes, one a line
hashes() {
  local -a environment=()
  while [[ $1 != -- ]]; do environment+=("$1"); shift; done
  shift
  timeout 500 env "${environment[@]}" "$macula" render "$@" --out "$scratch/out" --hash | grep '^hash '
}

compare() {
  local name=$1 expected=$2 found=$3
  compared=$((compared + 1))
  if [[ -z $found || $found != "$expected" ]]; then
    printf 'runtimes: %s differs\n  expected %s\n  found    %s\n' "$name" "$expected" "${found:-nothing}"
    failures=$((failures + 1))
  fi
}

install_intel() {
  [[ -e $intel/vendors/intel.icd ]] && return 0
  python3 -m venv "$intel" >/dev/null 2>&1 &&
    "$intel/bin/pip" install -q intel-opencl-rt intel-cmplr-lib-rt >/dev/null 2>&1 || return 1
  local library
  library=$(find "$intel" -name libintelocl.so | head -n 1)
  [[ -n $library ]] || return 1
  mkdir -p "$intel/vendors"
  echo "$library" >"$intel/vendors/intel.icd"
}

# NAME|ENVIRONMENT
runtimes=("pocl basic|POCL_DEVICES=basic")
# rusticl's compiler takes minutes and over 10 GiB for the larger kernels (Mesa 22.3), so there only
# layouts, arithmetic and the prefix sum are compared.
if [[ -e /etc/OpenCL/vendors/rusticl.icd ]]; then
  compared=$((compared + 1))
  if ! RUSTICL_ENABLE=llvmpipe timeout 300 "$macula" selftest --quick --device llvmpipe; then
    echo 'runtimes: the quick self-test fails on rusticl'
    failures=$((failures + 1))
  fi
else
  echo 'runtimes: rusticl skipped (package mesa-opencl-icd is not installed)'
fi
if install_intel; then
  # Its own loader and threads come with it, newer than Debian's.
  runtimes+=("intel cpu|OCL_ICD_VENDORS=$intel/vendors LD_LIBRARY_PATH=$intel/lib")
else
  echo 'runtimes: intel cpu skipped (intel-opencl-rt could not be installed from PyPI)'
fi

small=(--size 96x64 --frames 0:1)
for scene in cornell whitted tunnel_maps; do
  for lights in point area soft ao; do
    expected=$(hashes POCL_DEVICES=pthread -- "$scene" "${small[@]}" --lights "$lights" --device 0)
    for runtime in "${runtimes[@]}"; do
      read -ra environment <<<"${runtime#*|}"
      compare "$scene $lights on ${runtime%%|*}" "$expected" \
        "$(hashes "${environment[@]}" -- "$scene" "${small[@]}" --lights "$lights" --device 0)"
    done
  done
done

# Many levels of rays behind blended layers, more of them than are kept, and the thesis's levels of
# detail, several samples a texel, enlarged.
cat >"$scratch/panes.toml" <<'TOML'
procedural = "cornell_spheres"
[[material]]
name = "mirror"
alpha_mode = "blend"
opacity = 0.4
TOML
deep=("$scratch/panes.toml" --size 96x64 --frames 0:2 --depth 5 --layers 2 --spp 4 --lights soft
  --device 0)
for method in full "logpolar+taa+upscale --lod thesis"; do
  read -ra arguments <<<"$method"
  expected=$(hashes POCL_DEVICES=pthread -- "${deep[@]}" --method "${arguments[@]}")
  for runtime in "${runtimes[@]}"; do
    read -ra environment <<<"${runtime#*|}"
    compare "layers and rays by $method on ${runtime%%|*}" "$expected" \
      "$(hashes "${environment[@]}" -- "${deep[@]}" --method "${arguments[@]}")"
  done
done

# Three frames of a moving view: the second and third read what the ones before left.
while read -r method _; do
  moving=(atrium --size 96x64 --frames 300:303 --lights area --method "$method" --device 0)
  expected=$(hashes POCL_DEVICES=pthread -- "${moving[@]}")
  for runtime in "${runtimes[@]}"; do
    read -ra environment <<<"${runtime#*|}"
    compare "method $method on ${runtime%%|*}" "$expected" \
      "$(hashes "${environment[@]}" -- "${moving[@]}")"
  done
done < <("$macula" explain)

expected=$(hashes POCL_DEVICES=pthread -- atrium --size 160x120 --frames 0:1 --lights ao --device 0)
while read -r variant; do
  compare "atrium with variant $variant" "$expected" \
    "$(hashes POCL_DEVICES=pthread -- atrium --size 160x120 --frames 0:1 --lights ao --device 0 \
      --variant "$variant")"
done < <("$macula" variants --names)

echo "runtimes: $compared comparisons, $failures differ"
((failures == 0))
