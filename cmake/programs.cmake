# The program: cli/main.cpp, and the rest of cli/ and the viewer's server/ as libraries that the tests can link.

list(TRANSFORM SUREFOOT_FOLDERS PREPEND surefoot:: OUTPUT_VARIABLE SUREFOOT_LIBRARIES)

foreach(folder server cli)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.cpp)
  list(REMOVE_ITEM sources ${PROJECT_SOURCE_DIR}/cli/main.cpp)
  if(sources)
    add_library(surefoot_${folder} STATIC ${sources})
    target_link_libraries(surefoot_${folder} PUBLIC ${SUREFOOT_LIBRARIES} nlohmann_json::nlohmann_json Threads::Threads
                          PRIVATE surefoot_compiler)
    list(APPEND SUREFOOT_LIBRARIES surefoot_${folder})
  endif()
endforeach()

if(TARGET surefoot_cli)
  target_link_libraries(surefoot_server PRIVATE surefoot_boost)
  # Boost's errors name its files; the program names no folder of the machine that built it.
  target_compile_options(surefoot_server PRIVATE -ffile-prefix-map=${SUREFOOT_CMEEL_PREFIX}/include/=)
  target_link_libraries(surefoot_cli PUBLIC CLI11::CLI11)
  add_executable(surefoot cli/main.cpp)
  target_link_libraries(surefoot PRIVATE surefoot_compiler ${SUREFOOT_LIBRARIES})
  set_target_properties(surefoot PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
endif()
