# What the two libraries stand on. Included by this project and by those that find it installed.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Boost 1.74 REQUIRED)
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(SQLite3 REQUIRED)

# NLopt's and FFTW's own packages differ from one release to the next; their headers and libraries do not.
if(NOT TARGET rugosa::nlopt)
    find_path(NLOPT_CXX_INCLUDE_DIR nlopt.hpp REQUIRED)
    find_library(NLOPT_CXX_LIBRARY NAMES nlopt_cxx nlopt REQUIRED)
    add_library(rugosa::nlopt INTERFACE IMPORTED)
    target_include_directories(rugosa::nlopt INTERFACE ${NLOPT_CXX_INCLUDE_DIR})
    target_link_libraries(rugosa::nlopt INTERFACE ${NLOPT_CXX_LIBRARY})
endif()
if(NOT TARGET rugosa::fftw)
    find_path(FFTW3_INCLUDE_DIR fftw3.h REQUIRED)
    find_library(FFTW3_LIBRARY fftw3 REQUIRED)
    find_library(FFTW3F_LIBRARY fftw3f REQUIRED) # single precision
    add_library(rugosa::fftw INTERFACE IMPORTED)
    target_include_directories(rugosa::fftw INTERFACE ${FFTW3_INCLUDE_DIR})
    target_link_libraries(rugosa::fftw INTERFACE ${FFTW3_LIBRARY} ${FFTW3F_LIBRARY})
endif()
