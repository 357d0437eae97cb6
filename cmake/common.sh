# Shared by ./demo and ./check: installs what is missing from Debian, configures and builds.
# Sourced by bash; the caller has set -euo pipefail, program, arguments and summary, and stands in
# the repository's root.

# What building and running need; what the tests need; what single parts of ./check need, which are
# left out where it is missing.
build_packages=(
  cmake ninja-build g++ pkg-config
  ocl-icd-opencl-dev opencl-clhpp-headers opencl-c-headers pocl-opencl-icd
  libembree-dev libglm-dev libopenimageio-dev libopenexr-dev libtbb-dev libtinyobjloader-dev
  libtinygltf-dev libtomlplusplus-dev libcli11-dev nlohmann-json3-dev libfmt-dev libxxhash-dev
  libzstd-dev zlib1g-dev libbullet-dev
)
test_packages=(libgtest-dev libgmock-dev)
check_packages=(oclgrind mesa-opencl-icd clang libclang-rt-14-dev python3-venv
  chromium snakemake)

say() { printf '%s: %s\n' "$program" "$*"; }

missing_packages() {
  local package
  for package in "$@"; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || echo "$package"
  done
}

# install_packages PACKAGE...: says what it installs, then installs it; with --no-install, or where
# it may not, it fails and names the missing packages.
install_packages() {
  local -a missing
  mapfile -t missing < <(missing_packages "$@")
  ((${#missing[@]} == 0)) && return 0
  if [[ $may_install == no ]]; then
    say "missing packages (--no-install was given): ${missing[*]}" >&2
    return 1
  fi
  local -a as_root=()
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      say "missing packages, and neither root nor sudo to install them: ${missing[*]}" >&2
      return 1
    fi
    as_root=(sudo)
  fi
  say "installing from Debian: ${missing[*]}"
  if ! { "${as_root[@]}" apt-get update -qq &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
      apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null; }; then
    say "apt-get could not install them (see above): ${missing[*]}" >&2
    return 1
  fi
}

# build PRESET [CMAKE-OPTION...]: configures by CMakePresets.json and builds what is out of date;
# build/PRESET.log says what happened.
build() {
  local preset=$1 directory=build/$1 log=build/$1.log
  shift
  mkdir -p build
  say "building $directory (log: $log)"
  if ! { cmake --preset "$preset" "$@" && cmake --build --preset "$preset"; } >"$log" 2>&1; then
    tail -n 40 "$log" >&2
    say "the build of $directory failed; the whole log is in $log" >&2
    return 1
  fi
}

usage() {
  printf 'usage: ./%s %s\n%s\n' "$program" "$arguments" "$summary"
}

parse_options() {
  may_install=yes
  local option
  for option in "$@"; do
    case $option in
      --no-install) may_install=no ;;
      -h | --help) usage; exit 0 ;;
      *) usage >&2; exit 2 ;;
    esac
  done
}
