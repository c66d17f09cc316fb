# How NavVI's own code is compiled: C++17, and every warning an error. Third-party headers are SYSTEM.
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE RelWithDebInfo)
endif()

function(navvi_own_code)
  foreach(target ${ARGN})
    target_compile_features(${target} PUBLIC cxx_std_17)
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wconversion -Werror)
    get_target_property(type ${target} TYPE)
    get_target_property(beside_the_product ${target} EXCLUDE_FROM_ALL)
    if(NAVVI_ODR_CHECK AND NOT beside_the_product)
      navvi_odr_check(${target})
    endif()
    if(type STREQUAL SHARED_LIBRARY)
      navvi_precompiled_headers(${target} navvi_library_headers)
    endif()
  endforeach()
endfunction()

# Most of the time that a file needs is spent on the headers of the standard library, Eigen and gtest.
# They are parsed once for the libraries of all packages, and once for their tests. The build with
# sanitizers does without, and so proves that each file includes what it uses.
if(NOT NAVVI_ODR_CHECK AND NOT TARGET navvi_library_headers
    AND EXISTS ${CMAKE_CURRENT_LIST_DIR}/precompiled)
  add_subdirectory(${CMAKE_CURRENT_LIST_DIR}/precompiled ${CMAKE_BINARY_DIR}/navvi_precompiled)
endif()
function(navvi_precompiled_headers target headers)
  if(TARGET ${headers})
    set_target_properties(${target} PROPERTIES PCH_WARN_INVALID OFF)
    target_precompile_headers(${target} REUSE_FROM ${headers})
  endif()
endfunction()

# Adds a target's objects to those whose types the target odr_check compares: two types of one name
# in one program break the One Definition Rule (C++17 [basic.def.odr]), and neither the compiler nor
# the linker sees it. Needs objects compiled by GCC with -flto (`./navvi build --odr`).
function(navvi_odr_check target)
  if(NOT TARGET odr_check)
    # Nothing is optimized or linked: -flinker-output=rel merges the types and writes them out again.
    # Every program has a main of its own, hence muldefs.
    add_custom_target(odr_check
      COMMAND ${CMAKE_CXX_COMPILER} -r -flto -flinker-output=rel -Werror=odr
        -Werror=lto-type-mismatch -Wl,-z,muldefs -o ${CMAKE_BINARY_DIR}/odr_check.o
        "$<GENEX_EVAL:$<TARGET_PROPERTY:odr_check,PRODUCT_OBJECTS>>"
      COMMAND_EXPAND_LISTS VERBATIM)
  endif()
  set_property(TARGET odr_check APPEND PROPERTY PRODUCT_OBJECTS $<TARGET_OBJECTS:${target}>)
  add_dependencies(odr_check ${target})
endfunction()

# The test test/<name>.cpp, linked to the targets that follow. All packages share one name space of targets, so its
# target bears the package's name as well.
function(navvi_gtest name)
  set(target ${PROJECT_NAME}_${name})
  catkin_add_gtest(${target} test/${name}.cpp)
  target_link_libraries(${target} ${ARGN})
  navvi_own_code(${target})
  navvi_precompiled_headers(${target} navvi_test_headers)
endfunction()
