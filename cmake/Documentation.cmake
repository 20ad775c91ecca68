# Targets outside `all`: `docs` makes Doxygen pages of the public headers (docs/html in the build folder), `man` man pages
# and `completion` the completion for bash, both of them from what the commands print on --help.

find_program(CLEFT_DOXYGEN doxygen)
if(CLEFT_DOXYGEN)
  set(folders base params solver encoder haptic explorer tradeoff)
  list(TRANSFORM folders PREPEND ${PROJECT_SOURCE_DIR}/)
  list(JOIN folders " " doxygen_folders)
  configure_file(${PROJECT_SOURCE_DIR}/docs/generate/Doxyfile.in ${PROJECT_BINARY_DIR}/docs/Doxyfile @ONLY)
  add_custom_target(docs COMMAND ${CLEFT_DOXYGEN} ${PROJECT_BINARY_DIR}/docs/Doxyfile VERBATIM)
else()
  add_custom_target(docs COMMAND ${CMAKE_COMMAND} -E echo "Doxygen is missing: setup/install.sh docs"
    COMMAND ${CMAKE_COMMAND} -E false)
endif()

find_program(CLEFT_PYTHON python3 HINTS /usr/bin)
if(CLEFT_PYTHON)
  set(pages ${CLEFT_PYTHON} ${PROJECT_SOURCE_DIR}/docs/generate/help_pages.py)
  add_custom_target(man COMMAND ${CMAKE_COMMAND} -E rm -rf ${PROJECT_BINARY_DIR}/man  # else gzip takes those of before again
    COMMAND ${pages} man ${CMAKE_RUNTIME_OUTPUT_DIRECTORY} ${PROJECT_BINARY_DIR}/man
    COMMAND gzip -9nrf ${PROJECT_BINARY_DIR}/man VERBATIM)
  add_custom_target(completion
    COMMAND ${pages} completion ${CMAKE_RUNTIME_OUTPUT_DIRECTORY} ${PROJECT_BINARY_DIR}/completion/cleft VERBATIM)
  get_property(cleft_commands GLOBAL PROPERTY cleft_commands)
  foreach(target man completion)
    cleft_needs(${target} ${cleft_commands})
  endforeach()
  install(DIRECTORY ${PROJECT_BINARY_DIR}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT commands OPTIONAL)
  install(FILES ${PROJECT_BINARY_DIR}/completion/cleft DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
    COMPONENT commands OPTIONAL)
endif()
