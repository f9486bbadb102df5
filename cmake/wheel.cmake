# What a Python wheel has of the build (pyproject.toml): program, module and data, all inside the package surefoot. They find
# the libraries of the packages that pip puts beside it relative to themselves.

function(surefoot_in_wheel target folder site)
  set_target_properties(${target} PROPERTIES
    INSTALL_RPATH "${site}/cmeel.prefix/lib;${site}/cmeel.prefix/lib64;${site}/mujoco;${site}/surefoot/lib")
  install(TARGETS ${target} RUNTIME DESTINATION ${folder} COMPONENT wheel LIBRARY DESTINATION ${folder} COMPONENT wheel)
endfunction()

surefoot_in_wheel(surefoot bin "$ORIGIN/../..")
surefoot_in_wheel(surefoot_python . "$ORIGIN/..")
# What no other package brings.
foreach(target yaml-cpp::yaml-cpp zstd::libzstd_shared)
  install(FILES $<TARGET_FILE:${target}> RENAME $<TARGET_SONAME_FILE_NAME:${target}> DESTINATION lib COMPONENT wheel)
endforeach()
install(FILES ${PROJECT_BINARY_DIR}/python/surefoot/_core.pyi ${PROJECT_BINARY_DIR}/python/surefoot/tasks.py DESTINATION . COMPONENT wheel)
install(DIRECTORY robots stacks gaits scenarios randomisations campaigns DESTINATION share/surefoot COMPONENT wheel)
