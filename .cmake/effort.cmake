# What the compiler's time is spent on in a Release build: -O2 for the files in which a run spends most of its time.
file(GLOB computing CONFIGURE_DEPENDS domain/contact/solvers/*.cpp domain/response/response.cpp)
if(RUGOSA_UNITY) # CMake leaves files with options of their own out of its groups
    set_source_files_properties(${computing} PROPERTIES HEADER_FILE_ONLY ON)
    list(TRANSFORM computing REPLACE "(.+)" "#include <\\1>")
    list(JOIN computing "\n" together)
    set(computing ${CMAKE_CURRENT_BINARY_DIR}/computing.cpp)
    file(CONFIGURE OUTPUT ${computing} CONTENT "${together}\n" @ONLY)
    target_sources(rugosa_contact PRIVATE ${computing})
endif()
if(CMAKE_CXX_FLAGS_RELEASE STREQUAL "-O1 -DNDEBUG") # other flags are the user's
    # Without the precompiled header: GCC keeps to the optimisation of that one, whatever its command says.
    set_source_files_properties(${computing} domain/numerics/fourier.cpp domain/mwm/sampling.cpp
        PROPERTIES COMPILE_OPTIONS $<$<CONFIG:Release>:-O2> SKIP_PRECOMPILE_HEADERS ON)
endif()

# Many files are compiled together, in few groups, because each reading of the common headers costs seconds; without,
# a change to one file costs less. Pipelines for a problem are a group of their own, as they take longest.
function(rugosa_unity target)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    foreach(source ${ARGN})
        file(RELATIVE_PATH place ${PROJECT_SOURCE_DIR} ${source})
        if(place STREQUAL "ga/refinement/nlopt.cpp") # programs that do not refine link without NLopt
            set(group nlopt)
        elseif(place MATCHES "/pipelines|domain/paper/variants.cpp|/search.cpp")
            set(group pipelines)
        elseif(place MATCHES "domain/(contact|accuracy|response|design|problem|asperities)/|experiments/")
            set(group first)
        else()
            set(group second)
        endif()
        set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
    endforeach()
endfunction()
if(RUGOSA_UNITY)
    rugosa_unity(rugosa_ga ${GA_SOURCES})
    rugosa_unity(rugosa_contact ${CONTACT_SOURCES})
    rugosa_unity(rugosa_scan ${SCAN_SOURCES})
    rugosa_unity(rugosa_domain ${DOMAIN_SOURCES})
    if(TARGET rugosa_apps)
        rugosa_unity(rugosa_apps ${APP_SOURCES} ${RUGOSA_EXPERIMENTS_SOURCE})
    endif()
endif()
