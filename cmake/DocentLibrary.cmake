# What others link: docent::NAME for each component of DocentComponents.cmake, here and in an installed package. `cmake
# --build build/release --target docent_library` makes the archives, `cmake --install build/release --component library`
# installs them with docentConfig.cmake and headers: the public ones in include/docent, in a folder of their own the
# private ones that these include.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(DOCENT_PRIVATE_HEADERS ${CMAKE_INSTALL_INCLUDEDIR}/docent-private)
set(DOCENT_CONFIG ${CMAKE_INSTALL_LIBDIR}/cmake/docent)

set(described)  # the table of components, as docentConfig.cmake reads it
set(archives)
foreach(component IN LISTS DOCENT_COMPONENTS)
  set(archive docent_joint_${component})
  get_property(members GLOBAL PROPERTY DOCENT_TARGETS_${component})
  set(linked ${archive})
  if(NOT DOCENT_JOINT)
    set(archive docent_archive_${component})
    set(linked ${members})
    add_library(${archive} STATIC EXCLUDE_FROM_ALL)
    foreach(member IN LISTS members)
      get_target_property(type ${member} TYPE)
      if(type STREQUAL STATIC_LIBRARY)
        target_sources(${archive} PRIVATE $<TARGET_OBJECTS:${member}>)
      endif()
    endforeach()
    set_target_properties(${archive} PROPERTIES LINKER_LANGUAGE CXX)
  endif()
  list(APPEND archives ${archive})

  # Users get neither our warnings nor our options: only what they link, and where the headers are.
  add_library(docent_component_${component} INTERFACE)
  add_library(docent::${component} ALIAS docent_component_${component})
  target_compile_features(docent_component_${component} INTERFACE cxx_std_20)
  target_include_directories(docent_component_${component} INTERFACE ${DOCENT_ROOT}/include ${DOCENT_ROOT}/src)
  list(TRANSFORM linked REPLACE "(.+)" "$<LINK_ONLY:\\1>")
  list(TRANSFORM DOCENT_DEPENDS_OF_${component} PREPEND docent:: OUTPUT_VARIABLE needed)
  target_link_libraries(docent_component_${component} INTERFACE ${linked} ${needed})
  if(Eigen3::Eigen IN_LIST DOCENT_LIBRARIES_OF_${component})
    find_package(Eigen3 REQUIRED NO_MODULE)
    target_link_libraries(docent_component_${component} INTERFACE Eigen3::Eigen)
  endif()

  if(DOCENT_PROGRAM)  # whoever takes Docent in as a part of a project installs that
    install(FILES $<TARGET_FILE:${archive}> DESTINATION ${CMAKE_INSTALL_LIBDIR} RENAME libdocent_${component}.a
      COMPONENT library EXCLUDE_FROM_ALL)
  endif()
  list(JOIN DOCENT_PACKAGES_OF_${component} "\n" packages)
  list(JOIN DOCENT_DEPENDS_OF_${component} " " depends)
  list(JOIN DOCENT_LIBRARIES_OF_${component} " " libraries)
  string(APPEND described
    "set(docent_${component}_DEPENDS ${depends})\nset(docent_${component}_LIBRARIES ${libraries})\n"
    "macro(docent_${component}_find)\n${packages}\nendmacro()\n")
endforeach()
add_custom_target(docent_library DEPENDS ${archives})

set(config ${DOCENT_BINARY_DIR}/docentConfig.cmake)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/docentConfig.cmake.in ${config} INSTALL_DESTINATION ${DOCENT_CONFIG}
  PATH_VARS CMAKE_INSTALL_INCLUDEDIR DOCENT_PRIVATE_HEADERS CMAKE_INSTALL_LIBDIR)
write_basic_package_version_file(${DOCENT_BINARY_DIR}/docentConfigVersion.cmake COMPATIBILITY SameMinorVersion)
if(DOCENT_PROGRAM)
  set(library COMPONENT library EXCLUDE_FROM_ALL)
  install(FILES ${config} ${DOCENT_BINARY_DIR}/docentConfigVersion.cmake DESTINATION ${DOCENT_CONFIG} ${library})
  install(DIRECTORY ${DOCENT_ROOT}/include/docent DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} ${library} FILES_MATCHING PATTERN *.h)
  install(CODE "execute_process(COMMAND python3 ${DOCENT_ROOT}/cmake/private_headers.py ${DOCENT_ROOT}
    \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${DOCENT_PRIVATE_HEADERS}\" COMMAND_ERROR_IS_FATAL ANY)" ${library})
endif()
