# Third-party packages: those of dependencies/python.txt from the virtual environment's prefix,
# those of dependencies/debian.txt from the system.

set(default_python ${PROJECT_SOURCE_DIR}/.venv/bin/python)
if(SKBUILD)  # pip builds a wheel, in an environment of its own
  set(default_python ${Python_EXECUTABLE})
endif()
set(SUREFOOT_PYTHON ${default_python} CACHE FILEPATH "Python of the environment that holds Pinocchio and MuJoCo")
if(NOT EXISTS ${SUREFOOT_PYTHON})
  message(FATAL_ERROR "There is no ${SUREFOOT_PYTHON}: run tools/setup.sh first, or name by -D SUREFOOT_PYTHON=PYTHON an environment that has \
what dependencies/python.txt lists.")
endif()

execute_process(COMMAND ${SUREFOOT_PYTHON} -c "import cmeel, pathlib; print(pathlib.Path(cmeel.__file__).parents[1])"
                OUTPUT_VARIABLE site_packages OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
set(SUREFOOT_CMEEL_PREFIX ${site_packages}/cmeel.prefix)
set(SUREFOOT_MUJOCO_PREFIX ${site_packages}/mujoco)
set(SUREFOOT_ROBOT_PACKAGES ${SUREFOOT_CMEEL_PREFIX}/share)
# An installed program finds these libraries where they lie, as one in the build tree does.
set(CMAKE_INSTALL_RPATH ${SUREFOOT_CMEEL_PREFIX}/lib ${SUREFOOT_CMEEL_PREFIX}/lib64 ${SUREFOOT_MUJOCO_PREFIX})
list(PREPEND CMAKE_PREFIX_PATH ${SUREFOOT_CMEEL_PREFIX} ${SUREFOOT_CMEEL_PREFIX}/lib64)

set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL ON)  # a project that has this one as a subdirectory links them, too
set(Boost_NO_WARN_NEW_VERSIONS ON)  # CMake 3.25 is older than the Boost that Pinocchio brings
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(pinocchio REQUIRED)
find_package(tinyxml2 REQUIRED)
find_package(yaml-cpp REQUIRED)
if(NOT TARGET yaml-cpp::yaml-cpp)  # the name since 0.8; Debian 12 has 0.7
  add_library(yaml-cpp::yaml-cpp ALIAS yaml-cpp)
endif()
find_package(nlohmann_json REQUIRED)
find_package(zstd REQUIRED)
if(SUREFOOT_BUILD_PROGRAM)
  find_package(CLI11 REQUIRED)
endif()
include(mujoco)

# Boost's headers, which come with Pinocchio's packages: Beast and Asio for the viewer's server.
add_library(surefoot_boost INTERFACE)
target_include_directories(surefoot_boost SYSTEM INTERFACE ${SUREFOOT_CMEEL_PREFIX}/include)
