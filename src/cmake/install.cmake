# What `cmake --install` copies: the programs with their templates, and the geometry model of the array
# (base, geometry, optics) as the CMake package `telestrain` for other programs.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# In the order in which they need each other; telestrain_settings carries flags and include folders.
set(exported_modules base geometry optics)
set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/telestrain")
set(header_folder "${CMAKE_INSTALL_INCLUDEDIR}/telestrain")

if(TARGET telestrain)
  install(TARGETS telestrain RUNTIME COMPONENT program)
  install(DIRECTORY templates DESTINATION "${CMAKE_INSTALL_DATADIR}/telestrain" COMPONENT program
    OPTIONAL)
endif()
if(TARGET telestrain-view)
  install(TARGETS telestrain-view RUNTIME COMPONENT program)
endif()

target_include_directories(telestrain_settings INTERFACE "$<INSTALL_INTERFACE:${header_folder}>")
set_target_properties(telestrain_settings PROPERTIES EXPORT_NAME settings)
install(TARGETS telestrain_settings EXPORT telestrain_targets)
foreach(module IN LISTS exported_modules)
  set_target_properties(telestrain_${module} PROPERTIES EXPORT_NAME ${module})
  install(TARGETS telestrain_${module} EXPORT telestrain_targets
    ARCHIVE COMPONENT development)
  install(DIRECTORY src/${module} DESTINATION "${header_folder}" COMPONENT development
    FILES_MATCHING PATTERN "*.h")
endforeach()
install(EXPORT telestrain_targets NAMESPACE telestrain:: DESTINATION "${package_folder}"
  COMPONENT development)

configure_package_config_file(src/cmake/telestrainConfig.cmake.in telestrainConfig.cmake
  INSTALL_DESTINATION "${package_folder}")
write_basic_package_version_file(telestrainConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/telestrainConfig.cmake"
  "${PROJECT_BINARY_DIR}/telestrainConfigVersion.cmake"
  DESTINATION "${package_folder}" COMPONENT development)
