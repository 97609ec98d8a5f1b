# What is installed, in components. `program` can be moved as a whole: the program looks for share/docent beside
# itself (src/docent/base/shipped_files.h), where names are those of the source tree. `cmake --install build/release
# --prefix DIR` installs it. `system` belongs to the Debian package alone: unit, /etc, manual. `library` is that of
# DocentLibrary.cmake, `python` that of the Python package; each is a Debian package of its own, with what belongs to that alone
# in `library_system` and `python_system`.
include(GNUInstallDirs)
set(DOCENT_MAINTAINER "The Docent maintainers")
set(DOCENT_MAINTAINER_EMAIL "maintainers@docent.example")
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)  # the tests are not shipped
set(CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS  # whatever the umask
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(share ${CMAKE_INSTALL_DATADIR}/docent)
set(packaging ${DOCENT_ROOT}/packaging)
set(generated ${DOCENT_BINARY_DIR}/packaging)
file(MAKE_DIRECTORY ${generated})

install(TARGETS docent RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(DIRECTORY web/dist DESTINATION ${share}/web COMPONENT program)
install(DIRECTORY share/dds share/lichtblick share/nginx DESTINATION ${share} COMPONENT program)
install(DIRECTORY museums robots DESTINATION ${share} COMPONENT program)
install(DIRECTORY prolog DESTINATION ${share} COMPONENT program PATTERN tests EXCLUDE)
file(GLOB documents docs/*.md docs/robot.yaml)
install(FILES ${documents} DESTINATION ${share}/docs COMPONENT program)
install(FILES README.md LICENSE CHANGELOG.md DESTINATION ${share} COMPONENT program)

# For programs of others.
configure_file(${packaging}/docent_msgs/package.xml.in ${generated}/package.xml @ONLY)
install(FILES ${DOCENT_BINARY_DIR}/idl/docent.idl DESTINATION ${share} COMPONENT program)
install(DIRECTORY ${DOCENT_BINARY_DIR}/idl/docent_msgs DESTINATION ${share} COMPONENT program)
install(FILES ${packaging}/docent_msgs/CMakeLists.txt ${generated}/package.xml DESTINATION ${share}/docent_msgs
  COMPONENT program)

configure_file(${packaging}/docent_ros/package.xml.in ${generated}/docent_ros/package.xml @ONLY)
install(DIRECTORY ${packaging}/docent_ros DESTINATION ${share} COMPONENT program
  PATTERN package.xml.in EXCLUDE PATTERN library.txt EXCLUDE PATTERN __pycache__ EXCLUDE)
install(FILES ${generated}/docent_ros/package.xml DESTINATION ${share}/docent_ros COMPONENT program)
file(STRINGS ${packaging}/docent_ros/library.txt library_of_docent_ros)
foreach(file IN LISTS library_of_docent_ros)
  string(REGEX REPLACE "^(include|src)/(.*)/[^/]*$" "\\2" folder ${file})
  install(FILES ${file} DESTINATION ${share}/docent_ros/library/${folder} COMPONENT program)
endforeach()

# Of what `system` needs, the build makes the manual, of what the program says of itself, and a robot.yaml in which all
# defaults stand as comments. scripts/package builds docent_package_files; others need no help2man.
add_custom_command(
  OUTPUT ${generated}/docent.1.gz
  COMMAND help2man --no-info --name "autonomous museum tour guide" --output ${generated}/docent.1 $<TARGET_FILE:docent>
  COMMAND gzip -9nf ${generated}/docent.1
  DEPENDS docent)
add_custom_command(
  OUTPUT ${generated}/robot.yaml
  COMMAND sed "s/^[^#]/#&/" ${DOCENT_ROOT}/docs/robot.yaml > ${generated}/defaults
  COMMAND cat ${packaging}/debian/robot.yaml.head ${generated}/defaults > ${generated}/robot.yaml
  DEPENDS docs/robot.yaml ${packaging}/debian/robot.yaml.head
  VERBATIM)
string(TIMESTAMP DOCENT_DATE "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file(${packaging}/debian/changelog.in ${generated}/changelog @ONLY)
add_custom_command(
  OUTPUT ${generated}/changelog.gz
  COMMAND gzip -9nc ${generated}/changelog > ${generated}/changelog.gz
  DEPENDS ${generated}/changelog)
add_custom_target(docent_package_files
  DEPENDS docent docent_idl docent_library ${generated}/docent.1.gz ${generated}/robot.yaml ${generated}/changelog.gz)
if(DOCENT_PYTHON)
  add_dependencies(docent_package_files docent_python)
endif()

set(system COMPONENT system EXCLUDE_FROM_ALL)
install(FILES ${packaging}/debian/docent.service DESTINATION lib/systemd/system ${system})
install(FILES ${generated}/robot.yaml DESTINATION /etc/docent ${system})
install(FILES ${packaging}/debian/default DESTINATION /etc/default RENAME docent ${system})
install(FILES ${generated}/docent.1.gz DESTINATION share/man/man1 ${system})
install(FILES ${packaging}/debian/copyright ${generated}/changelog.gz DESTINATION share/doc/docent ${system})
install(FILES ${packaging}/debian/lintian-overrides DESTINATION share/lintian/overrides RENAME docent ${system})

# The examples, with the museum that they take, and what every Debian package says of itself.
set(dev ${CMAKE_INSTALL_DATADIR}/doc/libdocent-dev)
set(library_system COMPONENT library_system EXCLUDE_FROM_ALL)
install(DIRECTORY examples DESTINATION ${dev} ${library_system})
install(DIRECTORY museums/bonn DESTINATION ${dev}/examples/museums ${library_system} PATTERN simulation.yaml EXCLUDE)
install(FILES docs/library.md DESTINATION ${dev} ${library_system})
install(FILES ${packaging}/debian/copyright ${generated}/changelog.gz DESTINATION ${dev} ${library_system})
if(DOCENT_PYTHON)
  install(FILES ${packaging}/debian/copyright ${generated}/changelog.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-docent
    COMPONENT python_system EXCLUDE_FROM_ALL)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME docent)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "${DOCENT_MAINTAINER} <${DOCENT_MAINTAINER_EMAIL}>")
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS OFF)  # but where a package says so
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
# Packages of components: only so cpack takes what is left out of a plain `cmake --install`.
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_COMPONENTS_ALL)

# docent_debian(PACKAGE COMPONENTS…): a Debian package of these components; CPACK_DEBIAN_PACKAGE_… with its name in capitals
# instead of PACKAGE say the rest.
macro(docent_debian package)
  string(TOUPPER ${package} group)
  set(CPACK_DEBIAN_${group}_PACKAGE_NAME ${package})
  foreach(component ${ARGN})
    string(TOUPPER ${component} name)
    set(CPACK_COMPONENT_${name}_GROUP ${package})
    list(APPEND CPACK_COMPONENTS_ALL ${component})
  endforeach()
endmacro()

docent_debian(docent program system)
set(CPACK_DEBIAN_DOCENT_DESCRIPTION
"autonomous museum tour guide
Docent is the software of a robot that guides visitors through a museum. The
robot finds out where it is in a hall full of people, drives at walking speed
without touching anything, gives tours, and lets visitors on the Web take part.
.
The package holds the program, its page, two museums with a simulated world
each, a systemd unit, and the messages for DDS and ROS 2.")
set(CPACK_DEBIAN_DOCENT_PACKAGE_SECTION science)
set(CPACK_DEBIAN_DOCENT_PACKAGE_SHLIBDEPS ON)
# A program that is started, and no library that is linked.
set(CPACK_DEBIAN_DOCENT_PACKAGE_DEPENDS "swi-prolog-core")
# Without espeak-ng it has no voice, without the fonts pictures have no letters; alsa-utils names the sound cards.
set(CPACK_DEBIAN_DOCENT_PACKAGE_RECOMMENDS "espeak-ng, fonts-dejavu-core")
set(CPACK_DEBIAN_DOCENT_PACKAGE_SUGGESTS "alsa-utils")
set(CPACK_DEBIAN_DOCENT_PACKAGE_CONTROL_EXTRA
  ${packaging}/debian/postinst ${packaging}/debian/prerm ${packaging}/debian/postrm ${packaging}/debian/conffiles)

docent_debian(libdocent-dev library library_system)
set(CPACK_DEBIAN_LIBDOCENT-DEV_DESCRIPTION
"autonomous museum tour guide: library for programs in C++
Bricks of the tour guide for robots of others: localization in a map by grids
and samples, maps from logs, planning by value iteration, the dynamic window
with virtual measurements, people, tours, a bus over DDS or in virtual time.
.
The package holds headers, static libraries, what find_package(docent) needs,
and examples.")
set(CPACK_DEBIAN_LIBDOCENT-DEV_PACKAGE_SECTION libdevel)
# What docentConfig.cmake finds, and what the headers include.
set(CPACK_DEBIAN_LIBDOCENT-DEV_PACKAGE_DEPENDS "cyclonedds-dev, libceres-dev, libeigen3-dev, libexpected-dev, libpng-dev, \
libsqlite3-dev, libbz2-dev, liblz4-dev, libyaml-cpp-dev, libzstd-dev, swi-prolog-core, zlib1g-dev")
set(CPACK_DEBIAN_LIBDOCENT-DEV_PACKAGE_RECOMMENDS "cmake, g++")

if(DOCENT_PYTHON)
  docent_debian(python3-docent python python_system)
  set(CPACK_DEBIAN_PYTHON3-DOCENT_DESCRIPTION
"autonomous museum tour guide: library for Python
Bricks of the tour guide for notebooks and experiments: maps, sensor models,
localization, planning and recordings, with arrays of NumPy.")
  set(CPACK_DEBIAN_PYTHON3-DOCENT_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON3-DOCENT_PACKAGE_SHLIBDEPS ON)
  # The module is for the interpreter that built it.
  execute_process(COMMAND ${PYTHON_EXECUTABLE} -c
    "from sys import version_info as v; print(f'python3 (>= {v[0]}.{v[1]}), python3 (<< {v[0]}.{v[1] + 1})')"
    OUTPUT_VARIABLE interpreter OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  set(CPACK_DEBIAN_PYTHON3-DOCENT_PACKAGE_DEPENDS "${interpreter}, python3-numpy")
  set(CPACK_DEBIAN_PYTHON3-DOCENT_PACKAGE_RECOMMENDS "docent")  # which simulate() runs
  set(CPACK_DEBIAN_PYTHON3-DOCENT_PACKAGE_CONTROL_EXTRA ${packaging}/python/postinst ${packaging}/python/prerm)
endif()
include(CPack)
