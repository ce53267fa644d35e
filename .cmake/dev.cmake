# cmake -C .cmake/dev.cmake -S . -B .build-dev: for daily work, with the tests; quick to build, by Ninja and through
# ccache where they are there.
set(CMAKE_BUILD_TYPE Release CACHE STRING "")
set(RUGOSA_UNITY OFF CACHE BOOL "")
find_program(NINJA ninja)
if(NINJA)
    set(CMAKE_GENERATOR Ninja CACHE INTERNAL "")
endif()
find_program(CCACHE ccache)
if(CCACHE)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE} CACHE STRING "")
    # ccache cannot see into a precompiled header unless told to overlook its times.
    set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON CACHE BOOL "")
endif()
