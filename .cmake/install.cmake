# cmake --install: the program, the libraries with their headers, what find_package(rugosa) reads, bash completion.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(RUGOSA_HEADERS ${CMAKE_INSTALL_INCLUDEDIR}/rugosa)
set(RUGOSA_PACKAGE ${CMAKE_INSTALL_LIBDIR}/cmake/rugosa)
target_include_directories(rugosa_ga INTERFACE $<INSTALL_INTERFACE:${RUGOSA_HEADERS}>)

install(TARGETS rugosa RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS rugosa_ga rugosa_domain EXPORT rugosaTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ga domain DESTINATION ${RUGOSA_HEADERS} FILES_MATCHING PATTERN "*.hpp")
install(EXPORT rugosaTargets NAMESPACE rugosa:: DESTINATION ${RUGOSA_PACKAGE})
configure_package_config_file(.cmake/rugosaConfig.cmake.in rugosaConfig.cmake INSTALL_DESTINATION ${RUGOSA_PACKAGE})
write_basic_package_version_file(rugosaConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/rugosaConfig.cmake ${PROJECT_BINARY_DIR}/rugosaConfigVersion.cmake
              .cmake/dependencies.cmake DESTINATION ${RUGOSA_PACKAGE})
install(FILES apps/prompt/completion.bash RENAME rugosa DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)

# Pages of the libraries' comments, where Doxygen is there.
find_program(DOXYGEN doxygen)
if(DOXYGEN)
    add_custom_target(docs COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/docs
                      COMMAND ${CMAKE_COMMAND} -E env RUGOSA_DOCS=${PROJECT_BINARY_DIR}/docs ${DOXYGEN} .doxygen
                      WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} VERBATIM)
endif()
