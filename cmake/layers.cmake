# One library for each folder of surefoot/, linked as tools/layers.toml allows.

set(layers_file ${PROJECT_SOURCE_DIR}/tools/layers.toml)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${layers_file})

# Third-party libraries stay inside the folder that uses them: no public header shows their types.
set(third_party_model pinocchio::pinocchio_default pinocchio::pinocchio_parsers tinyxml2::tinyxml2)
set(third_party_simulation mujoco::mujoco)
set(third_party_config yaml-cpp::yaml-cpp $<BUILD_INTERFACE:nlohmann_json::nlohmann_json> tinyxml2::tinyxml2)
set(third_party_logging $<BUILD_INTERFACE:nlohmann_json::nlohmann_json> zstd::libzstd_shared)
set(third_party_runtime Threads::Threads)
set(third_party_explain $<BUILD_INTERFACE:nlohmann_json::nlohmann_json>)
set(third_party_replay $<BUILD_INTERFACE:nlohmann_json::nlohmann_json>)
set(third_party_closed_loop $<BUILD_INTERFACE:nlohmann_json::nlohmann_json>)

function(surefoot_folder folder allowed)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/surefoot/${folder}/*.cpp)
  set(visibility PUBLIC)
  if(sources)
    add_library(surefoot_${folder} STATIC ${sources})
    if(folder IN_LIST SUREFOOT_ALONE)
      set_target_properties(surefoot_${folder} PROPERTIES UNITY_BUILD OFF)
    endif()
    target_link_libraries(surefoot_${folder} PRIVATE $<BUILD_INTERFACE:surefoot_compiler>
                          ${third_party_${folder}})
  else()
    add_library(surefoot_${folder} INTERFACE)
    set(visibility INTERFACE)
  endif()
  target_compile_features(surefoot_${folder} ${visibility} cxx_std_20)
  target_include_directories(surefoot_${folder} ${visibility}
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  list(TRANSFORM allowed PREPEND surefoot_)
  target_link_libraries(surefoot_${folder} ${visibility} Eigen3::Eigen ${allowed})
  set_target_properties(surefoot_${folder} PROPERTIES EXPORT_NAME ${folder})
  add_library(surefoot::${folder} ALIAS surefoot_${folder})
endfunction()

set(SUREFOOT_FOLDERS)
file(STRINGS ${layers_file} lines)
foreach(line IN LISTS lines)
  if(line MATCHES "^\\[fences\\]")
    break()
  elseif(line MATCHES "^([a-z_]+) = \\[(.*)\\]$")
    set(folder ${CMAKE_MATCH_1})
    string(REGEX MATCHALL "[a-z_]+" allowed "${CMAKE_MATCH_2}")
    surefoot_folder(${folder} "${allowed}")
    list(APPEND SUREFOOT_FOLDERS ${folder})
  endif()
endforeach()

# All of them, for a user's program: surefoot::surefoot. The program owns the plain name.
list(TRANSFORM SUREFOOT_FOLDERS PREPEND surefoot_ OUTPUT_VARIABLE folder_targets)
add_library(surefoot_all INTERFACE)
target_link_libraries(surefoot_all INTERFACE ${folder_targets})
set_target_properties(surefoot_all PROPERTIES EXPORT_NAME surefoot)
add_library(surefoot::surefoot ALIAS surefoot_all)

# For a user's tests: check_task() counts allocations in a program that links it.
add_library(surefoot_count_allocations STATIC ${PROJECT_SOURCE_DIR}/testing/count_allocations.cpp)
target_link_options(surefoot_count_allocations INTERFACE LINKER:--undefined=surefoot_count_allocations)
set_target_properties(surefoot_count_allocations PROPERTIES EXPORT_NAME count_allocations)
add_library(surefoot::count_allocations ALIAS surefoot_count_allocations)

# The commit is that of the build, not of the configuration: asked each time, written when it is another one.
set(commit_header ${PROJECT_BINARY_DIR}/generated/surefoot_commit.hpp)
add_custom_target(surefoot_commit BYPRODUCTS ${commit_header}
                  COMMAND ${CMAKE_COMMAND} -D source=${PROJECT_SOURCE_DIR} -D header=${commit_header}
                          -P ${PROJECT_SOURCE_DIR}/cmake/commit.cmake
                  COMMENT "")
add_dependencies(surefoot_base surefoot_commit)
set(built_folders "SUREFOOT_SOURCE_DATA=\"${PROJECT_SOURCE_DIR}\";\
SUREFOOT_INSTALLED_DATA=\"${CMAKE_INSTALL_FULL_DATADIR}/surefoot\";\
SUREFOOT_ROBOT_PACKAGES=\"${SUREFOOT_ROBOT_PACKAGES}\"")
if(SKBUILD)
  set(built_folders "SUREFOOT_SOURCE_DATA=\"\";SUREFOOT_INSTALLED_DATA=\"\";SUREFOOT_ROBOT_PACKAGES=\"\"")
endif()
set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS dependencies/robots.txt)
file(STRINGS ${PROJECT_SOURCE_DIR}/dependencies/robots.txt robot_requirements REGEX "^[^#].*==")
list(JOIN robot_requirements " " robot_requirements)
set_source_files_properties(${PROJECT_SOURCE_DIR}/surefoot/base/build_info.cpp PROPERTIES
  INCLUDE_DIRECTORIES ${PROJECT_BINARY_DIR}/generated
  COMPILE_DEFINITIONS "SUREFOOT_VERSION=\"${PROJECT_VERSION}\";${built_folders};SUREFOOT_ROBOT_REQUIREMENTS=\"${robot_requirements}\"")

# Roots without errno, and no calls of memset for a few packs of zeros.
set_source_files_properties(${PROJECT_SOURCE_DIR}/surefoot/solver/sweep_kernels.cpp PROPERTIES
  COMPILE_OPTIONS "-fno-math-errno;$<$<CXX_COMPILER_ID:GNU>:-fno-tree-loop-distribute-patterns>")
