# Writes OUTPUT, the definition of source_commit() (cli/version_text.h), from git, or from commit.txt as written by
# `git archive`. OUTPUT is only touched if it changes.
cmake_policy(VERSION 3.25)
set(commit unknown)
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/commit.txt archived LIMIT_COUNT 1)
if(archived MATCHES "^[0-9a-f]+$")
  string(SUBSTRING ${archived} 0 12 commit)
elseif(EXISTS ${SOURCE}/.git)  # not the repository of another project around an unpacked archive
  execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12 --exclude=*
    OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE code)
  if(code EQUAL 0)
    set(commit ${described})
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT
"#include \"cli/version_text.h\"

namespace clsurf::cli {

const char* source_commit() { return \"@commit@\"; }

}  // namespace clsurf::cli
" @ONLY)
