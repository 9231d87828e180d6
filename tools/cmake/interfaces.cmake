# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
#
# Makes an interface package build in a third of the time, with the ROS wheels. Given to CMake as
# CMAKE_PROJECT_<name>_INCLUDE; the package itself knows nothing of it, and builds without it too.

# 1. No C++ messages: the wheels have no rclcpp to use them with. The generators register
#    themselves when they are found for the first time, so that a later find_package in the
#    package does not bring these back.
find_package(ament_cmake REQUIRED)
find_package(rosidl_default_generators REQUIRED)
list(FILTER AMENT_EXTENSIONS_rosidl_generate_idl_interfaces EXCLUDE REGEX
  "^rosidl_(generator|typesupport|typesupport_introspection|typesupport_fastrtps)_cpp:")

# 2. The generated type support consists of some hundred tiny sources that all parse the same
#    headers: several are compiled as one. (Those of the C generator define equal static names and
#    cannot be joined.)
function(_aurora_join_sources)
  foreach(kind rosidl_typesupport_c rosidl_typesupport_introspection_c
          rosidl_typesupport_fastrtps_c)
    if(TARGET ${PROJECT_NAME}__${kind})
      set_target_properties(${PROJECT_NAME}__${kind} PROPERTIES
        UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 16)
      target_compile_options(${PROJECT_NAME}__${kind} PRIVATE
        $<$<COMPILE_LANGUAGE:CXX>:-Wno-redundant-decls>)
    endif()
  endforeach()
endfunction()
cmake_language(DEFER DIRECTORY "${CMAKE_SOURCE_DIR}" CALL _aurora_join_sources)
