# Writes the list of all kinds of experiments into a C++ file, RUGOSA_EXPERIMENTS_SOURCE: the functions
# `Experiment NAME_experiment() {` in the sources of apps/experiments.
set(RUGOSA_EXPERIMENTS_SOURCE ${PROJECT_BINARY_DIR}/experiments.cpp)
set(functions "")
foreach(source ${APP_SOURCES})
    if(source MATCHES "/apps/experiments/")
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
        file(STRINGS ${source} found REGEX "^Experiment [a-z_]+_experiment\\(\\) {$")
        list(APPEND functions ${found})
    endif()
endforeach()
list(TRANSFORM functions REPLACE "^Experiment ([a-z_]+)\\(\\) {$" "\\1()")
list(JOIN functions ", " calls)
list(TRANSFORM functions REPLACE "(.+)" "Experiment \\1;\n")
list(JOIN functions "" declarations)
file(CONFIGURE OUTPUT ${RUGOSA_EXPERIMENTS_SOURCE} CONTENT "#include \"apps/experiments/experiment.hpp\"

namespace app {

@declarations@
const std::vector<Experiment>& experiments() {
    static const std::vector<Experiment> all{@calls@};
    return all;
}

} // namespace app
" @ONLY)
