# Installs into a folder of its own, builds consumer/ against it, and runs it.
set(work ${BUILD}/tests/install-trial)
file(REMOVE_RECURSE ${work})
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN} ended with ${result}:\n${output}")
  endif()
endfunction()
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${work}/prefix)
run(${CMAKE_COMMAND} -G Ninja -S ${SOURCE}/consumer -B ${work}/build -DCMAKE_PREFIX_PATH=${work}/prefix
  -DCMAKE_BUILD_TYPE=${BUILD_TYPE} -DCMAKE_CXX_FLAGS=${FLAGS})
run(${CMAKE_COMMAND} --build ${work}/build)
run(${work}/build/consumer ${work}/field.dffd)
run(${work}/prefix/bin/cleft check ${work}/field.dffd)
if(PYTHON_FOLDER)
  run(${CMAKE_COMMAND} -E env PYTHONPATH=${work}/prefix/${PYTHON_FOLDER} ${PYTHON} -c
    "import cleft, sys; assert cleft.__file__.startswith(sys.argv[1]); print(cleft.open(sys.argv[2])(0, 0, 0, 0, outside='clamp'))"
    ${work}/prefix ${work}/field.dffd)
endif()
