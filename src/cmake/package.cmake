# `cpack` in the build folder makes two Debian packages in build/…/packages: telestrain (programs,
# manual, completions) and libtelestrain-dev (the CMake package). The same build gives the same bytes;
# SOURCE_DATE_EPOCH is the day of the version unless it is set.
set(TELESTRAIN_MAINTAINER "telestrain maintainers <maintainers@telestrain.invalid>" CACHE STRING
  "Maintainer of the Debian packages, with an address of whoever builds them")
execute_process(COMMAND date --utc "--date=${TELESTRAIN_DATE}" "+%s"
  OUTPUT_VARIABLE package_epoch_s OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND date --utc --rfc-email "--date=${TELESTRAIN_DATE}"
  OUTPUT_VARIABLE package_day OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)

# Else cpack builds all tests first. Who packs has built.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME telestrain)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # it would stand before the summary of each package
set(CPACK_PACKAGE_CONTACT "${TELESTRAIN_MAINTAINER}")
set(CPACK_PACKAGE_DIRECTORY "${PROJECT_BINARY_DIR}/packages")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_STRIP_FILES ON)
set(CPACK_TELESTRAIN_BUILD "${PROJECT_BINARY_DIR}")
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_PROJECT_CONFIG_FILE "${PROJECT_BINARY_DIR}/package_day.cmake")
set(CPACK_PRE_BUILD_SCRIPTS "${PROJECT_SOURCE_DIR}/src/cmake/debian/finish.cmake")
configure_file(src/cmake/debian/package_day.cmake.in package_day.cmake @ONLY)
foreach(package telestrain libtelestrain-dev)
  configure_file(src/cmake/debian/changelog.in "debian/${package}/changelog" @ONLY)
endforeach()

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME telestrain)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# Files that the program opens: fonts of report and pictures, colour profile of the report.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS
  "fonts-liberation2 | fonts-liberation, fonts-dejavu-core, icc-profiles-free")
# What it loads when it is asked for: OpenCV's codecs (images that are neither PNG nor JPEG), its videos,
# OpenGL by EGL (`render --backend egl`), the font of Chinese reports. Debian calls OpenCV 4.6 "406".
string(REGEX REPLACE "^([0-9]+)\\.([0-9])\\..*" "\\1.0\\2." opencv_abi "${OpenCV_VERSION}")
string(REGEX REPLACE "^([0-9]+)\\.([0-9]+)\\..*" "\\1\\2" opencv_abi "${opencv_abi}")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libopencv-imgcodecs${opencv_abi}, \
libopencv-videoio${opencv_abi}, libegl1, libgl1-mesa-dri, fonts-wqy-zenhei")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
"strain of pipes by a telecentric four-view camera
From images of a camera that sees a pipe in four telecentric views, telestrain
calibrates the views, proves them on a ruler, measures the strain of the pipe
in every state and writes a PDF acceptance report that can be signed.
telestrain-view shows the results in a window.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libtelestrain-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libeigen3-dev, nlohmann-json3-dev, libssl-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
"geometry of telecentric views and mirrors, for C++
The parts of telestrain that other programs can use: telecentric views, rays
through mirrors, lines, planes and cylinders, as static libraries with their
headers and a CMake package.")
include(CPack)
