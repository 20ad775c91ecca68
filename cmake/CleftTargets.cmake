# The few functions with which every folder declares its libraries, commands and tests.

find_program(CCACHE ccache)
if(CCACHE)
  # GCC's precompiled headers can be cached only if ccache may ignore their time of writing.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
    CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${CCACHE})
endif()

# The linker: ld.bfd also searches every library that deal.II and VTK's libraries need themselves, which takes 22 s for
# cleft-solve; gold (in the same Debian package) takes 2 s.
include(CheckLinkerFlag)
check_linker_flag(CXX -fuse-ld=gold CLEFT_LINKS_WITH_GOLD)
if(CLEFT_LINKS_WITH_GOLD)
  add_link_options(-fuse-ld=gold)
endif()

# The sources of a library or a program are compiled several at a time, so that headers and templates that they share are
# compiled once. Compile commands then name no single sources: configure with OFF for an editor, or while changing one file.
option(CMAKE_UNITY_BUILD "Compile the sources of a target in groups" ON)

# GCC frees memory it no longer needs each time that its heap has grown to 128 MB, which takes a tenth of its time.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:--param=ggc-min-heapsize=524288>)
endif()

find_package(Threads REQUIRED)
find_package(Eigen3 REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(HDF5_SERIAL REQUIRED IMPORTED_TARGET hdf5-serial)
if(CLEFT_SOLVER)
  pkg_check_modules(HDF5_MPI REQUIRED IMPORTED_TARGET hdf5-openmpi)
endif()

add_library(cleft_warnings INTERFACE)
target_compile_options(cleft_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual
  -Wno-restrict -Wno-stringop-overflow -Wno-array-bounds)  # GCC 12 reports sound std::string additions (GCC bug 105329)

add_library(cleft_options INTERFACE)
if(CLEFT_SANITIZE)
  target_compile_options(cleft_options INTERFACE -fsanitize=${CLEFT_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(cleft_options INTERFACE -fsanitize=${CLEFT_SANITIZE})
endif()

# Libraries, commands and their precompiled headers are position-independent, so that the Python module, a shared object, is
# linked from the same libraries. No other library replaces their functions, so the compiler may inline them all the same.
set(cleft_position_independent -fPIC -fno-semantic-interposition)

# cleft_library(NAME SOURCES... [SEPARATE] [HEADERS GROUP] [LINK ...]): a static library; the target is Cleft::NAME too. GROUP:
# the precompiled headers (PrecompiledHeaders.cmake), without it those of the standard library. SEPARATE: each source is
# compiled alone, where the machine code of inner loops shall not depend on what else is in the library.
function(cleft_library name)
  cmake_parse_arguments(arg "SEPARATE" "HEADERS" "LINK" ${ARGN})
  add_library(cleft_${name} STATIC ${arg_UNPARSED_ARGUMENTS})
  add_library(Cleft::${name} ALIAS cleft_${name})
  set_target_properties(cleft_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(cleft_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/generated> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/cleft>)
  target_compile_features(cleft_${name} PUBLIC cxx_std_20)
  target_compile_options(cleft_${name} PRIVATE ${cleft_position_independent})
  target_link_libraries(cleft_${name} PUBLIC ${arg_LINK} PRIVATE $<BUILD_INTERFACE:cleft_warnings>)
  target_link_libraries(cleft_${name} PUBLIC $<BUILD_INTERFACE:cleft_options>)
  cleft_use_headers(cleft_${name} "${arg_HEADERS}")
  if(arg_SEPARATE)
    set_target_properties(cleft_${name} PROPERTIES UNITY_BUILD OFF)
  endif()
endfunction()

# cleft_command(NAME SOURCE LINK...): the executable cleft-NAME (or `cleft` itself), installed beside the others.
function(cleft_command name source)
  add_executable(${name} ${source})
  target_compile_options(${name} PRIVATE ${cleft_position_independent})
  target_link_libraries(${name} PRIVATE ${ARGN} cleft_command cleft_warnings)
  cleft_use_headers(${name} json)
  install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT commands)
  set_property(GLOBAL APPEND PROPERTY cleft_commands ${name})
endfunction()

# cleft_needs(TARGET COMMAND...): TARGET runs the commands, so they are built before it.
function(cleft_needs target)
  foreach(command ${ARGN})
    if(TARGET ${command})
      add_dependencies(${target} ${command})
    endif()
  endforeach()
endfunction()
