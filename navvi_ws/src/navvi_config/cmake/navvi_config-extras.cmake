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

# A room of a package: the library <package>_<room> from src/<room>/*.cpp, with a test for each src/<room>/*_test.cpp.
#   USES      rooms of this package, declared before it, whose headers it may include
#   LINK      other targets and libraries
#   SYSTEM    include folders of third parties
#   PROGRAMS  source files with a main(), each a program that links the room and is installed
#   TEST_LINK what its tests link besides
# Inside the package a header is included as "<room>/<file>.hpp". Headers that other packages need are in
# include/<package>/<room>.
function(navvi_room room)
  cmake_parse_arguments(ROOM "" "" "USES;LINK;SYSTEM;PROGRAMS;TEST_LINK" ${ARGN})
  set(target ${PROJECT_NAME}_${room})
  set(folder ${CMAKE_CURRENT_SOURCE_DIR}/src/${room})
  file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.cpp)
  set(tests ${sources})
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
  list(FILTER tests INCLUDE REGEX "_test\\.cpp$")
  foreach(program ${ROOM_PROGRAMS})
    list(REMOVE_ITEM sources ${folder}/${program}.cpp)
  endforeach()
  if(sources)
    add_library(${target} STATIC ${sources})
    navvi_own_code(${target})
    navvi_precompiled_headers(${target} navvi_library_headers)
    set(visibility PUBLIC)
  else()
    add_library(${target} INTERFACE)
    set(visibility INTERFACE)
  endif()
  if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/include)
    target_include_directories(${target} ${visibility} ${CMAKE_CURRENT_SOURCE_DIR}/include)
  endif()
  target_include_directories(${target} SYSTEM ${visibility} ${ROOM_SYSTEM})
  list(TRANSFORM ROOM_USES PREPEND ${PROJECT_NAME}_)
  target_link_libraries(${target} ${visibility} ${ROOM_USES} ${ROOM_LINK})
  foreach(program ${ROOM_PROGRAMS})
    add_executable(${program} ${folder}/${program}.cpp)
    target_link_libraries(${program} ${target})
    navvi_own_code(${program})
    install(TARGETS ${program} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
  endforeach()
  if(CATKIN_ENABLE_TESTING)
    foreach(test ${tests})
      navvi_gtest(${test} ${target} ${ROOM_TEST_LINK})
    endforeach()
  endif()
endfunction()

# The core test FILE, linked to the targets that follow. All packages share one name space of targets, so its target
# bears the package's name as well.
function(navvi_gtest file)
  get_filename_component(name ${file} NAME_WE)
  set(target ${PROJECT_NAME}_${name})
  catkin_add_gtest(${target} ${file})
  target_link_libraries(${target} ${ARGN})
  navvi_own_code(${target})
  navvi_precompiled_headers(${target} navvi_test_headers)
endfunction()

# Most of the time that a file needs is spent on the headers of the standard library, Eigen and gtest.
# They are parsed once for the rooms of all packages, and once for their tests. The build with
# sanitizers does without, and so proves that each file includes what it uses.
if(NOT NAVVI_ODR_CHECK AND NOT TARGET navvi_library_headers
    AND EXISTS "${CMAKE_CURRENT_LIST_DIR}/precompiled")
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
