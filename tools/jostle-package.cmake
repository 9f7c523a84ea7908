# cpack makes a Debian package of what is built: the command with its Python programs and, if it is built, the Python module. Not the headers.
#
#     cpack --config build/release/CPackConfig.cmake -B build/package      (package dpkg-dev)
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME jostle)
set(CPACK_PACKAGE_CONTACT "the jostle authors <jostle@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL command)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
# Libraries of which the program holds the link; their packages are found by dpkg-shlibdeps.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# A run needs no Python: reports, sweeps, exports and films do.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3 (>= 3.11), python3-numpy, python3-h5py, python3-matplotlib, python3-scipy")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "povray, ffmpeg, python3-gsd, python3-pandas")
if(TARGET _jostle)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
include(CPack)
