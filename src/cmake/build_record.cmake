# cmake -DSOURCE=… -DOUTPUT=build_record.cpp -DGIT=… -DBUILD_TYPE=… -DCOMPILER=… -DFLAGS=… -P this
# Writes how the program is built. In a source archive (git archive) the revision stands in
# source_revision.txt. The file is touched only when it differs.
set(revision unknown)
file(STRINGS "${SOURCE}/src/cmake/source_revision.txt" archived LIMIT_COUNT 1)
if(archived MATCHES "^[0-9a-f]+$")
  string(SUBSTRING "${archived}" 0 12 revision)
elseif(GIT AND EXISTS "${SOURCE}/.git")
  execute_process(COMMAND "${GIT}" describe --always --dirty --abbrev=12
    WORKING_DIRECTORY "${SOURCE}" OUTPUT_VARIABLE described RESULT_VARIABLE failed
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT failed)
    set(revision "${described}")
  endif()
endif()
configure_file("${SOURCE}/src/app/build_record.cpp.in" "${OUTPUT}" @ONLY ESCAPE_QUOTES)
