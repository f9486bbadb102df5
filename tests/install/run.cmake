# Installs the build tree BUILD into an empty folder, moves it, and configures, builds and runs a
# consumer against it, as a user would: with nothing of the source tree but its examples.

set(folder ${BUILD}/install_test)
set(prefix ${folder}/moved)
file(REMOVE_RECURSE ${folder})

function(configure source build)
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE}/tests/install${source} -B ${folder}/${build} -G Ninja
                  -D VERSION=${VERSION}
                  -D CMAKE_BUILD_TYPE=Release ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
function(build build)
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${folder}/${build} ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${folder} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${folder}/installed
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(RENAME ${folder}/installed ${prefix})

configure("" consumer -D CMAKE_PREFIX_PATH=${prefix} -D EXAMPLES=${SOURCE}/examples)
build(consumer)
run(${folder}/consumer/consumer)
run(${folder}/consumer/02_control_loop)
run(${folder}/consumer/04_own_task)
run(${prefix}/bin/surefoot --version)
# The data are the package's: without its stacks nothing is found, though the source tree has them.
file(RENAME ${prefix}/share/surefoot/stacks ${folder}/stacks)
execute_process(COMMAND ${folder}/consumer/02_control_loop RESULT_VARIABLE result OUTPUT_QUIET ERROR_QUIET)
if(result EQUAL 0)
  message(FATAL_ERROR "A program of the package reads stacks of elsewhere.")
endif()

# The solver alone: asked for, and where nothing but Eigen can be found.
set(nothing_else)
foreach(package pinocchio tinyxml2 yaml-cpp zstd mujoco nlohmann_json)
  list(APPEND nothing_else -D CMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
foreach(components "COMPONENTS\\;solver" "")
  file(REMOVE_RECURSE ${folder}/solver)
  configure(/solver solver -D CMAKE_PREFIX_PATH=${prefix} ${nothing_else} "-DCOMPONENTS=${components}"
            -D EXAMPLE=${SOURCE}/examples/11_share_a_load.cpp)
  build(solver)
  run(${folder}/solver/solver_alone)
endforeach()

# Within an own project. The flags are the build tree's, so that ccache knows the objects.
foreach(fetches ON OFF)
  configure(/subproject subproject_${fetches} -D SUREFOOT=${SOURCE} -D FETCHES=${fetches}
            "-DCMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG" -D SUREFOOT_WARNINGS_AS_ERRORS=ON)
endforeach()
build(subproject_ON --target solver_alone)
run(${folder}/subproject_ON/solver_alone)
# A program with a Controller is compiled and linked as there. The libraries are the build tree's: to build them again
# would take minutes.
file(GLOB libraries ${BUILD}/libsurefoot_*.a)
file(COPY ${libraries} DESTINATION ${folder}/subproject_ON/_deps/surefoot-build)
build(subproject_ON --target ${SOURCE}/examples/02_control_loop.cpp^)
find_program(ninja NAMES ninja ninja-build REQUIRED)
execute_process(COMMAND ${ninja} -C ${folder}/subproject_ON -t commands control_loop OUTPUT_VARIABLE link
                COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE ".*\n([^\n]+)\n$" "\\1" link "${link}")
run(sh -c "cd subproject_ON && ${link}")
run(${folder}/subproject_ON/control_loop)
