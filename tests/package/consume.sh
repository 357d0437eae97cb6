#!/usr/bin/env bash
# Installs the built package into a scratch prefix and builds and runs an outside CMake project
# against it: the example of the README. Usage: consume.sh BUILD-DIRECTORY
set -euo pipefail
build=$(realpath "$1")
repository=$PWD
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cmake --install "$build" --prefix "$scratch/prefix" >/dev/null
mkdir "$scratch/project"
# The example is the C++ block of the README, so that what a reader copies is what is tested.
awk '/^```/ {inside = ($0 == "```cpp"); next} inside' "$repository/README.md" \
  >"$scratch/project/example.cpp"
cat >"$scratch/project/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.25)
project(example CXX)
find_package(macula REQUIRED)
add_executable(example example.cpp)
target_link_libraries(example PRIVATE macula::macula)
CMAKE
if ! { cmake -S "$scratch/project" -B "$scratch/build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$scratch/prefix" && cmake --build "$scratch/build"; } \
  >"$scratch/log" 2>&1; then
  tail -n 30 "$scratch/log"
  exit 1
fi
(cd "$scratch" && "$scratch/build/example")
"$scratch/prefix/bin/macula" --version
echo 'consume: the installed package builds and runs the example of the README'
