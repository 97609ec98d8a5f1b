# One target per folder. A folder sees its own headers and those of the folders it names in DEPENDS, and nothing else:
# each target gets an include directory of its own, built/include/<target>, which holds links to just those folders.
#
#   docent_capability(localization/markov
#     SOURCES belief_grid sensor_update   # NAME.h and/or NAME.cpp; NAME_test.cpp is added where it exists,
#     DEPENDS grid motion_models          # NAME_benchmark.cpp and NAME_fuzzer.cpp likewise
#     LIBRARIES yaml-cpp                  # third-party libraries
#     HOT)                                # inner loops: roots and sines set no errno, comparisons trap nothing. The values
#                                         # are the same, and compilers may take such calls out of a loop. No vectors of two
#                                         # from the coordinates of one point: to read back together what a call has just
#                                         # stored apart takes longer than they save
#
# A folder's tests are compiled as one file, for most of their time goes into reading the same headers; so are its
# sources, where DOCENT_UNITY is on. Where two of them call different things by one name in their unnamed namespaces,
# the folder says TESTS_APART or SOURCES_APART.

add_library(docent_options INTERFACE)
# -ffp-contract=off: the same arithmetic with and without FMA, so that a seed gives the same run on every CPU.
target_compile_options(docent_options INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow -ffp-contract=off)
if(DOCENT_WARNINGS_AS_ERRORS)
  target_compile_options(docent_options INTERFACE -Werror)
endif()
if(DOCENT_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)  # a joint file includes what is in truth its own
  target_compile_options(docent_options INTERFACE -Wno-subobject-linkage)
endif()
if(DOCENT_SANITIZE)
  target_compile_options(docent_options INTERFACE -fsanitize=${DOCENT_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(docent_options INTERFACE -fsanitize=${DOCENT_SANITIZE})
endif()
if(DOCENT_SANITIZE MATCHES undefined AND CMAKE_CXX_COMPILER_ID MATCHES Clang)  # a third of the compiler's time
  target_compile_options(docent_options INTERFACE -fsanitize-ignorelist=${CMAKE_SOURCE_DIR}/cmake/not-ours.ignorelist)
endif()
if(DOCENT_FUZZERS)  # a fuzzer that does not see which way its input took finds nothing
  target_compile_options(docent_options INTERFACE -fsanitize=fuzzer-no-link)
endif()

set(DOCENT_SOURCE_ROOT ${CMAKE_SOURCE_DIR}/src/docent)

# docent_fuzzer(NAME SOURCE LIBRARY): a program in a build for fuzzing; other builds with tests compile its source, so
# that it keeps up with what it calls. Not so where folders are compiled as one file: scripts/test, which asks for
# that, also builds them for fuzzing.
function(docent_fuzzer name source library)
  if(DOCENT_FUZZERS)
    add_executable(${name} ${source})
    target_link_options(${name} PRIVATE -fsanitize=fuzzer)
    set_property(GLOBAL APPEND PROPERTY DOCENT_FUZZERS ${name})
  elseif(DOCENT_TESTS AND NOT DOCENT_UNITY)
    add_library(${name} OBJECT ${source})
  else()
    return()
  endif()
  target_link_libraries(${name} PRIVATE ${library})
endfunction()

function(docent_target_name folder result)
  string(REPLACE "/" "_" name ${folder})
  set(${result} docent_${name} PARENT_SCOPE)
endfunction()

function(docent_capability folder)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "HOT;SOURCES_APART;TESTS_APART" "" "SOURCES;DEPENDS;LIBRARIES;TEST_DEPENDS;TEST_LIBRARIES")
  docent_target_name(${folder} target)
  set(directory ${DOCENT_SOURCE_ROOT}/${folder})

  set(files)
  set(tests)
  set(benchmarks)
  set(fuzzers)
  foreach(source IN LISTS ARG_SOURCES)
    if(NOT EXISTS ${directory}/${source}.cpp AND NOT EXISTS ${directory}/${source}.h)
      message(FATAL_ERROR "${folder}: neither ${source}.h nor ${source}.cpp exists")
    endif()
    if(EXISTS ${directory}/${source}.cpp)
      list(APPEND files ${directory}/${source}.cpp)
    endif()
    if(EXISTS ${directory}/${source}_test.cpp)
      list(APPEND tests ${directory}/${source}_test.cpp)
    endif()
    if(EXISTS ${directory}/${source}_benchmark.cpp)
      list(APPEND benchmarks ${directory}/${source}_benchmark.cpp)
    endif()
    if(EXISTS ${directory}/${source}_fuzzer.cpp)
      list(APPEND fuzzers ${source})
    endif()
  endforeach()

  set(include_root ${CMAKE_BINARY_DIR}/include/${target})
  get_filename_component(parent docent/${folder} DIRECTORY)
  file(MAKE_DIRECTORY ${include_root}/${parent})
  file(CREATE_LINK ${directory} ${include_root}/docent/${folder} SYMBOLIC)

  set(dependency_targets)
  foreach(dependency IN LISTS ARG_DEPENDS)
    docent_target_name(${dependency} dependency_target)
    list(APPEND dependency_targets ${dependency_target})
  endforeach()

  if(files)
    add_library(${target} STATIC ${files})
    if(DOCENT_UNITY AND NOT ARG_SOURCES_APART)
      set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
    endif()
    set(scope PUBLIC)
    if(DOCENT_UNITY AND NOT ARG_HOT AND NOT DOCENT_SANITIZE)
      target_compile_options(${target} PRIVATE -O1)  # a quarter of the compiler's time; inner loops are in HOT folders
    endif()
    if(ARG_HOT)
      target_compile_options(${target} PRIVATE -fno-math-errno -fno-trapping-math -fno-tree-slp-vectorize)
    endif()
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_include_directories(${target} ${scope} ${include_root})
  target_link_libraries(${target} ${scope} docent_options ${dependency_targets} ${ARG_LIBRARIES})

  if(DOCENT_TESTS AND tests)
    set(test_dependency_targets)
    foreach(dependency IN LISTS ARG_TEST_DEPENDS)
      docent_target_name(${dependency} dependency_target)
      list(APPEND test_dependency_targets ${dependency_target})
    endforeach()
    add_executable(${target}_test ${tests})
    if(NOT ARG_TESTS_APART)
      set_target_properties(${target}_test PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
    endif()
    # Tests are half of all there is to compile, and what takes them long lies in the libraries.
    if(NOT DOCENT_SANITIZE)
      target_compile_options(${target}_test PRIVATE -O1 -g0)
    endif()
    target_link_libraries(${target}_test PRIVATE ${target} ${test_dependency_targets} ${ARG_TEST_LIBRARIES} GTest::gtest_main)
    add_test(NAME ${folder} COMMAND ${target}_test)
    set_tests_properties(${folder} PROPERTIES LABELS unit TIMEOUT 600 WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
  endif()
  if(DOCENT_TESTS AND benchmarks)
    add_executable(${target}_benchmark ${benchmarks})
    target_link_libraries(${target}_benchmark PRIVATE ${target} benchmark::benchmark_main)
  endif()
  foreach(fuzzer IN LISTS fuzzers)
    docent_fuzzer(${target}_${fuzzer}_fuzzer ${directory}/${fuzzer}_fuzzer.cpp ${target})
  endforeach()
endfunction()
