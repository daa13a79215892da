# Writes OUTPUT, a C++ header in NAMESPACE with the text of the files NAMES (separated by '|') below FOLDER.
# Long texts are cut into adjacent literals, because compilers need only accept 65536 characters in one.
string(REPLACE "|" ";" names "${NAMES}")
set(entries "")
foreach(name ${names})
  file(READ "${FOLDER}/${name}" text)
  string(LENGTH "${text}" length)
  set(literals "")
  set(offset 0)
  while(offset LESS length)
    string(SUBSTRING "${text}" ${offset} 12000 piece)
    string(APPEND literals "R\"elvis_text(${piece})elvis_text\"\n")
    math(EXPR offset "${offset} + 12000")
  endwhile()
  if(literals STREQUAL "")
    set(literals "\"\"")
  endif()
  string(APPEND entries "    {\"${name}\", ${literals}},\n")
endforeach()
file(WRITE "${OUTPUT}"
     "#pragma once\nnamespace ${NAMESPACE} {\nstruct Text {\n    const char* name;\n    const char* text;\n};\n"
     "inline constexpr Text files[] = {\n${entries}};\n} // namespace ${NAMESPACE}\n")
