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
# asked for by its name. What a folder sees is left to tests/architecture/check_includes.py then. Folders are joined within
# one component of the library (DocentComponents.cmake), for each is an archive of its own.
#
# Public headers lie in include/docent/FOLDER, all others beside their sources; both are included as "docent/FOLDER/NAME.h".

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
  target_compile_options(docent_options INTERFACE -fsanitize-ignorelist=${DOCENT_ROOT}/cmake/not-ours.ignorelist)
endif()
if(DOCENT_FUZZERS)  # a fuzzer that does not see which way its input took finds nothing
  target_compile_options(docent_options INTERFACE -fsanitize=fuzzer-no-link)
endif()

set(DOCENT_SOURCE_ROOT ${DOCENT_ROOT}/src/docent)

set(DOCENT_GENERATED ${DOCENT_BINARY_DIR}/generated)  # what the build makes for a source to include
file(MAKE_DIRECTORY ${DOCENT_GENERATED})
target_include_directories(docent_options INTERFACE ${DOCENT_GENERATED})

set(DOCENT_JOINT OFF)
if(DOCENT_UNITY AND NOT DOCENT_SANITIZE)
  set(DOCENT_JOINT ON)
endif()
add_library(docent_foreign INTERFACE)  # the third-party libraries of all folders
foreach(component IN LISTS DOCENT_COMPONENTS ITEMS program laboratory)
  add_library(docent_foreign_${component} INTERFACE)  # those of one component
  target_link_libraries(docent_foreign INTERFACE docent_foreign_${component})
  list(TRANSFORM DOCENT_DEPENDS_OF_${component} PREPEND docent_foreign_ OUTPUT_VARIABLE DOCENT_FOREIGN_TO_${component})
  list(APPEND DOCENT_FOREIGN_TO_${component} docent_foreign_${component})  # what its headers and those of others include
endforeach()
set(DOCENT_FOREIGN_TO_program docent_foreign)
set(DOCENT_FOREIGN_TO_laboratory docent_foreign)
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
  set_tests_properties(${name} PROPERTIES LABELS unit TIMEOUT 600 WORKING_DIRECTORY ${DOCENT_ROOT})
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
  file(WRITE ${DOCENT_BINARY_DIR}/joint_folders.txt "${lines}")
  execute_process(COMMAND python3 ${DOCENT_ROOT}/cmake/joint_groups.py ${most} INPUT_FILE ${DOCENT_BINARY_DIR}/joint_folders.txt
    OUTPUT_VARIABLE groups COMMAND_ERROR_IS_FATAL ANY OUTPUT_STRIP_TRAILING_WHITESPACE)
  string(REPLACE " " "+" groups "${groups}")
  string(REPLACE "\n" ";" groups "${groups}")
  set(${result} ${groups} PARENT_SCOPE)
endfunction()

# docent_join(JOINT SOURCES): gives the target JOINT the SOURCES, joined in one file that includes them by the names that every
# clone has, so that a compiler's cache serves all clones. Those with options of their own, and those that the build
# makes, are compiled alone.
function(docent_join joint sources options)
  set(lines)
  foreach(source IN LISTS sources)
    get_property(own GLOBAL PROPERTY DOCENT_ALONE_${source})
    cmake_path(IS_PREFIX DOCENT_SOURCE_ROOT ${source} is_shipped)
    if(own OR NOT is_shipped)
      target_sources(${joint} PRIVATE ${source})
      set_source_files_properties(${source} PROPERTIES COMPILE_OPTIONS "${options};${own}")
    else()
      cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${DOCENT_ROOT}/src OUTPUT_VARIABLE name)
      string(APPEND lines "#include \"${name}\"\n")
    endif()
  endforeach()
  if(lines)
    get_target_property(count ${joint} DOCENT_JOINED)
    if(NOT count)
      set(count 0)
    endif()
    math(EXPR count "${count} + 1")
    set_target_properties(${joint} PROPERTIES DOCENT_JOINED ${count})
    set(file ${DOCENT_BINARY_DIR}/joint/${joint}_${count}.cpp)
    file(CONFIGURE OUTPUT ${file} CONTENT "${lines}" @ONLY)
    target_sources(${joint} PRIVATE ${file})
    set_source_files_properties(${file} PROPERTIES COMPILE_OPTIONS "${options}")
  endif()
endfunction()

# docent_take_over(JOINT TARGET RESULT): RESULT gets the sources of TARGET; what has to be built before them has to be before
# JOINT, too. Their options and definitions become known to docent_join.
function(docent_take_over joint target result)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    get_source_file_property(options ${source} TARGET_DIRECTORY ${target} COMPILE_OPTIONS)
    get_source_file_property(definitions ${source} TARGET_DIRECTORY ${target} COMPILE_DEFINITIONS)
    set(own)
    if(options)
      list(APPEND own ${options})
    endif()
    if(definitions)
      list(TRANSFORM definitions PREPEND -D)
      list(APPEND own ${definitions})
    endif()
    set_property(GLOBAL PROPERTY DOCENT_ALONE_${source} "${own}")
  endforeach()
  get_target_property(programs ${target} MANUALLY_ADDED_DEPENDENCIES)
  if(programs)
    add_dependencies(${joint} ${programs})
  endif()
  set(${result} ${sources} PARENT_SCOPE)
endfunction()

# docent_joint_sources(): the libraries of DOCENT_JOINT, one for each component. They are linked as a whole.
set(DOCENT_HOT_OPTIONS -fno-math-errno -fno-trapping-math -fno-tree-slp-vectorize)
set(DOCENT_COLD_OPTIONS)
if(DOCENT_TESTS)
  set(DOCENT_COLD_OPTIONS -O1)  # a quarter of the compiler's time; inner loops are in HOT folders
endif()
function(docent_joint_sources)
  set(joints)
  foreach(component IN LISTS DOCENT_COMPONENTS ITEMS program laboratory)
    set(joint docent_joint_${component})
    foreach(hot TRUE FALSE)
      get_property(folders GLOBAL PROPERTY DOCENT_FOLDERS_${component}_${hot})
      if(NOT folders)
        continue()
      endif()
      if(NOT TARGET ${joint})
        add_library(${joint} STATIC)
        target_include_directories(${joint} PRIVATE ${DOCENT_ROOT}/src ${DOCENT_ROOT}/include)
        target_link_libraries(${joint} PRIVATE docent_options ${DOCENT_FOREIGN_TO_${component}})
        if(component STREQUAL laboratory)
          set_target_properties(${joint} PROPERTIES EXCLUDE_FROM_ALL ON)
        else()
          list(APPEND joints ${joint})
        endif()
      endif()
      docent_groups("${folders}" "" 32 groups)
      foreach(group IN LISTS groups)
        string(REPLACE "+" ";" members ${group})
        set(sources)
        foreach(folder IN LISTS members)
          docent_target_name(${folder} target)
          docent_take_over(${joint} ${target} more)
          list(APPEND sources ${more})
        endforeach()
        if(hot)
          docent_join(${joint} "${sources}" "${DOCENT_HOT_OPTIONS}")
        else()
          docent_join(${joint} "${sources}" "${DOCENT_COLD_OPTIONS}")
        endif()
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
    target_compile_options(${joint} PRIVATE -O0 -g0)  # a quarter of the compiler's time
    string(REPLACE "+" ";" members ${group})
    set(sources)
    foreach(folder IN LISTS members)
      docent_target_name(${folder} target)
      docent_take_over(${joint} ${target}_test more)
      list(APPEND sources ${more})
      target_link_libraries(${joint} PRIVATE $<TARGET_PROPERTY:${target}_test,LINK_LIBRARIES>)
      target_compile_definitions(${joint} PRIVATE $<TARGET_PROPERTY:${target}_test,COMPILE_DEFINITIONS>)
    endforeach()
    docent_join(${joint} "${sources}" "")
    docent_unit_test(${group} ${joint})
  endforeach()
endfunction()

function(docent_capability folder)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "HOT;LABORATORY" "" "SOURCES;DEPENDS;LIBRARIES;TEST_DEPENDS;TEST_LIBRARIES")
  docent_target_name(${folder} target)
  set(directory ${DOCENT_SOURCE_ROOT}/${folder})
  docent_component_of(${folder} component)
  if(ARG_LABORATORY)
    set(component laboratory)
  endif()

  set(files)
  set(tests)
  set(benchmarks)
  set(fuzzers)
  foreach(source IN LISTS ARG_SOURCES)
    if(NOT EXISTS ${directory}/${source}.cpp AND NOT EXISTS ${directory}/${source}.h
        AND NOT EXISTS ${DOCENT_ROOT}/include/docent/${folder}/${source}.h)
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
    set(include_roots ${DOCENT_ROOT}/src ${DOCENT_ROOT}/include)
  else()
    set(include_roots ${DOCENT_BINARY_DIR}/include/${target} ${DOCENT_ROOT}/include)
    get_filename_component(parent docent/${folder} DIRECTORY)
    file(MAKE_DIRECTORY ${DOCENT_BINARY_DIR}/include/${target}/${parent})
    file(CREATE_LINK ${directory} ${DOCENT_BINARY_DIR}/include/${target}/docent/${folder} SYMBOLIC)
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
  target_include_directories(${target} ${scope} ${include_roots})
  target_link_libraries(${target} ${scope} docent_options ${dependency_targets} ${ARG_LIBRARIES})
  if(DOCENT_JOINT)
    target_link_libraries(${target} INTERFACE docent_joint)
    target_link_libraries(docent_foreign_${component} INTERFACE ${ARG_LIBRARIES})
    if(component STREQUAL laboratory)
      target_link_libraries(${target} INTERFACE docent_joint_laboratory)
    endif()
    if(files)
      set_property(GLOBAL APPEND PROPERTY DOCENT_FOLDERS_${component}_${ARG_HOT} ${folder})
    endif()
  endif()
  set_property(GLOBAL APPEND PROPERTY DOCENT_TARGETS_${component} ${target})

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
