# Writes OUTPUT, a C++ source that defines `const char* const NAME` with the text of INPUT.
# Run with: cmake -DINPUT=… -DOUTPUT=… -DNAME=… -DHEADER=… -P embed_text.cmake
# Compilers limit one literal to 64 KiB, the text is far below; the delimiter does not occur in it.
file(READ "${INPUT}" text)
string(FIND "${text}" ")telestrain\"" clash)
if(NOT clash EQUAL -1)
  message(FATAL_ERROR "${INPUT} holds the delimiter of the literal")
endif()
file(WRITE "${OUTPUT}" "#include \"${HEADER}\"\n\nnamespace telestrain {\n\n\
const char* const ${NAME} = R\"telestrain(")
file(APPEND "${OUTPUT}" "${text}")
file(APPEND "${OUTPUT}" ")telestrain\";\n\n}  // namespace telestrain\n")
