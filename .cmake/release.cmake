# cmake -C .cmake/release.cmake -S . -B .build: the program alone, for any machine of its kind.
set(CMAKE_BUILD_TYPE Release CACHE STRING "")
set(RUGOSA_TESTS OFF CACHE BOOL "")
