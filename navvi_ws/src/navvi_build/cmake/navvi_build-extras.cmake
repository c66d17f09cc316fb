# How NavVI's own code is compiled: C++17, position independent, with line numbers but no more for a debugger.
# Third-party headers are SYSTEM.
option(NAVVI_WARNINGS_ARE_ERRORS "Warnings in NavVI's own code end the build" OFF)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE RelWithDebInfo)
endif()
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O2 -g1 -DNDEBUG")
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

# Without fused multiply-adds a seed gives the same trial on processors that have them.
set(NAVVI_CODE_OPTIONS -ffp-contract=off -Wall -Wextra -Wconversion -Winvalid-pch -fno-semantic-interposition)
if(NAVVI_WARNINGS_ARE_ERRORS)
  list(APPEND NAVVI_CODE_OPTIONS -Werror)
endif()

function(navvi_own_code)
  # All files see the same macros, so that they can share precompiled headers; rosconsole's logger is ros.navvi.
  get_property(macros DIRECTORY PROPERTY COMPILE_DEFINITIONS)
  list(FILTER macros EXCLUDE REGEX "^ROS_PACKAGE_NAME=")
  set_property(DIRECTORY PROPERTY COMPILE_DEFINITIONS ${macros})
  foreach(target ${ARGN})
    get_target_property(macros ${target} COMPILE_DEFINITIONS)
    list(FILTER macros EXCLUDE REGEX "^ROS_PACKAGE_NAME=|NOTFOUND$")
    set_property(TARGET ${target} PROPERTY COMPILE_DEFINITIONS ${macros} ROS_PACKAGE_NAME="navvi")
    target_compile_features(${target} PUBLIC cxx_std_17)
    target_compile_options(${target} PRIVATE ${NAVVI_CODE_OPTIONS})
    get_target_property(beside_the_product ${target} EXCLUDE_FROM_ALL)
    if(NAVVI_ODR_CHECK AND NOT beside_the_product)
      navvi_odr_check(${target})
    endif()
  endforeach()
endfunction()

# navvi_precompiled(TARGET HEADERS): room, ros or test.
function(navvi_precompiled target headers)
  if(TARGET navvi_${headers}_headers)
    target_precompile_headers(${target} REUSE_FROM navvi_${headers}_headers)
  endif()
endfunction()

# A room of a package: the library <package>_<room> from src/<room>/*.cpp. Its tests, src/<room>/*_test.cpp, are in the
# package's test program (navvi_tests).
#   ROS       it uses what catkin found
#   USES      rooms of this package, declared before it, whose headers it may include
#   LINK      other targets and libraries
#   SYSTEM    include folders of third parties
#   PROGRAMS  source files with a main(), each a program that links the room and is installed
# Inside the package a header is included as "<room>/<file>.hpp". Headers that other packages need are in
# include/<package>/<room>.
function(navvi_room room)
  cmake_parse_arguments(ROOM "ROS" "" "USES;LINK;SYSTEM;PROGRAMS" ${ARGN})
  set(target ${PROJECT_NAME}_${room})
  set(folder ${CMAKE_CURRENT_SOURCE_DIR}/src/${room})
  file(GLOB sources ${folder}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
  foreach(program ${ROOM_PROGRAMS})
    list(REMOVE_ITEM sources ${folder}/${program}.cpp)
  endforeach()
  if(ROOM_ROS)
    list(APPEND ROOM_LINK ${catkin_LIBRARIES})
    list(APPEND ROOM_SYSTEM ${catkin_INCLUDE_DIRS})
    set(headers ros)
  else()
    set(headers room)
  endif()
  if(sources)
    add_library(${target} STATIC ${sources})
    navvi_own_code(${target})
    navvi_precompiled(${target} ${headers})
    set(visibility PUBLIC)
    if(ROOM_ROS AND catkin_EXPORTED_TARGETS)
      add_dependencies(${target} ${catkin_EXPORTED_TARGETS})
    endif()
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
  set_property(DIRECTORY APPEND PROPERTY NAVVI_ROOMS ${target})
  foreach(program ${ROOM_PROGRAMS})
    # As an object, its flags are those of a room, and so are its headers.
    add_library(${program}_main OBJECT ${folder}/${program}.cpp)
    target_link_libraries(${program}_main ${target})
    navvi_own_code(${program}_main)
    navvi_precompiled(${program}_main ${headers})
    add_executable(${program} $<TARGET_OBJECTS:${program}_main>)
    target_link_libraries(${program} ${target})
    install(TARGETS ${program} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
  endforeach()
endfunction()

# Tests compile in 0.7 of the time with it, and test code is seldom what takes long. Without optimization their copies of
# inline functions, which the linker takes for the rooms too, would slow down what they test. At -O1 GCC takes members of
# an empty optional for uninitialized.
set(NAVVI_TEST_OPTIMIZATION -O1 -Wno-maybe-uninitialized)

# The tests of a package: one program, <package>_tests, of all src/**/*_test.cpp, linked to the rooms declared so far;
# ctest runs it once for each of the files, in parallel.
#   LINK      targets and libraries besides the rooms
#   PROGRAMS  programs that the tests start
#   WHOLE, RELEASE  files, such as live/world, whose tests are too long for a commit (CONTRIBUTING.md has the tiers)
function(navvi_tests)
  if(NOT CATKIN_ENABLE_TESTING)
    return()
  endif()
  cmake_parse_arguments(TESTS "" "" "LINK;PROGRAMS;WHOLE;RELEASE" ${ARGN})
  set(target ${PROJECT_NAME}_tests)
  file(GLOB_RECURSE files RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}/src src/*_test.cpp)
  list(TRANSFORM files PREPEND src/ OUTPUT_VARIABLE sources)
  add_executable(${target} EXCLUDE_FROM_ALL ${sources} $<TARGET_OBJECTS:navvi_test_main>)
  get_property(rooms DIRECTORY PROPERTY NAVVI_ROOMS)
  target_link_libraries(${target} ${rooms} ${TESTS_LINK} ${GTEST_LIBRARIES})
  target_include_directories(${target} PRIVATE $<TARGET_PROPERTY:navvi_test_main,SOURCE_DIR>/test)
  set_target_properties(${target} PROPERTIES
    POSITION_INDEPENDENT_CODE OFF RUNTIME_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  navvi_own_code(${target})
  target_compile_options(${target} PRIVATE ${NAVVI_TEST_OPTIMIZATION})
  navvi_precompiled(${target} test)
  add_dependencies(core_tests ${target})
  foreach(program ${TESTS_PROGRAMS})
    add_dependencies(${target} ${program})
    string(TOUPPER ${program} macro)
    target_compile_definitions(${target} PRIVATE ${macro}="$<TARGET_FILE:${program}>")
  endforeach()
  foreach(file ${files})
    string(REGEX REPLACE "_test\\.cpp$" "" name ${file})
    string(REPLACE "/" "." result ${name})
    add_test(NAME ${PROJECT_NAME}/${name} COMMAND ${target} --file=src/${file}
      --gtest_output=xml:${CMAKE_BINARY_DIR}/test_results/${PROJECT_NAME}/${result}.xml)
    set(tier quick)
    if(name IN_LIST TESTS_WHOLE)
      set(tier whole)
    elseif(name IN_LIST TESTS_RELEASE)
      set(tier release)
    endif()
    set_tests_properties(${PROJECT_NAME}/${name} PROPERTIES LABELS ${tier} TIMEOUT 900 PROCESSORS 2)
  endforeach()
endfunction()

# The test NAME of a node: test/NAME.cpp, started with a ROS master by each of test/LAUNCHES.
function(navvi_node_test name launches)
  if(NOT CATKIN_ENABLE_TESTING)
    return()
  endif()
  find_package(rostest REQUIRED)
  list(POP_FRONT launches first)
  add_rostest_gtest(${name} test/${first} test/${name}.cpp)
  target_link_libraries(${name} ${ARGN})
  target_include_directories(${name} PRIVATE $<TARGET_PROPERTY:navvi_test_main,SOURCE_DIR>/test)
  navvi_own_code(${name})
  navvi_precompiled(${name} test)
  foreach(launch ${first} ${launches})
    if(launch IN_LIST launches)
      add_rostest(test/${launch} DEPENDENCIES ${name})
    endif()
    set_tests_properties(_ctest_${PROJECT_NAME}_rostest_test_${launch} PROPERTIES LABELS whole TIMEOUT 600)
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
