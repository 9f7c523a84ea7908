# find_package(jostle): the target jostle::jostle, and the libraries that it needs itself.
include(${CMAKE_CURRENT_LIST_DIR}/jostle-libraries.cmake)
if(jostle_missing)
  jostle_advise()
  set(jostle_FOUND FALSE)
  set(jostle_NOT_FOUND_MESSAGE "${jostle_advice}")
  return()
endif()
include(${CMAKE_CURRENT_LIST_DIR}/jostle_targets.cmake)
