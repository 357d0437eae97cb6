# Embeds text files into a C++ table. Included, it defines macula_embed_files(); run as a script
# (cmake -P) with OUTPUT, ROOT, NAMESPACE, HEADER and LIST it writes the table, so that a changed
# file costs one small compilation. HEADER declares, in NAMESPACE, what the table is made of:
# struct EmbeddedFile { std::string_view path, text; }; std::span<const EmbeddedFile> embedded_files();

function(macula_embed_files)
  cmake_parse_arguments(arg "" "OUTPUT;ROOT;NAMESPACE;HEADER" "FILES" ${ARGN})
  # The list travels in a file: its change (a file added or removed) makes the table anew.
  list(SORT arg_FILES)
  list(JOIN arg_FILES "\n" lines)
  file(CONFIGURE OUTPUT ${arg_OUTPUT}.list CONTENT "${lines}" @ONLY)
  add_custom_command(
    OUTPUT ${arg_OUTPUT}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${arg_OUTPUT} -DROOT=${arg_ROOT}
            -DNAMESPACE=${arg_NAMESPACE} -DHEADER=${arg_HEADER}
            -DLIST=${arg_OUTPUT}.list -P ${CMAKE_CURRENT_FUNCTION_LIST_FILE}
    DEPENDS ${arg_FILES} ${arg_OUTPUT}.list ${CMAKE_CURRENT_FUNCTION_LIST_FILE}
    COMMENT "Embedding files into ${arg_NAMESPACE}" VERBATIM)
endfunction()

if(NOT CMAKE_SCRIPT_MODE_FILE)
  return()
endif()

# The delimiter of the raw string literals; no file may contain it.
set(delimiter "MACULA_FILE")
file(STRINGS ${LIST} files)
set(code "// Written by cmake/EmbedFiles.cmake.\n#include \"${HEADER}\"\n\n")
string(APPEND code "namespace ${NAMESPACE} {\nnamespace {\n\n")
string(APPEND code "constexpr EmbeddedFile kFiles[] = {\n")
foreach(path IN LISTS files)
  file(RELATIVE_PATH name ${ROOT} ${path})
  file(READ ${path} text)
  string(FIND "${text}" ")${delimiter}\"" found)
  if(NOT found EQUAL -1)
    message(FATAL_ERROR "${path} contains )${delimiter}\", which ends its embedding")
  endif()
  string(APPEND code "    {\"${name}\", R\"${delimiter}(${text})${delimiter}\"},\n")
endforeach()
string(APPEND code "};\n\n} // namespace\n\n")
string(APPEND code "std::span<const EmbeddedFile> embedded_files() { return kFiles; }\n\n")
string(APPEND code "} // namespace ${NAMESPACE}\n")
file(WRITE ${OUTPUT} "${code}")
