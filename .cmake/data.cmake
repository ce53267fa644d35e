# Writes the named variants of domain/paper and domain/design into a C++ file, as texts for variants_in().
set(content "namespace rough {\n")
foreach(folder paper design)
    set(variants ${PROJECT_SOURCE_DIR}/domain/${folder}/variants.ini)
    file(READ ${variants} text)
    string(APPEND content "extern const char* const ${folder}_variants_ini;\n"
                          "const char* const ${folder}_variants_ini = R\"~~~~(${text})~~~~\";\n")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${variants})
endforeach()
set(source ${CMAKE_CURRENT_BINARY_DIR}/variants.cpp)
file(CONFIGURE OUTPUT ${source} CONTENT "@content@} // namespace rough\n" @ONLY)
target_sources(rugosa_domain PRIVATE ${source})
set_source_files_properties(${source} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
