# cmake -D source=… -D header=… -P commit.cmake
# Writes the source tree's commit into a header; the header stays untouched while the commit is the same. A tree that
# is no git checkout of its own has none.
cmake_minimum_required(VERSION 3.25)
cmake_path(GET source PARENT_PATH parent)
execute_process(COMMAND ${CMAKE_COMMAND} -E env GIT_CEILING_DIRECTORIES=${parent}
                        git -C ${source} describe --always --dirty --abbrev=12 --exclude=*
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(commit "")
endif()
file(CONFIGURE OUTPUT ${header} CONTENT "#define SUREFOOT_COMMIT \"@commit@\"\n" @ONLY)
