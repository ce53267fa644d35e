# Writes the list of all kinds of experiments into a C++ file, RUGOSA_EXPERIMENTS_SOURCE: what the functions
# `Experiment NAME_experiment() {` in the sources of experiments/ return.
set(RUGOSA_EXPERIMENTS_SOURCE ${PROJECT_BINARY_DIR}/experiments.cpp)
set(names "")
foreach(source ${APP_SOURCES})
    if(source MATCHES "^${PROJECT_SOURCE_DIR}/experiments/")
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
        file(STRINGS ${source} functions REGEX "^Experiment [a-z_]+_experiment\\(\\) {$")
        list(TRANSFORM functions REPLACE "^Experiment ([a-z_]+).*" "\\1")
        list(APPEND names ${functions})
    endif()
endforeach()
list(SORT names)
set(declarations "")
set(calls "")
foreach(name ${names})
    string(APPEND declarations "Experiment ${name}();\n")
    string(APPEND calls "${name}(), ")
endforeach()
file(CONFIGURE OUTPUT ${RUGOSA_EXPERIMENTS_SOURCE} CONTENT "#include \"apps/experiments/experiment.hpp\"

namespace app {

@declarations@
const std::vector<Experiment>& experiments() {
    static const std::vector<Experiment> all{@calls@};
    return all;
}

} // namespace app
" @ONLY)
