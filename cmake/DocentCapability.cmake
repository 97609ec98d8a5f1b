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
# sources, where DOCENT_UNITY is on. So no two of them may call different things by one name, in unnamed namespaces
# either; tests that do have a namespace each, named after the file.
#
# There, and where nothing is sanitized (DOCENT_JOINT), the sources of several folders are compiled as one file, too
# (docent_joint_sources), and their tests are one program (docent_joint_tests); that of each folder is built only when it is
# asked for by its name. What a folder sees is left to tests/architecture/check_includes.py then.

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

set(DOCENT_GENERATED ${CMAKE_BINARY_DIR}/generated)  # what the build makes for a source to include
file(MAKE_DIRECTORY ${DOCENT_GENERATED})
target_include_directories(docent_options INTERFACE ${DOCENT_GENERATED})

set(DOCENT_JOINT OFF)
if(DOCENT_UNITY AND NOT DOCENT_SANITIZE)
  set(DOCENT_JOINT ON)
endif()
add_library(docent_foreign INTERFACE)  # the third-party libraries of all folders
add_library(docent_joint INTERFACE)    # where DOCENT_JOINT is on, all that is linked

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

function(docent_unit_test name target)
  add_test(NAME ${name} COMMAND ${target})
  set_tests_properties(${name} PROPERTIES LABELS unit TIMEOUT 600 WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
endfunction()

# docent_groups(FOLDERS SUFFIX MOST RESULT): which folders are compiled as one file, as a list of "a+b+c": joint_groups.py says
# it of the sources of their targets with SUFFIX.
function(docent_groups folders suffix most result)
  set(lines)
  foreach(folder IN LISTS folders)
    docent_target_name(${folder} target)
    get_target_property(sources ${target}${suffix} SOURCES)
    list(JOIN sources " " sources)
    string(APPEND lines "${folder} ${sources}\n")
  endforeach()
  file(WRITE ${CMAKE_BINARY_DIR}/joint_folders.txt "${lines}")
  execute_process(COMMAND python3 ${CMAKE_SOURCE_DIR}/cmake/joint_groups.py ${most} INPUT_FILE ${CMAKE_BINARY_DIR}/joint_folders.txt
    OUTPUT_VARIABLE groups COMMAND_ERROR_IS_FATAL ANY OUTPUT_STRIP_TRAILING_WHITESPACE)
  string(REPLACE " " "+" groups "${groups}")
  string(REPLACE "\n" ";" groups "${groups}")
  set(${result} ${groups} PARENT_SCOPE)
endfunction()

# docent_take_over(JOINT TARGET): the sources of TARGET, and what has to be built before them, become those of JOINT, too.
# Sources with options of their own are compiled alone.
function(docent_take_over joint target)
  get_target_property(sources ${target} SOURCES)
  target_sources(${joint} PRIVATE ${sources})
  foreach(source IN LISTS sources)
    foreach(property COMPILE_OPTIONS COMPILE_DEFINITIONS)
      get_source_file_property(value ${source} TARGET_DIRECTORY ${target} ${property})
      if(value)
        set_source_files_properties(${source} PROPERTIES ${property} "${value}")
      endif()
    endforeach()
  endforeach()
  get_target_property(programs ${target} MANUALLY_ADDED_DEPENDENCIES)
  if(programs)
    add_dependencies(${joint} ${programs})
  endif()
endfunction()

# docent_joint_sources(): the libraries of DOCENT_JOINT, which are linked as a whole.
set(DOCENT_HOT_OPTIONS -fno-math-errno -fno-trapping-math -fno-tree-slp-vectorize)
function(docent_joint_sources)
  set(joints)
  foreach(hot TRUE FALSE)
    get_property(folders GLOBAL PROPERTY DOCENT_JOINT_${hot})
    docent_groups("${folders}" "" 32 groups)
    foreach(group IN LISTS groups)
      list(LENGTH joints count)
      set(joint docent_joint_${count})
      list(APPEND joints ${joint})
      add_library(${joint} STATIC)
      set_target_properties(${joint} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
      if(hot)
        target_compile_options(${joint} PRIVATE ${DOCENT_HOT_OPTIONS})
      else()
        target_compile_options(${joint} PRIVATE -O1)  # a quarter of the compiler's time; inner loops are in HOT folders
      endif()
      target_include_directories(${joint} PRIVATE ${CMAKE_SOURCE_DIR}/src)
      target_link_libraries(${joint} PRIVATE docent_options docent_foreign)
      string(REPLACE "+" ";" members ${group})
      foreach(folder IN LISTS members)
        docent_target_name(${folder} target)
        docent_take_over(${joint} ${target})
      endforeach()
    endforeach()
  endforeach()
  list(JOIN joints "," all)
  target_link_libraries(docent_joint INTERFACE "$<LINK_GROUP:RESCAN,${all}>" docent_foreign)
endfunction()

# docent_joint_tests(): the programs of DOCENT_JOINT; a test's name lists the folders.
function(docent_joint_tests)
  get_property(folders GLOBAL PROPERTY DOCENT_TESTED)
  docent_groups("${folders}" _test 28 groups)  # not more: two processors shall have something to do until the end
  set(count 0)
  foreach(group IN LISTS groups)
    set(joint docent_tests_${count})
    math(EXPR count "${count} + 1")
    add_executable(${joint})
    set_target_properties(${joint} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
    target_compile_options(${joint} PRIVATE -O0 -g0)  # a quarter of the compiler's time
    string(REPLACE "+" ";" members ${group})
    foreach(folder IN LISTS members)
      docent_target_name(${folder} target)
      docent_take_over(${joint} ${target}_test)
      target_link_libraries(${joint} PRIVATE $<TARGET_PROPERTY:${target}_test,LINK_LIBRARIES>)
      target_compile_definitions(${joint} PRIVATE $<TARGET_PROPERTY:${target}_test,COMPILE_DEFINITIONS>)
    endforeach()
    docent_unit_test(${group} ${joint})
  endforeach()
endfunction()

function(docent_capability folder)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "HOT;LABORATORY" "" "SOURCES;DEPENDS;LIBRARIES;TEST_DEPENDS;TEST_LIBRARIES")
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

  if(DOCENT_JOINT)
    set(include_root ${CMAKE_SOURCE_DIR}/src)
  else()
    set(include_root ${CMAKE_BINARY_DIR}/include/${target})
    get_filename_component(parent docent/${folder} DIRECTORY)
    file(MAKE_DIRECTORY ${include_root}/${parent})
    file(CREATE_LINK ${directory} ${include_root}/docent/${folder} SYMBOLIC)
  endif()

  set(dependency_targets)
  foreach(dependency IN LISTS ARG_DEPENDS)
    docent_target_name(${dependency} dependency_target)
    list(APPEND dependency_targets ${dependency_target})
  endforeach()

  if(files AND NOT DOCENT_JOINT)
    add_library(${target} STATIC ${files})
    if(DOCENT_UNITY)
      set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
    endif()
    set(scope PUBLIC)
    if(ARG_HOT)
      target_compile_options(${target} PRIVATE ${DOCENT_HOT_OPTIONS})
    endif()
  else()
    add_library(${target} INTERFACE ${files})
    set(scope INTERFACE)
  endif()
  target_include_directories(${target} ${scope} ${include_root})
  target_link_libraries(${target} ${scope} docent_options ${dependency_targets} ${ARG_LIBRARIES})
  if(DOCENT_JOINT)
    target_link_libraries(${target} INTERFACE docent_joint)
    target_link_libraries(docent_foreign INTERFACE ${ARG_LIBRARIES})
    if(files)
      set_property(GLOBAL APPEND PROPERTY DOCENT_JOINT_${ARG_HOT} ${folder})
    endif()
  endif()

  if(DOCENT_TESTS AND tests)
    set(test_dependency_targets)
    foreach(dependency IN LISTS ARG_TEST_DEPENDS)
      docent_target_name(${dependency} dependency_target)
      list(APPEND test_dependency_targets ${dependency_target})
    endforeach()
    add_executable(${target}_test ${tests})
    set_target_properties(${target}_test PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
    # Tests are half of all there is to compile, and what takes them long lies in the libraries.
    if(NOT DOCENT_SANITIZE)
      target_compile_options(${target}_test PRIVATE -O1 -g0)
    endif()
    target_link_libraries(${target}_test PRIVATE ${target} ${test_dependency_targets} ${ARG_TEST_LIBRARIES} GTest::gtest_main)
    if(DOCENT_JOINT)
      set_target_properties(${target}_test PROPERTIES EXCLUDE_FROM_ALL ON)
      set_property(GLOBAL APPEND PROPERTY DOCENT_TESTED ${folder})
    else()
      docent_unit_test(${folder} ${target}_test)
    endif()
  endif()
  if(DOCENT_TESTS AND benchmarks)
    if(DOCENT_JOINT)  # compiled, so that they keep up with what they call; scripts/bench measures another build
      add_library(${target}_benchmark OBJECT ${benchmarks})
      target_compile_options(${target}_benchmark PRIVATE -O0 -g0)
    else()
      add_executable(${target}_benchmark ${benchmarks})
    endif()
    target_link_libraries(${target}_benchmark PRIVATE ${target} benchmark::benchmark_main)
  endif()
  foreach(fuzzer IN LISTS fuzzers)
    docent_fuzzer(${target}_${fuzzer}_fuzzer ${directory}/${fuzzer}_fuzzer.cpp ${target})
  endforeach()
endfunction()
