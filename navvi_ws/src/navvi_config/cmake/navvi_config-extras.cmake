# How NavVI's own code is compiled: C++17, and every warning an error. Third-party headers are SYSTEM.
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE RelWithDebInfo)
endif()

function(navvi_own_code)
  foreach(target ${ARGN})
    target_compile_features(${target} PUBLIC cxx_std_17)
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wconversion -Werror)
  endforeach()
endfunction()

# The test test/<name>.cpp, linked to the targets that follow. All packages share one name space of targets, so its
# target bears the package's name as well.
function(navvi_gtest name)
  set(target ${PROJECT_NAME}_${name})
  catkin_add_gtest(${target} test/${name}.cpp)
  target_link_libraries(${target} ${ARGN})
  navvi_own_code(${target})
endfunction()
