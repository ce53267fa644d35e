# cmake -C .cmake/sanitize.cmake -S . -B .build-sanitize: the tests under the address and undefined-behaviour
# sanitizers, assertions on; -DRUGOSA_SANITIZE=thread for that one.
set(CMAKE_BUILD_TYPE Release CACHE STRING "")
set(CMAKE_CXX_FLAGS_RELEASE "-O1 -g" CACHE STRING "")
set(RUGOSA_SANITIZE address,undefined CACHE STRING "")
