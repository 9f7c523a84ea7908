# Finds every library that jostle needs, and makes a target of each. Used by CMakeLists.txt and, installed, by jostle-config.cmake.
#
# Leaves in jostle_missing a line for each library that is not there, with its Debian package, and in jostle_advice what to do about them all.
# Headers are enough for most: they are found in CMAKE_PREFIX_PATH, then where the system keeps its own, without files of CMake or pkg-config.
set(jostle_missing "")
set(jostle_packages "")

macro(jostle_lacks what package)
  string(APPEND jostle_missing "\n  ${what}: ${package}")
  string(APPEND jostle_packages " ${package}")
endmacro()

# jostle_headers(TARGET HEADER PACKAGE [SUFFIX folder] [LIBRARY name] [COMPILED definitions] [HEADER_ONLY definitions])
# A library that works from its headers alone. Its compiled form is linked where it lies beside these headers, so that the two always fit.
macro(jostle_headers target header package)
  cmake_parse_arguments(of "" "SUFFIX;LIBRARY" "COMPILED;HEADER_ONLY" ${ARGN})
  string(REGEX REPLACE "::.*" "" name ${target})
  if(NOT TARGET ${target})
    find_path(${name}_INCLUDE_DIR ${header} PATH_SUFFIXES ${of_SUFFIX} DOC "Folder of ${header}")
    mark_as_advanced(${name}_INCLUDE_DIR)
    if(NOT ${name}_INCLUDE_DIR)
      jostle_lacks("${header}" ${package})
    else()
      add_library(${target} INTERFACE IMPORTED)
      target_include_directories(${target} SYSTEM INTERFACE ${${name}_INCLUDE_DIR})
      set(library library-NOTFOUND)
      if(of_LIBRARY)
        cmake_path(GET ${name}_INCLUDE_DIR PARENT_PATH root)
        find_library(library ${of_LIBRARY} NO_CACHE NO_DEFAULT_PATH PATHS ${root}/lib/${CMAKE_LIBRARY_ARCHITECTURE} ${root}/lib64 ${root}/lib)
      endif()
      if(library)
        target_link_libraries(${target} INTERFACE ${library})
        target_compile_definitions(${target} INTERFACE ${of_COMPILED})
      else()
        target_compile_definitions(${target} INTERFACE ${of_HEADER_ONLY})
      endif()
    endif()
  endif()
endmacro()

jostle_headers(Eigen3::Eigen Eigen/Eigenvalues libeigen3-dev SUFFIX eigen3)
jostle_headers(fmt::fmt fmt/format.h libfmt-dev LIBRARY fmt HEADER_ONLY FMT_HEADER_ONLY)
jostle_headers(kissfft::kissfft kissfft/kissfft.hh libkissfft-dev)
jostle_headers(nlohmann_json::nlohmann_json nlohmann/json.hpp nlohmann-json3-dev)
jostle_headers(Random123::Random123 Random123/philox.h librandom123-dev)
jostle_headers(tomlplusplus::tomlplusplus toml++/toml.h libtomlplusplus-dev LIBRARY tomlplusplus COMPILED TOML_HEADER_ONLY=0 TOML_SHARED_LIB=1)
jostle_headers(xxhash::xxhash xxhash.h libxxhash-dev LIBRARY xxhash HEADER_ONLY XXH_INLINE_ALL)

find_package(OpenMP QUIET COMPONENTS CXX)
if(NOT OpenMP_CXX_FOUND)
  jostle_lacks("OpenMP of the C++ compiler" "g++")
endif()
find_package(HDF5 QUIET COMPONENTS C HL)
if(NOT HDF5_FOUND OR NOT TARGET hdf5::hdf5_hl)
  jostle_lacks("HDF5 with its high-level library (HDF5_ROOT names its folder)" libhdf5-dev)
endif()
find_package(Qhull QUIET NO_MODULE)
if(NOT TARGET Qhull::qhull_r)
  jostle_lacks("Qhull, reentrant (QhullConfig.cmake)" libqhull-dev)
endif()

macro(jostle_advise)  # lines that are indented stay whole
  string(CONCAT jostle_advice "jostle needs libraries that are not there, here with their Debian packages:${jostle_missing}\n"
         "On Debian:\n  apt-get install${jostle_packages}\n"
         "Elsewhere, and without root, put them under a folder of your own, and give it: -DCMAKE_PREFIX_PATH=FOLDER (docs/guide/installing.md)")
endmacro()
