# What the compiler's time is spent on in a Release build: -O3 where most of the program's time goes in plain code,
# -O1 on words and pages, and the engine with all its operators in one piece for the problem it is compiled for.
file(GLOB loops CONFIGURE_DEPENDS domain/contact/solvers/*.cpp)
set_source_files_properties(${loops} domain/mwm/sampling.cpp domain/numerics/fourier.cpp
    PROPERTIES COMPILE_OPTIONS $<$<CONFIG:Release>:-O3>)
file(GLOB words CONFIGURE_DEPENDS domain/text/*.cpp domain/scan/*.cpp domain/database/*.cpp)
set_source_files_properties(${words} PROPERTIES COMPILE_OPTIONS $<$<CONFIG:Release>:-O1>)

# The files of a folder are compiled together; without, a change to one costs less. The engine's are a group of their
# own, as are those of `apps` that are as long as all others together; solvers keep each its own constants.
function(rugosa_unity target)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    foreach(source ${ARGN})
        get_filename_component(folder ${source} DIRECTORY)
        file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${folder})
        string(MAKE_C_IDENTIFIER ${folder} folder)
        if(NOT source MATCHES "/pipelines_|/contact/solvers/")
            set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${folder})
        endif()
    endforeach()
endfunction()
if(RUGOSA_UNITY)
    rugosa_unity(rugosa_domain ${DOMAIN_SOURCES})
    set_source_files_properties(domain/paper/variants.cpp domain/design/pipelines.cpp domain/design/search.cpp
        PROPERTIES UNITY_GROUP engine)
    if(TARGET rugosa_apps)
        rugosa_unity(rugosa_apps ${APP_SOURCES})
    endif()
endif()
