# What `cmake --install` copies: the programs with templates, manual pages and completions, and the
# geometry model of the array (base, geometry, optics) as the CMake package `telestrain` for other
# programs.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# In the order in which they need each other; telestrain_settings carries flags and include folders.
set(exported_modules base geometry optics)
set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/telestrain")
set(header_folder "${CMAKE_INSTALL_INCLUDEDIR}/telestrain")

install(TARGETS telestrain telestrain-view RUNTIME COMPONENT program)
install(DIRECTORY templates DESTINATION "${CMAKE_INSTALL_DATADIR}/telestrain" COMPONENT program)
install(DIRECTORY "${TELESTRAIN_PAGES}/man1" DESTINATION "${CMAKE_INSTALL_MANDIR}"
  COMPONENT program)
foreach(completions bash:bash-completion/completions zsh:zsh/vendor-completions
    fish:fish/vendor_completions.d)
  string(REPLACE ":" ";" completions "${completions}")
  list(GET completions 0 shell)
  list(GET completions 1 folder)
  install(DIRECTORY "${TELESTRAIN_PAGES}/completions/${shell}/"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/${folder}" COMPONENT program)
endforeach()
# The documents keep their places below each other, as they link to each other.
file(GLOB documents CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}"
  README.md "src/*/*.md" src/app/pages/*.md "report/*.md")
foreach(document IN LISTS documents)
  cmake_path(GET document PARENT_PATH folder)
  install(FILES "${document}" DESTINATION "${CMAKE_INSTALL_DOCDIR}/${folder}" COMPONENT program)
endforeach()
install(DIRECTORY data/readme DESTINATION "${CMAKE_INSTALL_DOCDIR}/data" COMPONENT program)
install(FILES CHANGELOG.md src/cmake/debian/copyright DESTINATION "${CMAKE_INSTALL_DOCDIR}"
  COMPONENT program)
install(FILES src/cmake/debian/telestrain-view.desktop
  DESTINATION "${CMAKE_INSTALL_DATADIR}/applications" COMPONENT program)
install(FILES src/cmake/debian/telestrain.svg
  DESTINATION "${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps" COMPONENT program)

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
