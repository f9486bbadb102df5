# An installed tree: libraries and headers for find_package(surefoot), the program and its data.

include(CMakePackageConfigHelpers)

# What needs nothing but Eigen has a list of its own, so that it can be used without the rest.
set(alone_targets surefoot_base surefoot_math surefoot_solver)
list(TRANSFORM SUREFOOT_FOLDERS PREPEND surefoot_ OUTPUT_VARIABLE folder_targets)
list(REMOVE_ITEM folder_targets ${alone_targets})
list(APPEND folder_targets surefoot_all surefoot_count_allocations)
install(TARGETS ${alone_targets} EXPORT surefootSolverTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS ${folder_targets} EXPORT surefootTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
# surefoot/*.hpp and the headers that these reach, found when it installs.
install(CODE "
  execute_process(COMMAND \"${SUREFOOT_PYTHON}\" \"${PROJECT_SOURCE_DIR}/tools/installed_headers.py\"
                  OUTPUT_VARIABLE headers COMMAND_ERROR_IS_FATAL ANY)
  foreach(header IN LISTS headers)
    cmake_path(GET header PARENT_PATH folder)
    file(INSTALL \"${PROJECT_SOURCE_DIR}/\${header}\"
         DESTINATION \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}/\${folder}\")
  endforeach()")
if(TARGET surefoot)
  install(TARGETS surefoot)
endif()
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY robots stacks gaits scenarios randomisations DESTINATION ${CMAKE_INSTALL_DATADIR}/surefoot)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/surefoot)
install(EXPORT surefootSolverTargets NAMESPACE surefoot:: DESTINATION ${package_folder})
install(EXPORT surefootTargets NAMESPACE surefoot:: DESTINATION ${package_folder})
configure_package_config_file(cmake/surefootConfig.cmake.in ${PROJECT_BINARY_DIR}/surefootConfig.cmake
                              INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/surefootConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/surefootConfig.cmake ${PROJECT_BINARY_DIR}/surefootConfigVersion.cmake
              cmake/mujoco.cmake cmake/package_data.cpp.in
        DESTINATION ${package_folder})
