#!/bin/bash
# Installs libdocent-dev, and python3-docent where there is one, in a Debian that holds nothing else but what they depend on and a
# compiler. There the examples are built with find_package and run, and one of them with add_subdirectory.
#
#   tests/library/check_library.sh FOLDER_OF_PACKAGES [--mirror]
#
# The root is made of this machine's own packages, or with --mirror of the machine's Debian mirror; see tests/package. Needs root.
set -uo pipefail
cd "$(dirname "$0")/../.." || exit 1
packages=$(realpath "$1") mirror=${2:-}
if [ "${CHECK_LIBRARY_ROOT:-}" = "" ]; then
  export CHECK_LIBRARY_ROOT
  CHECK_LIBRARY_ROOT=$(mktemp -d /var/tmp/docent-library-XXXXXX)
  # Mounts and processes go with their namespaces.
  unshare --mount --pid --fork --kill-child "$0" "$@"
  status=$?
  rm -rf --one-file-system "$CHECK_LIBRARY_ROOT"
  exit $status
fi
root=$CHECK_LIBRARY_ROOT/root passed=0 failed=0
dev=$(echo "$packages"/libdocent-dev_*.deb) python=$(echo "$packages"/python3-docent_*.deb)

# expect WHAT COMMAND…: counts it; says what it printed when it fails.
expect() {
  local what=$1 said
  shift
  if said=$("$@" 2>&1); then
    echo "ok: $what"
    passed=$((passed + 1))
  else
    printf 'FAILED: %s\n%s\n' "$what" "$said"
    failed=$((failed + 1))
  fi
}
inside() { env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive chroot "$root" "$@"; }
debs=("$dev") names=(libdocent-dev) tools=(cmake g++ make python3-minimal)
[ -f "$python" ] && debs+=("$python") names+=(python3-docent) tools+=(python3 python3-numpy)

if [ "$mirror" = --mirror ]; then
  scripts/bare-root "$root" || exit 1
  inside apt-get -qq update || exit 1
else
  tests/package/local_root.sh "$root" "$dev" "${tools[@]}" || exit 1
fi
mount -t proc proc "$root/proc"
mount --bind /dev "$root/dev"
mount -t tmpfs -o mode=1777 tmp "$root/tmp"
if [ "$mirror" = --mirror ]; then
  inside apt-get -qq -y --no-install-recommends install "${tools[@]}" >/dev/null || exit 1
  for deb in "${debs[@]}"; do
    inside apt-get -qq -y --no-install-recommends satisfy "$(dpkg-deb -f "$deb" Depends)" >/dev/null || exit 1
  done
fi
cp "${debs[@]}" "$root/tmp/"
expect "dpkg installs what is there with its dependencies and nothing else" inside bash -c 'dpkg -i /tmp/*.deb'
expect "the source tree is not visible" bash -c "! [ -e '$root$PWD' ]"

examples=/usr/share/doc/libdocent-dev/examples
expect "the examples find the package" inside cmake -S $examples -B /tmp/examples
expect "and are built" inside cmake --build /tmp/examples -j "${DOCENT_JOBS:-2}"
for source in "$root$examples"/0*.cpp; do
  name=$(basename "$source" .cpp)
  expect "$name gets the right result" inside bash -c "cd /tmp && examples/$name"
done

# project NAME LINE…: a project of somebody else in the root, /tmp/NAME.
project() {
  mkdir -p "$root/tmp/$1"
  {
    echo 'cmake_minimum_required(VERSION 3.25)'
    echo "project($1 LANGUAGES CXX)"
    printf '%s\n' "${@:2}"
  } >"$root/tmp/$1/CMakeLists.txt"
}
# says PATTERN COMMAND…: it fails, and says this.
says() {
  local said
  said=$("${@:2}" 2>&1) && { echo "it did not fail"; return 1; }
  grep -qE "$1" <<<"$said" || { echo "$said"; return 1; }
}
project asks_too_much 'find_package(docent REQUIRED COMPONENTS planning teleportation)'
expect "a component that is not there is named, and those that are" \
  says 'no component "teleportation"; it has core, models,' inside cmake -S /tmp/asks_too_much -B /tmp/asks_too_much/build
project asks_for_another_version 'find_package(docent 99.0 REQUIRED)'
expect "another version is refused" says 'requested version "99.0"' inside cmake -S /tmp/asks_for_another_version -B /tmp/asks_for_another_version/build
project takes_one 'find_package(docent REQUIRED COMPONENTS planning)' 'if(TARGET docent::mapping OR NOT TARGET docent::models)' \
  '  message(FATAL_ERROR "more than was asked for, or less")' 'endif()'
expect "a component brings what it depends on, and no other" inside cmake -S /tmp/takes_one -B /tmp/takes_one/build

# The source tree as a part of a project: only the folders of the library.
tree=$root/tmp/takes_in/docent
mkdir -p "$tree/src/docent" && cp -r CMakeLists.txt cmake include "$tree/"
cp src/docent/CMakeLists.txt "$tree/src/docent/"
# shellcheck disable=SC2013
for folder in $(sed -n 's/^docent_component(.*FOLDERS \([a-z_/ ]*\).*/\1/p' cmake/DocentComponents.cmake); do
  mkdir -p "$tree/src/docent/$folder" && cp -r "src/docent/$folder/." "$tree/src/docent/$folder/"
done
cp -r "$root$examples" "$root/tmp/takes_in/examples"
project takes_in 'set(CMAKE_BUILD_TYPE Release)' 'add_subdirectory(docent)' 'add_executable(plan examples/03_plan_by_value_iteration.cpp)' \
  'target_link_libraries(plan PRIVATE docent::planning)' "target_compile_definitions(plan PRIVATE DOCENT_MUSEUM=\"$examples/museums/bonn\")"
started=$SECONDS
expect "add_subdirectory takes the library in" inside cmake -S /tmp/takes_in -B /tmp/takes_in/build
expect "its targets are built as far as they are needed" inside cmake --build /tmp/takes_in/build -j "${DOCENT_JOBS:-2}" --target plan
expect "and the program that uses them plans" inside /tmp/takes_in/build/plan
echo "add_subdirectory took $((SECONDS - started)) s with its build"
expect "nothing of docent is installed with the project" inside cmake --install /tmp/takes_in/build --prefix /tmp/installed
expect "and its prefix stays empty" bash -c "[ ! -e '$root/tmp/installed' ] || [ -z \"\$(find '$root/tmp/installed' -type f)\" ]"

if [ -f "$python" ]; then
  expect "python3-docent is imported" inside python3 -c 'import docent; print(docent.__file__)'
fi
expect "dpkg purges what was installed" inside dpkg --purge "${names[@]}"
expect "and nothing of it is left" bash -c "[ -z \"\$(find '$root' -xdev -path '$root/tmp' -prune -o -iname '*docent*' -print | grep -v '/var/log')\" ]"
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
