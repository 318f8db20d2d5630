# Writes OUTPUT, a C++ source that defines BuiltInFiles() with the name and text of every .json file
# below ROOT. Run with: cmake -DROOT=… -DOUTPUT=… -P embed_text.cmake
# The delimiter does not occur in the texts.
file(GLOB_RECURSE names RELATIVE "${ROOT}" "${ROOT}/*.json")
list(SORT names)
file(WRITE "${OUTPUT}" "#include \"report/built_in_files.h\"\n\nnamespace telestrain {\n\
namespace {\n\nconstexpr BuiltInFile kFiles[] = {\n")
foreach(name IN LISTS names)
  file(READ "${ROOT}/${name}" text)
  string(FIND "${text}" ")telestrain\"" clash)
  if(NOT clash EQUAL -1)
    message(FATAL_ERROR "${name} holds the delimiter of the literal")
  endif()
  file(APPEND "${OUTPUT}" "    {\"${name}\", R\"telestrain(")
  file(APPEND "${OUTPUT}" "${text}")
  file(APPEND "${OUTPUT}" ")telestrain\"},\n")
endforeach()
file(APPEND "${OUTPUT}" "};\n\n}  // namespace\n\n\
std::span<const BuiltInFile> BuiltInFiles() { return kFiles; }\n\n}  // namespace telestrain\n")
