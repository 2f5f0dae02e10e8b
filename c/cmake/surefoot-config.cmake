# The library of one robot for one target, beside this file. What it is called after find_package: surefoot::surefoot.
if(NOT TARGET surefoot::surefoot)
  add_library(surefoot::surefoot STATIC IMPORTED)
  set_target_properties(surefoot::surefoot PROPERTIES
    IMPORTED_LOCATION ${CMAKE_CURRENT_LIST_DIR}/libsurefoot_c.a
    INTERFACE_INCLUDE_DIRECTORIES ${CMAKE_CURRENT_LIST_DIR})
  # On a system with one, what Rust's standard library needs.
  if(CMAKE_SYSTEM_NAME STREQUAL "Linux")
    set_target_properties(surefoot::surefoot PROPERTIES INTERFACE_LINK_LIBRARIES "m;pthread;dl")
  endif()
endif()
