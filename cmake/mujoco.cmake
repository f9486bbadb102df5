# MuJoCo's wheel brings the library and its headers but no CMake package.

if(NOT TARGET mujoco::mujoco)
  file(GLOB mujoco_library ${SUREFOOT_MUJOCO_PREFIX}/libmujoco.so.*)
  if(NOT mujoco_library)
    message(FATAL_ERROR "There is no libmujoco.so in ${SUREFOOT_MUJOCO_PREFIX}.")
  endif()
  add_library(mujoco::mujoco SHARED IMPORTED GLOBAL)
  set_target_properties(mujoco::mujoco PROPERTIES
    IMPORTED_LOCATION ${mujoco_library}
    INTERFACE_INCLUDE_DIRECTORIES ${SUREFOOT_MUJOCO_PREFIX}/include)
endif()
