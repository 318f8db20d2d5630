# One place for how a module and a test program are built.
include_guard(GLOBAL)

# GCC 12 sees an overlap that is not there in `"text" + std::string` (GCC bug 105651).
add_library(telestrain_warnings INTERFACE)
target_compile_options(telestrain_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor
  -Wno-restrict
  $<$<BOOL:${TELESTRAIN_WERROR}>:-Werror>)

# Contracting a*b+c differs between compilers and CPUs; results must not.
add_library(telestrain_settings INTERFACE)
target_compile_features(telestrain_settings INTERFACE cxx_std_20)
target_compile_options(telestrain_settings INTERFACE -ffp-contract=off)
target_include_directories(telestrain_settings INTERFACE
  "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>" "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>")

# telestrain_module(NAME SOURCES a.cpp … [PUBLIC lib …] [PRIVATE lib …])
# Makes the static library telestrain_NAME with the alias telestrain::NAME.
function(telestrain_module name)
  cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(telestrain_${name} STATIC ${arg_SOURCES})
  add_library(telestrain::${name} ALIAS telestrain_${name})
  target_link_libraries(telestrain_${name}
    PUBLIC telestrain_settings ${arg_PUBLIC}
    PRIVATE $<BUILD_INTERFACE:telestrain_warnings> ${arg_PRIVATE})
endfunction()

# telestrain_alone(a.cpp …)
# Sources that a unity build (CMAKE_UNITY_BUILD in the presets: eight are compiled at a time) takes
# one by one: a name in their unnamed namespace stands in a neighbour as well.
function(telestrain_alone)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

set(TELESTRAIN_TIME_FACTOR 1 CACHE STRING
  "Factor on the time-outs of the tests, for builds that run slowly (sanitizers)")
set(TELESTRAIN_PIN_TESTS OFF CACHE BOOL
  "One processor a test: lines counted on two at once (coverage) take up to 24 times as long")

# Called at the end of a folder of tests that names some by add_test(): the factor for those.
# telestrain_test() has it already.
function(telestrain_lengthen_time_outs)
  get_property(tests DIRECTORY PROPERTY TESTS)
  foreach(test IN LISTS tests)
    get_property(seconds TEST "${test}" PROPERTY TIMEOUT)
    if(seconds)
      math(EXPR seconds "${seconds} * ${TELESTRAIN_TIME_FACTOR}")
      set_property(TEST "${test}" PROPERTY TIMEOUT ${seconds})
    endif()
  endforeach()
endfunction()

# telestrain_test(NAME SOURCES a_test.cpp … LIBRARIES lib … [LABEL label] [TIMEOUT seconds])
# Makes one GoogleTest program whose every test is known to ctest. A test's own code runs once, so
# the compiler's time is saved on it.
function(telestrain_test name)
  cmake_parse_arguments(arg "" "LABEL;TIMEOUT" "SOURCES;LIBRARIES" ${ARGN})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 120)
  endif()
  math(EXPR arg_TIMEOUT "${arg_TIMEOUT} * ${TELESTRAIN_TIME_FACTOR}")
  math(EXPR discovery_seconds "60 * ${TELESTRAIN_TIME_FACTOR}")
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE telestrain_settings telestrain_warnings
    ${arg_LIBRARIES} GTest::gtest GTest::gtest_main)
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  target_compile_definitions(${name} PRIVATE
    TELESTRAIN_SOURCE_DIR="${PROJECT_SOURCE_DIR}" TELESTRAIN_BINARY_DIR="${PROJECT_BINARY_DIR}")
  include(GoogleTest)
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT ${discovery_seconds}
    PROPERTIES TIMEOUT ${arg_TIMEOUT} LABELS "${arg_LABEL}"
               PROCESSOR_AFFINITY ${TELESTRAIN_PIN_TESTS})
endfunction()
