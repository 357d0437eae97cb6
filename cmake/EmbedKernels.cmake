# Embeds text files into a C++ table. Included, it defines macula_embed_kernels(); run as a script
# (cmake -P) with OUTPUT, ROOT and LIST it writes the table, so that a changed kernel costs one
# small compilation.

function(macula_embed_kernels)
  cmake_parse_arguments(arg "" "OUTPUT;ROOT" "FILES" ${ARGN})
  # The list travels in a file: its change (a kernel added or removed) makes the table anew.
  list(SORT arg_FILES)
  list(JOIN arg_FILES "\n" lines)
  file(CONFIGURE OUTPUT ${arg_OUTPUT}.list CONTENT "${lines}" @ONLY)
  add_custom_command(
    OUTPUT ${arg_OUTPUT}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${arg_OUTPUT} -DROOT=${arg_ROOT}
            -DLIST=${arg_OUTPUT}.list -P ${CMAKE_CURRENT_FUNCTION_LIST_FILE}
    DEPENDS ${arg_FILES} ${arg_OUTPUT}.list ${CMAKE_CURRENT_FUNCTION_LIST_FILE}
    COMMENT "Embedding kernels" VERBATIM)
endfunction()

if(NOT CMAKE_SCRIPT_MODE_FILE)
  return()
endif()

# The delimiter of the raw string literals; no kernel may contain it.
set(delimiter "MACULA_KERNEL")
file(STRINGS ${LIST} files)
set(code "// Written by cmake/EmbedKernels.cmake.\n#include \"host/kernel/embedded.hpp\"\n\n")
string(APPEND code "namespace macula::kernel {\nnamespace {\n\n")
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
string(APPEND code "} // namespace macula::kernel\n")
file(WRITE ${OUTPUT} "${code}")
