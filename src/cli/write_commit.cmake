# Writes OUTPUT, the definition of source_commit() (cli/version_text.h): asked from git, else from commit.txt, where
# `git archive` has put it. OUTPUT is only touched where the answer is a new one.
cmake_policy(VERSION 3.25)
set(commit unknown)
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/commit.txt archived LIMIT_COUNT 1)
if(archived MATCHES "^[0-9a-f]+$")
  string(SUBSTRING ${archived} 0 12 commit)
elseif(EXISTS ${SOURCE}/.git)  # another project's repository around an unpacked archive does not count
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
