# Writes templates of pages, scripts of figures and of experiments, tables of words and texts of help into a C++ file, RUGOSA_TEMPLATES_SOURCE.
file(GLOB TEMPLATE_FILES CONFIGURE_DEPENDS apps/report/templates/*.mustache apps/report/templates/*.js apps/report/figures/*.gp
     experiments/*/*.mustache experiments/*/*.gp experiments/*/*.py experiments/paper/*.csv experiments/compare/*.csv
     apps/commands/help/*.txt)
set(RUGOSA_TEMPLATES_SOURCE ${PROJECT_BINARY_DIR}/builtin.cpp)
set(content "#include \"apps/report/render.hpp\"\n\nnamespace app {\nconst std::map<std::string, std::string>& builtin_files() {\n    static const std::map<std::string, std::string> files{\n")
foreach(file ${TEMPLATE_FILES})
    get_filename_component(name ${file} NAME)
    file(READ ${file} text)
    string(APPEND content "{\"${name}\", R\"~~~~(${text})~~~~\"},\n")
endforeach()
file(CONFIGURE OUTPUT ${RUGOSA_TEMPLATES_SOURCE} CONTENT "@content@};\n    return files;\n}\n} // namespace app\n" @ONLY)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${TEMPLATE_FILES})
