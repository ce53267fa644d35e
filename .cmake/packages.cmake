# cmake --build BUILD --target package: rugosa_VERSION_amd64.deb (program, libraries, headers, manual pages),
# python3-rugosa_VERSION_amd64.deb (the Python module) and librugosa-ga-dev_VERSION_amd64.deb (the engine's library
# and headers without the rest), by CPack.
set(documents ${CMAKE_INSTALL_DATADIR}/doc)

# Manual pages from --help, by help2man.
find_program(HELP2MAN help2man)
if(HELP2MAN)
    set(manuals)
    foreach(command "" contact profile target design database run report optimise compare operators chart stability)
        string(REGEX REPLACE "(.+)" "-\\1" suffix "${command}")
        set(manual ${PROJECT_BINARY_DIR}/manual/rugosa${suffix}.1.gz)
        add_custom_command(OUTPUT ${manual} DEPENDS rugosa
                           COMMAND sh ${PROJECT_SOURCE_DIR}/.cmake/manual ${HELP2MAN} $<TARGET_FILE:rugosa>
                                   ${PROJECT_VERSION} ${manual} ${command} VERBATIM)
        list(APPEND manuals ${manual})
    endforeach()
    add_custom_target(manual ALL DEPENDS ${manuals})
    install(FILES ${manuals} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endif()

# What Debian's policy asks of each package.
cmake_host_system_information(RESULT release QUERY DISTRIB_VERSION_CODENAME)
set(maintainer "The maintainers of rugosa <maintainers@rugosa.example>")
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE ${PROJECT_BINARY_DIR}/changelog "rugosa (${PROJECT_VERSION}) ${release}; urgency=medium

  * See NEWS.gz.

 -- ${maintainer}  ${date}
")
execute_process(COMMAND gzip -9nf ${PROJECT_BINARY_DIR}/changelog)
execute_process(COMMAND gzip -9nc ${PROJECT_SOURCE_DIR}/.github/CHANGELOG.md OUTPUT_FILE ${PROJECT_BINARY_DIR}/NEWS.gz)
set(policy ${PROJECT_SOURCE_DIR}/.cmake/copyright ${PROJECT_BINARY_DIR}/changelog.gz ${PROJECT_BINARY_DIR}/NEWS.gz)
install(FILES ${policy} DESTINATION ${documents}/rugosa)
install(DIRECTORY experiments/ DESTINATION ${documents}/rugosa/examples FILES_MATCHING PATTERN "*.ini" PATTERN "*.csv")

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program ga ga_documents)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_CONTACT "${maintainer}")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME rugosa)
set(CPACK_DEBIAN_PROGRAM_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS gnuplot-nox)
# A program that is built against the libraries needs their headers.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "g++, cmake, libeigen3-dev, libboost-dev, libnlopt-cxx-dev, \
nlohmann-json3-dev, libfftw3-dev, libsqlitecpp-dev, libzip-dev, libpugixml-dev, libpng-dev")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "rough surfaces with a given contact behaviour
rugosa designs rough surfaces that have a given elastic contact behaviour.
It takes a curve (stiffness or contact area against pressure) or a measured
surface, and returns a profile or a map with that behaviour for printing.
.
The package has the program, its genetic-algorithm engine and its contact
solvers as C++ libraries, and examples of experiments.")
# The package of the program has the engine's library and headers, too.
install(CODE "execute_process(COMMAND \${CMAKE_COMMAND} --install ${PROJECT_BINARY_DIR} --component ga
                              --prefix \${CMAKE_INSTALL_PREFIX} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)")
install(FILES ${policy} DESTINATION ${documents}/librugosa-ga-dev COMPONENT ga_documents)
set(CPACK_COMPONENT_GA_GROUP engine)
set(CPACK_COMPONENT_GA_DOCUMENTS_GROUP engine)
set(CPACK_DEBIAN_ENGINE_PACKAGE_NAME librugosa-ga-dev)
set(CPACK_DEBIAN_ENGINE_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_ENGINE_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_ENGINE_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_ENGINE_PACKAGE_DEPENDS "libboost-dev (>= 1.74), nlohmann-json3-dev (>= 3.11)")
set(CPACK_DEBIAN_ENGINE_PACKAGE_SUGGESTS "g++, cmake, libeigen3-dev, libnlopt-cxx-dev")
set(CPACK_DEBIAN_ENGINE_PACKAGE_CONFLICTS rugosa) # which has the same headers
set(CPACK_DEBIAN_ENGINE_DESCRIPTION "engine for genetic algorithms as pipelines
C++ engine in which an algorithm is a pipeline of operators, in
code or as text: selection, crossover, mutation, refinement, islands, niches,
CMA-ES and many objectives, with the same result for any number of threads.")
if(RUGOSA_PYTHON)
    list(APPEND CPACK_COMPONENTS_ALL python)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-rugosa)
    set(CPACK_DEBIAN_PYTHON_FILE_NAME DEB-DEFAULT)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
    math(EXPR next "${Python_VERSION_MINOR} + 1")
    set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
        "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next}), python3-numpy")
    set(CPACK_COMPONENT_PYTHON_DESCRIPTION "rough surfaces with a given contact behaviour (Python)
The Python module of rugosa: contact of measured and designed surfaces,
design for a target curve, and the genetic-algorithm engine with fitness
functions and operators that are written in Python.")
    install(TARGETS rugosa_python LIBRARY DESTINATION lib/python3/dist-packages/rugosa COMPONENT python)
    install(DIRECTORY apps/python/rugosa/ DESTINATION lib/python3/dist-packages/rugosa COMPONENT python)
    install(FILES ${policy} DESTINATION ${documents}/python3-rugosa COMPONENT python)
endif()
include(CPack)
