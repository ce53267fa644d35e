# The hot loops, once for each kind of vectors, picked at run time (domain/numerics/vector_loops.hpp); and what
# results tell of the build they come from.
set(loops -O3 -ffp-contract=fast)
set(vectors domain/numerics/vectors)
set_source_files_properties(${vectors}/baseline.cpp PROPERTIES COMPILE_OPTIONS "${loops}")
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    set_source_files_properties(${vectors}/avx2.cpp PROPERTIES COMPILE_OPTIONS "${loops};-mavx2;-mfma")
    set_source_files_properties(${vectors}/avx512.cpp PROPERTIES
                                COMPILE_OPTIONS "${loops};-mavx512f;-mavx512dq;-mavx512vl;-mavx2;-mfma")
endif()
set_source_files_properties(${vectors}/baseline.cpp ${vectors}/avx2.cpp ${vectors}/avx512.cpp
                            PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
string(TOUPPER "${CMAKE_BUILD_TYPE}" type)
string(STRIP "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${type}}" flags)
if(RUGOSA_NATIVE)
    string(APPEND flags " -march=native")
endif()
if(RUGOSA_SANITIZE)
    string(APPEND flags " -fsanitize=${RUGOSA_SANITIZE}")
endif()
set_source_files_properties(domain/numerics/vector_loops.cpp PROPERTIES COMPILE_DEFINITIONS
    "RUGOSA_COMPILER=\"${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}\";RUGOSA_FLAGS=\"${flags}\"")
