# cmake -D source=… -D build=… -D node=… -P viewer_packages.cmake
# Puts the packages of viewer/package-lock.json into the build folder.
cmake_minimum_required(VERSION 3.25)
cmake_path(GET node PARENT_PATH node_folder)
find_file(npm npm-cli.js PATHS ${node_folder}/../lib/node_modules/npm/bin NO_DEFAULT_PATH)
if(npm)
  set(command ${node} ${npm})
else()
  find_program(npm_program npm HINTS ${node_folder})
  if(NOT npm_program)
    message(FATAL_ERROR "There is no npm beside ${node} and none on the PATH: run tools/setup.sh, which brings both.")
  endif()
  set(command ${npm_program})
endif()
file(COPY ${source}/package.json ${source}/package-lock.json DESTINATION ${build})
execute_process(COMMAND ${CMAKE_COMMAND} -E env "PATH=${node_folder}:$ENV{PATH}"
                        ${command} ci --ignore-scripts --no-audit --no-fund --prefer-offline
                WORKING_DIRECTORY ${build} RESULT_VARIABLE failed OUTPUT_VARIABLE text ERROR_VARIABLE text)
if(failed)
  message("${text}")
  message(FATAL_ERROR "The packages of the viewer's page could not be fetched, for the reason above: check the network "
                      "and npm's settings (`npm config list`), then build again.")
endif()
