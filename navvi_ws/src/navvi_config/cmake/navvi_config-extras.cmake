# How NavVI's own code is compiled: C++17, and every warning an error. Third-party headers are SYSTEM.
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE RelWithDebInfo)
endif()

function(navvi_own_code)
  foreach(target ${ARGN})
    target_compile_features(${target} PUBLIC cxx_std_17)
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wconversion -Werror)
    get_target_property(beside_the_product ${target} EXCLUDE_FROM_ALL)
    if(NAVVI_ODR_CHECK AND NOT beside_the_product)
      navvi_odr_check(${target})
    endif()
  endforeach()
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
endfunction()
