# cpack: Debian packages of the commands, of the library with its headers, of the Python module, and of the plug-in
# for ParaView. The preset `package` has the folders of a system; `cmake --build --preset package` makes the packages too.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_PACKAGE_NAME cleft)
set(CPACK_PACKAGE_VENDOR Cleft)
set(CPACK_PACKAGE_CONTACT "Cleft maintainers <maintainers@cleft.example.org>" CACHE STRING "Who maintains the packages: Name <address>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL commands development)
if(TARGET cleft_python)
  list(APPEND CPACK_COMPONENTS_ALL python paraview)
endif()
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)

# cleft_package(COMPONENT NAME SECTION SUMMARY DESCRIPTION [FIELD VALUE]...): a component and its package.
macro(cleft_package component name section summary description)
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${summary}\n${description}")
  set(rest ${ARGN})
  while(rest)
    list(POP_FRONT rest field value)
    set(CPACK_DEBIAN_${upper}_PACKAGE_${field} "${value}")
  endwhile()
  set(cleft_package_name ${name})
  foreach(file copyright changelog.Debian)
    configure_file(${PROJECT_SOURCE_DIR}/cmake/package/${file}.in ${PROJECT_BINARY_DIR}/package/${name}/${file} @ONLY)
  endforeach()
  execute_process(COMMAND gzip -9nf ${PROJECT_BINARY_DIR}/package/${name}/changelog.Debian COMMAND_ERROR_IS_FATAL ANY)
  install(DIRECTORY ${PROJECT_BINARY_DIR}/package/${name}/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT ${component}
    EXCLUDE_FROM_ALL)
endmacro()

if(TARGET cleft_python)
  math(EXPR next_minor "${CLEFT_PYTHON_MINOR} + 1")
endif()
string(TIMESTAMP cleft_package_date "%a, %d %b %Y %H:%M:%S +0000" UTC)
cleft_package(commands cleft science "simulations of a growing cut as discontinuous free-form deformations"
  "Cleft turns finite element simulations with a growing cut into compact
discontinuous free-form deformations (DFFD), lets one explore whole parameter
studies of them, and cuts any surface mesh with them in real time.
This package has the command cleft, its man pages and the explorer."
  RECOMMENDS "openmpi-bin, gnuplot-nox")
cleft_package(development libcleft-dev libdevel "fields and snapshots of Cleft for other programs"
  "The library that reads and evaluates the fields of Cleft, and the reader of
its snapshots: headers, static libraries, and a package for CMake."
  DEPENDS "libhdf5-dev, nlohmann-json3-dev")
cleft_package(python python3-cleft python "fields and studies of Cleft in Python"
  "The Python module cleft: studies as tables, fields as functions of numpy's
arrays, cuts in meshes."
  DEPENDS "python3 (>= 3.${CLEFT_PYTHON_MINOR}), python3 (<< 3.${next_minor}), python3-numpy"
  SUGGESTS "python3-pandas, python3-xarray, python3-vtk9, paraview-cleft")
cleft_package(paraview paraview-cleft science "fields and studies of Cleft in ParaView"
  "A plug-in that makes ParaView read the fields and studies of Cleft, with a
slider for each parameter, and move any mesh by a field. ParaView loads it
from the folder of the Python module cleft."
  ARCHITECTURE all DEPENDS "python3, python3-cleft (>= ${PROJECT_VERSION}), paraview")
include(CPack)

add_custom_target(packages COMMAND ${CMAKE_CPACK_COMMAND} --config ${PROJECT_BINARY_DIR}/CPackConfig.cmake
  WORKING_DIRECTORY ${PROJECT_BINARY_DIR} VERBATIM)
get_property(cleft_commands GLOBAL PROPERTY cleft_commands)
cleft_needs(packages man completion cleft_python cleft_snapshot cleft_field_file ${cleft_commands})
