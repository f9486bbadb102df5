# The program: app/main.cpp, and the rest of app/ as a library that the tests can link.

file(GLOB app_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/app/*.cpp)
list(REMOVE_ITEM app_sources ${PROJECT_SOURCE_DIR}/app/main.cpp)
list(TRANSFORM SUREFOOT_FOLDERS PREPEND surefoot:: OUTPUT_VARIABLE SUREFOOT_LIBRARIES)

if(app_sources)
  add_library(surefoot_app STATIC ${app_sources})
  target_link_libraries(surefoot_app
    PUBLIC ${SUREFOOT_LIBRARIES} CLI11::CLI11 nlohmann_json::nlohmann_json Threads::Threads
    PRIVATE surefoot_compiler)
  list(APPEND SUREFOOT_LIBRARIES surefoot_app)
endif()

if(EXISTS ${PROJECT_SOURCE_DIR}/app/main.cpp)
  add_executable(surefoot app/main.cpp)
  target_link_libraries(surefoot PRIVATE surefoot_compiler ${SUREFOOT_LIBRARIES} CLI11::CLI11)
  set_target_properties(surefoot PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/app)
endif()
