# Headers of libraries that many files include are parsed once for a group of targets. No header of the project is among
# them, so that nothing is compiled again when one changes; every file still includes what it uses, and compiles with
# -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON and -DCMAKE_UNITY_BUILD=OFF too.

if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-fpch-preprocess>)  # for ccache
else()
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
endif()

set(standard_headers <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <iostream> <map> <memory>
  <mutex> <numeric> <optional> <set> <span> <sstream> <string> <thread> <unordered_map> <vector>)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/precompiled.cpp CONTENT "")

# cleft_headers(GROUP HEADERS... [LINK ...] [OPTIONS ...]): the standard library's headers and HEADERS. Targets of the group
# are compiled with the same options, without which GCC refuses the precompiled file.
function(cleft_headers group)
  cmake_parse_arguments(arg "" "" "LINK;OPTIONS" ${ARGN})
  add_library(cleft_headers_${group} OBJECT ${PROJECT_BINARY_DIR}/generated/precompiled.cpp)
  target_compile_features(cleft_headers_${group} PRIVATE cxx_std_20)
  target_compile_options(cleft_headers_${group} PRIVATE ${arg_OPTIONS})
  target_link_libraries(cleft_headers_${group} PRIVATE ${arg_LINK} cleft_warnings cleft_options)
  target_precompile_headers(cleft_headers_${group} PRIVATE ${standard_headers} ${arg_UNPARSED_ARGUMENTS})
  set_target_properties(cleft_headers_${group} PROPERTIES UNITY_BUILD OFF)
endfunction()

# cleft_use_headers(TARGET [GROUP]); "none": no precompiled headers.
function(cleft_use_headers target)
  set(group ${ARGN})
  if(NOT group)
    set(group standard)
  endif()
  if(NOT group STREQUAL "none")
    target_precompile_headers(${target} REUSE_FROM cleft_headers_${group})
  endif()
endfunction()

cleft_headers(standard OPTIONS ${cleft_position_independent})
cleft_headers(json <nlohmann/json.hpp> LINK nlohmann_json::nlohmann_json OPTIONS ${cleft_position_independent})
cleft_headers(eigen <Eigen/Dense> <Eigen/Sparse> LINK Eigen3::Eigen OPTIONS ${cleft_position_independent})
