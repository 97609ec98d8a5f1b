#!/bin/bash
# Installs libdocent-dev, and python3-docent where there is one, in a Debian that holds nothing else but what they depend on and a
# compiler. There the examples are built with find_package and run, and one of them with add_subdirectory; the tests of the Python package
# run, but for the one that needs the program.
#
#   tests/library/check_library.sh FOLDER_OF_PACKAGES [--mirror]
#
# tests/package/small_debian.sh says what the root is made of. Needs root.
set -uo pipefail
. "$(dirname "$0")/../package/small_debian.sh"
dev=$(echo "$given"/libdocent-dev_*.deb) python=$(echo "$given"/python3-docent_*.deb)
debs=("$dev") names=(libdocent-dev) tools=(cmake g++ make python3-minimal)
[ -f "$python" ] && debs+=("$python") names+=(python3-docent) tools+=(python3 python3-numpy python3-pytest)
make_root "${debs[@]}" -- "${tools[@]}"
cp "${debs[@]}" "$root/tmp/"
expect "dpkg installs what is there with its dependencies and nothing else" inside bash -c 'dpkg -i /tmp/*.deb'
expect "the source tree is not visible" bash -c "! [ -e '$root$PWD' ]"

examples=/usr/share/doc/libdocent-dev/examples
expect "the examples find the package" inside cmake -S $examples -B /tmp/examples
expect "and are built" inside cmake --build /tmp/examples -j "${DOCENT_JOBS:-2}"
for source in "$root$examples"/0*.cpp; do
  name=$(basename "$source" .cpp)
  expect "$name gets the right result" inside bash -c "cd /tmp && examples/$name"
  for wrong in --help "a b"; do
    expect "$name $wrong prints its usage" inside bash -c \
      "said=\$(/tmp/examples/$name $wrong 2>&1); [ \$? = 2 ] && [[ \$said == usage:* && \$said != *$'\n'* ]]"
  done
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
# prints PATTERN COMMAND…: it succeeds, and says this.
prints() {
  local said
  said=$("${@:2}" 2>&1) || { echo "$said"; return 1; }
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
project asks_politely 'find_package(docent REQUIRED COMPONENTS museum OPTIONAL_COMPONENTS teleportation people)' \
  'if(NOT TARGET docent::people OR NOT docent_people_FOUND OR docent_teleportation_FOUND OR TARGET docent::teleportation)' \
  '  message(FATAL_ERROR "what there is of the optional components is not found")' 'endif()' \
  'find_package(docent COMPONENTS teleportation)' 'if(docent_FOUND)' '  message(FATAL_ERROR "found")' 'endif()' \
  'message(STATUS "it goes on")'
expect "without components that are optional, and without docent where it is not required, a project goes on" \
  prints 'it goes on' inside cmake -S /tmp/asks_politely -B /tmp/asks_politely/build

# All components, of each one a name that only its archive has.
project takes_all 'find_package(docent REQUIRED)' 'add_executable(one_of_each one_of_each.cpp)' \
  'list(TRANSFORM docent_COMPONENTS PREPEND docent:: OUTPUT_VARIABLE all)' 'target_link_libraries(one_of_each PRIVATE ${all})' \
  'message(STATUS "${docent_COMPONENTS}")'
cp tests/library/one_of_each.cpp "$root/tmp/takes_all/"
expect "without components it is all of them" prints "$(sed -n 's/^docent_component(\([a-z]*\).*/\1/p' cmake/DocentComponents.cmake | paste -sd';')\$" \
  inside cmake -S /tmp/takes_all -B /tmp/takes_all/build
expect "one name of each is linked" inside cmake --build /tmp/takes_all/build
expect "and works" inside /tmp/takes_all/build/one_of_each

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
  cp -r python/tests "$root/tmp/python-tests"
  expect "and does what its tests ask" prints '^[0-9]+ passed, 1 deselected' inside bash -c "cd $examples && exec python3 -B -m pytest -q \
    -p no:cacheprovider -k 'not test_the_program_itself' /tmp/python-tests"
else
  echo "skipped: the Python package, this build has none (DOCENT_PYTHON)"
fi
expect "dpkg purges what was installed" inside dpkg --purge "${names[@]}"
expect "and nothing of it is left" bash -c "[ -z \"\$(find '$root' -xdev -path '$root/tmp' -prune -o -iname '*docent*' -print | grep -v '/var/log')\" ]"
finish
