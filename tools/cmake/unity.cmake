# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
#
# Halves the build time of an interface package: its generated type support consists of some
# hundred tiny sources which all parse the same headers, so several are compiled as one. Given to
# CMake as CMAKE_PROJECT_<name>_INCLUDE; the package itself knows nothing of it. The sources of
# the C generator (equal static names) and of the C++ introspection (templates specialised after
# use) cannot be joined and are left alone.
function(_aurora_unity)
  foreach(kind rosidl_typesupport_c rosidl_typesupport_cpp rosidl_typesupport_introspection_c
          rosidl_typesupport_fastrtps_c rosidl_typesupport_fastrtps_cpp)
    if(TARGET ${PROJECT_NAME}__${kind})
      set_target_properties(${PROJECT_NAME}__${kind} PROPERTIES
        UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 16)
      target_compile_options(${PROJECT_NAME}__${kind} PRIVATE
        $<$<COMPILE_LANGUAGE:CXX>:-Wno-redundant-decls>)
    endif()
  endforeach()
endfunction()
cmake_language(DEFER DIRECTORY "${CMAKE_SOURCE_DIR}" CALL _aurora_unity)
