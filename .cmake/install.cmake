# cmake --install: the program, the libraries with their headers, what find_package(rugosa) reads, bash completion.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)

set(RUGOSA_HEADERS ${CMAKE_INSTALL_INCLUDEDIR}/rugosa)
set(RUGOSA_PACKAGE ${CMAKE_INSTALL_LIBDIR}/cmake/rugosa)
# Users write <rugosa/domain.hpp> and <rugosa/ga.hpp>; the headers themselves begin at ga/ and domain/.
target_include_directories(rugosa_base INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
                                                 $<INSTALL_INTERFACE:${RUGOSA_HEADERS}>)
if(NOT PROJECT_IS_TOP_LEVEL)
    target_include_directories(rugosa_base INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/.cmake/include>)
endif()

# Public are all headers of ga, and of domain those that its umbrella headers include, with what they include.
set(public domain/domain.hpp domain/scan/map.hpp domain/scan/scan.hpp)
set(unread ${public})
while(unread)
    list(POP_FRONT unread header)
    if(header MATCHES "/solvers/|/stored")
        message(FATAL_ERROR "${header} is private; do not include it in a public header")
    endif()
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${header})
    file(STRINGS ${header} lines REGEX "^#include \"domain/")
    foreach(line IN LISTS lines)
        string(REGEX REPLACE "^#include \"(.*)\".*" "\\1" included "${line}")
        if(NOT included IN_LIST public)
            list(APPEND public ${included})
            list(APPEND unread ${included})
        endif()
    endforeach()
endwhile()
foreach(header IN LISTS public)
    cmake_path(GET header PARENT_PATH folder)
    install(FILES ${header} DESTINATION ${RUGOSA_HEADERS}/${folder})
endforeach()

install(TARGETS rugosa RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
foreach(library contact scan domain)
    install(TARGETS rugosa_${library} EXPORT ${library}Targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
            LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
    install(EXPORT ${library}Targets NAMESPACE rugosa:: DESTINATION ${RUGOSA_PACKAGE})
    install(FILES .cmake/include/rugosa/${library}.hpp DESTINATION ${RUGOSA_HEADERS})
endforeach()

# The engine is the component ga, which also is a package without the rest.
foreach(library base ga)
    install(TARGETS rugosa_${library} EXPORT ${library}Targets
            ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ga
            LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ga)
    install(EXPORT ${library}Targets NAMESPACE rugosa:: DESTINATION ${RUGOSA_PACKAGE} COMPONENT ga)
endforeach()
configure_package_config_file(.cmake/rugosaConfig.cmake.in rugosaConfig.cmake INSTALL_DESTINATION ${RUGOSA_PACKAGE})
write_basic_package_version_file(rugosaConfigVersion.cmake COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(DIRECTORY ga DESTINATION ${RUGOSA_HEADERS} COMPONENT ga FILES_MATCHING PATTERN "*.hpp")
install(FILES .cmake/include/rugosa/ga.hpp DESTINATION ${RUGOSA_HEADERS} COMPONENT ga)
install(FILES ${PROJECT_BINARY_DIR}/rugosaConfig.cmake ${PROJECT_BINARY_DIR}/rugosaConfigVersion.cmake
              .cmake/dependencies.cmake DESTINATION ${RUGOSA_PACKAGE} COMPONENT ga)
install(FILES apps/prompt/completion.bash RENAME rugosa DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)

# Pages of the libraries' comments, where Doxygen is there.
find_program(DOXYGEN doxygen)
if(DOXYGEN)
    add_custom_target(docs COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/docs
                      COMMAND ${CMAKE_COMMAND} -E env RUGOSA_DOCS=${PROJECT_BINARY_DIR}/docs ${DOXYGEN} .doxygen
                      WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} VERBATIM)
endif()
