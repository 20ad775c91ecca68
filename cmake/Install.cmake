# cmake --install: the commands, and for other programs the field library and the snapshot reader (find_package(Cleft)).
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Cleft)
install(TARGETS cleft_base cleft_parameters cleft_h5 cleft_field cleft_field_file cleft_snapshot EXPORT CleftTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(EXPORT CleftTargets NAMESPACE Cleft:: DESTINATION ${package_folder} COMPONENT development)
foreach(folder base base/h5 params/parameters encoder/field encoder/field/file encoder/field/parametrization solver/snapshot)
  file(GLOB headers ${PROJECT_SOURCE_DIR}/${folder}/*.h)
  list(REMOVE_ITEM headers ${PROJECT_SOURCE_DIR}/base/vtk_listener.h
    ${PROJECT_SOURCE_DIR}/encoder/field/file/columns.h)
  install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/cleft/${folder} COMPONENT development)
endforeach()

# The C header of device plug-ins; they are found in lib/cleft/devices next to bin, whatever the libraries' folder is called.
install(FILES ${PROJECT_SOURCE_DIR}/haptic/devices/plugin.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/cleft/haptic/devices
  COMPONENT development)

configure_package_config_file(cmake/CleftConfig.cmake.in ${PROJECT_BINARY_DIR}/CleftConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/CleftConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/CleftConfig.cmake ${PROJECT_BINARY_DIR}/CleftConfigVersion.cmake DESTINATION ${package_folder}
  COMPONENT development)
