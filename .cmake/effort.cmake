# What the compiler's time is spent on in a Release build: -O3 where most of the program's time goes in plain code,
# -O1 on words and pages, and the engine with all its operators in one piece for the problem it is compiled for.
set_source_files_properties(domain/contact/solvers/certificate.cpp domain/contact/solvers/deflation.cpp
    domain/contact/solvers/growing_factor.cpp domain/contact/solvers/nnls.cpp domain/contact/solvers/set_solver.cpp
    domain/mwm/sampling.cpp domain/numerics/fourier.cpp
    PROPERTIES COMPILE_OPTIONS $<$<CONFIG:Release>:-O3>)
file(GLOB words CONFIGURE_DEPENDS domain/text/*.cpp domain/scan/*.cpp domain/database/*.cpp)
set_source_files_properties(${words} PROPERTIES COMPILE_OPTIONS $<$<CONFIG:Release>:-O1>)

# The files of a folder of apps are compiled together; without, a change to one costs less.
option(RUGOSA_UNITY "Compile files that read the same headers together" ON)
if(RUGOSA_UNITY)
    set_target_properties(rugosa_domain PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    set_source_files_properties(domain/problem/pipeline.cpp domain/paper/variants.cpp domain/design/pipelines.cpp
        domain/design/search.cpp domain/design/within_limits.cpp
        PROPERTIES UNITY_GROUP engine)
    if(TARGET rugosa_apps)
        set_target_properties(rugosa_apps PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
        foreach(source ${APP_SOURCES})
            get_filename_component(folder ${source} DIRECTORY)
            file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${folder})
            string(MAKE_C_IDENTIFIER ${folder} folder)
            if(NOT source MATCHES "/pipelines_") # each as long as all others together
                set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${folder})
            endif()
        endforeach()
    endif()
endif()
