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
