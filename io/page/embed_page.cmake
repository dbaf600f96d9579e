# Writes OUTPUT, the C++ source of the functions in page_bundle.h, from SCRIPT and STYLE. String literals are split
# at 16,000 bytes, which any compiler accepts.
cmake_policy(VERSION 3.25)
function(literal_of file variable)
  file(READ ${file} hex HEX)  # as HEX: a script contains the separators of CMake lists
  string(LENGTH "${hex}" length)
  set(text "")
  set(at 0)
  while(at LESS length)
    string(SUBSTRING "${hex}" ${at} 32000 part)
    string(REGEX REPLACE "(..)" "\\\\x\\1" part "${part}")
    string(APPEND text "    \"${part}\"\n")
    math(EXPR at "${at} + 32000")
  endwhile()
  set(${variable} "${text}" PARENT_SCOPE)
  math(EXPR size "${length} / 2")
  set(${variable}_size ${size} PARENT_SCOPE)
endfunction()
literal_of(${SCRIPT} script)
literal_of(${STYLE} style)
file(WRITE ${OUTPUT} "// Written by io/page/embed_page.cmake from viz/page/dist.\n#include \"io/page/page_bundle.h\"\n\nnamespace clsurf::io {\n
std::string_view page_script() {\n    static constexpr char text[] =\n${script};\n    return {text, ${script_size}};\n}\n
std::string_view page_style() {\n    static constexpr char text[] =\n${style};\n    return {text, ${style_size}};\n}\n\n}  // namespace clsurf::io\n")
