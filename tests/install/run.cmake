# Installs the build tree BUILD into an empty folder, then configures, builds and runs the consumer
# against it, as a user would: with nothing of the source tree but two programs.

set(prefix ${BUILD}/install_test/prefix)
set(consumer ${BUILD}/install_test/consumer)
file(REMOVE_RECURSE ${prefix} ${consumer})

execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix}
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE}/tests/install -B ${consumer} -G Ninja
                -D CMAKE_BUILD_TYPE=Release -D CMAKE_PREFIX_PATH=${prefix}
                -D CONTROL_LOOP=${SOURCE}/examples/02_control_loop.cpp COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${consumer} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${consumer}/consumer COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} -E env SUREFOOT_DATA_DIR=${prefix}/share/surefoot
                ${consumer}/control_loop COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${prefix}/bin/surefoot --version COMMAND_ERROR_IS_FATAL ANY)

# The solver alone: asked for, and where nothing but Eigen can be found.
set(nothing_else)
foreach(package pinocchio tinyxml2 yaml-cpp zstd mujoco nlohmann_json)
  list(APPEND nothing_else -D CMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
foreach(components "COMPONENTS\\;solver" "")
  set(alone ${BUILD}/install_test/solver)
  file(REMOVE_RECURSE ${alone})
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE}/tests/install/solver -B ${alone} -G Ninja
                  -D CMAKE_BUILD_TYPE=Release -D CMAKE_PREFIX_PATH=${prefix} ${nothing_else}
                  "-DCOMPONENTS=${components}" -D EXAMPLE=${SOURCE}/examples/11_share_a_load.cpp
                  COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${alone} COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${alone}/solver_alone COMMAND_ERROR_IS_FATAL ANY)
endforeach()
