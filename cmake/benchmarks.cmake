# Benchmarks: one executable for each benchmarks/*.cpp, with what a folder of its name has. Not part
# of a plain build: `ninja benchmarks`.

add_custom_target(benchmarks)
file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/benchmarks/*.cpp)
foreach(source IN LISTS sources)
  cmake_path(GET source STEM name)
  file(GLOB parts CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/benchmarks/${name}/*.cpp)
  add_executable(benchmark_${name} EXCLUDE_FROM_ALL ${source} ${parts})
  add_dependencies(benchmarks benchmark_${name})
  target_link_libraries(benchmark_${name} PRIVATE ${SUREFOOT_TEST_LIBRARIES} benchmark::benchmark
    mujoco::mujoco)
endforeach()

# benchmark_solver: with the solvers of others that tools/setup_benchmarks.sh has put into
# build/peers. What isn't there is left out, and said.
target_sources(benchmark_solver PRIVATE ${PROJECT_SOURCE_DIR}/tests/tasks/scene.cpp)
target_link_libraries(benchmark_solver PRIVATE CLI11::CLI11 nlohmann_json::nlohmann_json)

set(SUREFOOT_PEERS ${PROJECT_SOURCE_DIR}/build/peers CACHE PATH "Solvers to compare with")
set(peers_prefix ${SUREFOOT_PEERS}/site/cmeel.prefix)
set(peers_found)
set(peers_missing)

# surefoot_peer(NAME FILE): compiles benchmarks/peers/NAME.cpp in, if the file is there.
macro(surefoot_peer name file)
  if(EXISTS ${file})
    list(APPEND peers_found ${name})
    string(TOUPPER ${name} upper)
    target_sources(benchmark_solver PRIVATE ${PROJECT_SOURCE_DIR}/benchmarks/peers/${name}.cpp)
    target_compile_definitions(benchmark_solver PRIVATE SUREFOOT_PEER_${upper})
  else()
    list(APPEND peers_missing ${name})
  endif()
endmacro()

file(GLOB daqp_folder ${SUREFOOT_PEERS}/sources/daqp-*/csrc)
surefoot_peer(daqp "${daqp_folder}/include/api.h")
surefoot_peer(eiquadprog ${peers_prefix}/lib/libeiquadprog.so)
surefoot_peer(qpoases ${peers_prefix}/lib/libqpOASES.so)
surefoot_peer(proxqp ${peers_prefix}/include/proxsuite/proxqp/dense/dense.hpp)
if(peers_found)
  target_include_directories(benchmark_solver SYSTEM PRIVATE ${peers_prefix}/include)
endif()
if(daqp IN_LIST peers_found)
  file(GLOB sources ${daqp_folder}/src/*.c)
  add_library(peer_daqp STATIC EXCLUDE_FROM_ALL ${sources})
  target_include_directories(peer_daqp SYSTEM PUBLIC ${daqp_folder}/include)
  # Plain C that exchanges nothing but arrays of double: it may have this machine's instructions.
  target_compile_options(peer_daqp PRIVATE -O3 -march=native -w
    -fassociative-math -fno-signed-zeros -fno-trapping-math)  # as its own package is built
  target_link_libraries(benchmark_solver PRIVATE peer_daqp)
endif()
if(eiquadprog IN_LIST peers_found)
  target_link_libraries(benchmark_solver PRIVATE ${peers_prefix}/lib/libeiquadprog.so)
endif()
if(qpoases IN_LIST peers_found)
  target_link_libraries(benchmark_solver PRIVATE ${peers_prefix}/lib/libqpOASES.so)
endif()
list(JOIN peers_found " " peers_found)
list(JOIN peers_missing " " peers_missing)
if(peers_missing)
  message(STATUS "Peers of the solver benchmark: ${peers_found} (missing: ${peers_missing}; tools/setup_benchmarks.sh brings them)")
else()
  message(STATUS "Peers of the solver benchmark: ${peers_found}")
endif()
