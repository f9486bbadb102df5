# What all our targets are compiled with.
#
# Never -march or AVX flags here: Eigen objects are exchanged with prebuilt libraries, and another
# alignment than theirs corrupts the heap.

add_library(surefoot_compiler INTERFACE)
# Warnings are errors with the compiler that the tests use. Newer ones also warn of paths in Eigen that are never taken.
target_compile_options(surefoot_compiler INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Woverloaded-virtual
  $<$<AND:$<BOOL:${SUREFOOT_WARNINGS_AS_ERRORS}>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Werror>)
# A program loads only the shared libraries that it uses: the tests start in milliseconds.
target_link_options(surefoot_compiler INTERFACE -Wl,--as-needed)

# ccache is shared by all build folders: sources are named relative to the source tree's place, and
# the build folder's own name does not count.
find_program(CCACHE ccache)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
      CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=true ${CCACHE})
endif()

# With CMAKE_UNITY_BUILD, as the launchers build, eight files of a folder are compiled as one where reading headers takes
# most of the time. Where Eigen's expressions do, that would save nothing.
set(SUREFOOT_ALONE model solver estimation tasks gaits control)
# Classes of these headers keep types that only their .cpp knows.
set_source_files_properties(${PROJECT_SOURCE_DIR}/surefoot/logging/recorder.cpp ${PROJECT_SOURCE_DIR}/server/log_frames.cpp
  PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
