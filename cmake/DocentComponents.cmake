# The components of the library, which others link: find_package(docent COMPONENTS localization planning), or
# add_subdirectory(docent). Each is one archive, libdocent_NAME.a, and the public headers of its folders. All other
# folders belong to the programs: `program` or, where docent_capability says LABORATORY, `laboratory`.
#
# docent_component(NAME
#   FOLDERS base grid             # of src/docent, with what lies within them
#   DEPENDS core                  # components whose headers or functions it needs
#   PACKAGES "find_package(X)"    # what finds its third-party libraries, where a name alone does not do
#   LIBRARIES yaml-cpp)           # these libraries
set(DOCENT_COMPONENTS)
function(docent_component name)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "" "FOLDERS;DEPENDS;PACKAGES;LIBRARIES")
  list(APPEND DOCENT_COMPONENTS ${name})
  set(DOCENT_COMPONENTS ${DOCENT_COMPONENTS} PARENT_SCOPE)
  foreach(what FOLDERS DEPENDS PACKAGES LIBRARIES)
    set(DOCENT_${what}_OF_${name} ${ARG_${what}} PARENT_SCOPE)
  endforeach()
endfunction()

docent_component(core FOLDERS base geometry vocabulary grid LIBRARIES yaml-cpp png z)
docent_component(models FOLDERS motion_models sensor_models DEPENDS core)
docent_component(museum FOLDERS museum DEPENDS core LIBRARIES yaml-cpp)
docent_component(localization FOLDERS localization DEPENDS models core
  PACKAGES "find_package(Eigen3 QUIET NO_MODULE)" LIBRARIES Eigen3::Eigen)
docent_component(mapping FOLDERS mapping DEPENDS models museum core
  PACKAGES "find_package(Eigen3 QUIET NO_MODULE)" "find_package(Ceres QUIET)" LIBRARIES Eigen3::Eigen Ceres::ceres)
docent_component(planning FOLDERS planning DEPENDS models core)
docent_component(avoidance FOLDERS collision_avoidance DEPENDS models core)
docent_component(people FOLDERS people DEPENDS models core)
docent_component(tours FOLDERS task_control/travel_times task_control/tour_scheduler task_control/golog DEPENDS planning core)
docent_component(bus FOLDERS messages transport DEPENDS core
  PACKAGES "find_package(CycloneDDS QUIET)" LIBRARIES CycloneDDS::ddsc)
docent_component(recording FOLDERS recording DEPENDS bus core LIBRARIES bz2 lz4 sqlite3 zstd z)

# Not of the component that holds the folder around: what brings several of them together, and what only the programs need.
set(DOCENT_PROGRAM_FOLDERS messages/definitions planning/navigator planning/mark_alignment planning/survey)

# docent_component_of(FOLDER RESULT): the component that holds the folder, else `program`.
function(docent_component_of folder result)
  set(${result} program PARENT_SCOPE)
  if(folder IN_LIST DOCENT_PROGRAM_FOLDERS)
    return()
  endif()
  foreach(component IN LISTS DOCENT_COMPONENTS)
    foreach(root IN LISTS DOCENT_FOLDERS_OF_${component})
      cmake_path(IS_PREFIX root ${folder} is_within)
      if(is_within)
        set(${result} ${component} PARENT_SCOPE)
        return()
      endif()
    endforeach()
  endforeach()
endfunction()
