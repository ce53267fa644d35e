# The hot loops, once for each kind of vectors, picked at run time (domain/numerics/vector_loops.hpp); and what
# results tell of the build they come from.
set(kinds baseline)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    list(APPEND kinds avx2 avx512)
    set(flags_of_avx2 -mavx2 -mfma)
    set(flags_of_avx512 -mavx512f -mavx512dq -mavx512vl -mavx2 -mfma)
endif()
foreach(kind IN LISTS kinds)
    set(source ${CMAKE_CURRENT_BINARY_DIR}/vectors/${kind}.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT "#include \"domain/numerics/vector_loops.inc\"
constinit const rough::VectorLoops rough::@kind@_loops = rough::loops_of(\"@kind@\");
" @ONLY)
    target_sources(rugosa_contact PRIVATE ${source})
    set_source_files_properties(${source} PROPERTIES SKIP_PRECOMPILE_HEADERS ON
                                COMPILE_OPTIONS "-O3;-ffp-contract=fast;${flags_of_${kind}}")
endforeach()
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
