# Tests, examples and benchmarks. One executable for each folder of tests/; ctest counts every case.

set(CMAKE_UNITY_BUILD OFF)  # their helpers share names
find_package(GTest REQUIRED)
find_package(benchmark REQUIRED)
include(GoogleTest)
set(CMAKE_GTEST_DISCOVER_TESTS_DISCOVERY_MODE PRE_TEST)

# One file knows the tree's place, so that ccache shares all others between checkouts.
set_source_files_properties(${PROJECT_SOURCE_DIR}/tests/support/source_file.cpp PROPERTIES
  COMPILE_DEFINITIONS SUREFOOT_SOURCE_DIR="${PROJECT_SOURCE_DIR}")

# tests/support/ is compiled into a library of its own, used as "tests/support/….hpp".
file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/support/*.cpp)
set(SUREFOOT_TEST_LIBRARIES surefoot_compiler surefoot_count_allocations ${SUREFOOT_LIBRARIES})
if(sources)
  add_library(surefoot_test_support STATIC ${sources})
  target_link_libraries(surefoot_test_support PUBLIC ${SUREFOOT_TEST_LIBRARIES} GTest::gtest)
  list(PREPEND SUREFOOT_TEST_LIBRARIES surefoot_test_support)
endif()

file(GLOB sources CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/tests ${PROJECT_SOURCE_DIR}/tests/*/*.cpp)
list(FILTER sources EXCLUDE REGEX "^(support|install)/")
foreach(source IN LISTS sources)
  cmake_path(GET source PARENT_PATH folder)
  if(NOT TARGET test_${folder})
    add_executable(test_${folder})
    # Tests may look at every stage's third-party types, to check against them.
    target_link_libraries(test_${folder} PRIVATE ${SUREFOOT_TEST_LIBRARIES} GTest::gtest_main
      nlohmann_json::nlohmann_json mujoco::mujoco yaml-cpp::yaml-cpp zstd::libzstd_shared)
    # What walks for a while is labelled, so that a quick run can leave it out.
    if(folder STREQUAL "scenarios")
      set(labels PROPERTIES LABELS slow)
    else()
      set(labels)
    endif()
    gtest_discover_tests(test_${folder} TEST_PREFIX ${folder}/ NO_PRETTY_VALUES
                         DISCOVERY_TIMEOUT 60 ${labels})
  endif()
  target_sources(test_${folder} PRIVATE ${PROJECT_SOURCE_DIR}/tests/${source})
endforeach()

file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/examples/*.cpp)
foreach(source IN LISTS sources)
  cmake_path(GET source STEM name)
  add_executable(example_${name} ${source})
  target_link_libraries(example_${name} PRIVATE surefoot_compiler ${SUREFOOT_LIBRARIES})
  add_test(NAME examples/${name} COMMAND example_${name} WORKING_DIRECTORY ${PROJECT_BINARY_DIR})
  set_tests_properties(examples/${name} PROPERTIES
    ENVIRONMENT "SUREFOOT_PYTHON=${SUREFOOT_PYTHON};PYTHONPATH=${PROJECT_BINARY_DIR}/python"
    ENVIRONMENT_MODIFICATION "PATH=path_list_prepend:${PROJECT_BINARY_DIR}/bin")
endforeach()

include(benchmarks)

add_test(NAME viewer/logic COMMAND ${SUREFOOT_NODE} ${viewer_source}/bundle.mjs ${viewer_source} --test
         WORKING_DIRECTORY ${viewer_build})

add_test(NAME checks/layers COMMAND ${SUREFOOT_PYTHON} ${PROJECT_SOURCE_DIR}/tools/check_layers.py)
add_test(NAME checks/faults COMMAND ${SUREFOOT_PYTHON} ${PROJECT_SOURCE_DIR}/tools/faults.py --list)
add_test(NAME checks/format COMMAND ${PROJECT_SOURCE_DIR}/tools/check_format.sh)
add_test(NAME install/consumer COMMAND ${CMAKE_COMMAND} -D BUILD=${PROJECT_BINARY_DIR} -D VERSION=${PROJECT_VERSION}
         -D SOURCE=${PROJECT_SOURCE_DIR} -P ${PROJECT_SOURCE_DIR}/tests/install/run.cmake)
set_tests_properties(install/consumer PROPERTIES LABELS slow)
