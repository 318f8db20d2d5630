# Run by cpack on the installed files before they are packed: what Debian's policy wants beyond
# `cmake --install`, and one time for all files. Of the variables only those that
# begin with CPACK_ are known here.
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

set(packages program:telestrain development:libtelestrain-dev)
foreach(package IN LISTS packages)
  string(REGEX REPLACE ":.*" "" component "${package}")
  string(REGEX REPLACE ".*:" "" package "${package}")
  set(root "${CPACK_TEMPORARY_DIRECTORY}/${component}")
  if(NOT IS_DIRECTORY "${root}/usr")
    message(FATAL_ERROR "cpack installed no ${component} into ${root}")
  endif()
  set(documents "${root}/usr/share/doc/${package}")
  set(sources "${CMAKE_CURRENT_LIST_DIR}/../../..")
  file(COPY "${CPACK_TELESTRAIN_BUILD}/debian/${package}/changelog" DESTINATION "${documents}")
  file(RENAME "${documents}/changelog" "${documents}/changelog.Debian")
  file(COPY "${sources}/CHANGELOG.md" "${CMAKE_CURRENT_LIST_DIR}/copyright"
    DESTINATION "${documents}")
  file(RENAME "${documents}/CHANGELOG.md" "${documents}/changelog")
  if(EXISTS "${CMAKE_CURRENT_LIST_DIR}/${package}.lintian-overrides")
    file(COPY "${CMAKE_CURRENT_LIST_DIR}/${package}.lintian-overrides"
      DESTINATION "${root}/usr/share/lintian/overrides")
    file(RENAME "${root}/usr/share/lintian/overrides/${package}.lintian-overrides"
      "${root}/usr/share/lintian/overrides/${package}")
  endif()
  file(GLOB texts "${documents}/changelog*" "${root}/usr/share/man/man1/*.1")
  foreach(text IN LISTS texts)
    run(gzip -9 --no-name --force "${text}")
  endforeach()
  file(GLOB archives "${root}/usr/lib/*.a")
  foreach(archive IN LISTS archives)
    run(strip --strip-debug --remove-section=.comment --remove-section=.note
      --enable-deterministic-archives "${archive}")
  endforeach()
  # Whatever the umask and the owner of the build.
  run(chmod -R u=rwX,go=rX "${root}")
  run(find "${root}" -exec touch --no-dereference "--date=@$ENV{SOURCE_DATE_EPOCH}" "{}" +)
endforeach()
