# What the compiler's time is spent on in a Release build: -O3 where most of the program's time goes in plain code,
# and the engine with all its operators in one piece for the problems it is compiled for.
file(GLOB solvers CONFIGURE_DEPENDS domain/contact/solvers/*.cpp)
if(RUGOSA_UNITY) # CMake leaves files with options of their own out of its groups
    set_source_files_properties(${solvers} PROPERTIES HEADER_FILE_ONLY ON)
    list(TRANSFORM solvers REPLACE "(.+)" "#include <\\1>")
    list(JOIN solvers "\n" together)
    set(solvers ${CMAKE_CURRENT_BINARY_DIR}/solvers.cpp)
    file(CONFIGURE OUTPUT ${solvers} CONTENT "${together}\n" @ONLY)
    target_sources(rugosa_domain PRIVATE ${solvers})
endif()
set_source_files_properties(${solvers} domain/mwm/sampling.cpp domain/numerics/fourier.cpp
    PROPERTIES COMPILE_OPTIONS $<$<CONFIG:Release>:-O3>)

# Many files are compiled together, in few groups, because each reading of the common headers costs seconds; without,
# a change to one file costs less. Pipelines for a problem are a group of their own, as they take longest.
function(rugosa_unity target)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    foreach(source ${ARGN})
        file(RELATIVE_PATH place ${PROJECT_SOURCE_DIR} ${source})
        if(place MATCHES "/pipelines|domain/paper/variants.cpp|/search.cpp")
            set(group pipelines)
        elseif(place MATCHES "domain/(contact|accuracy|response|design|problem|asperities)/|apps/experiments/")
            set(group first)
        else()
            set(group second)
        endif()
        set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
    endforeach()
endfunction()
if(RUGOSA_UNITY)
    rugosa_unity(rugosa_domain ${DOMAIN_SOURCES})
    if(TARGET rugosa_apps)
        rugosa_unity(rugosa_apps ${APP_SOURCES})
    endif()
endif()
