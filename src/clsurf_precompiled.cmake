# Without precompiled headers, parsing the same large headers took most of the build time. Rooms share one set of
# them; the command line and the tests have their own. Files still include what they use:
# tests/separate compiles each without them.
#
# clsurf_precompiled(TARGET [FROM target] [headers…])
function(clsurf_precompiled target)
  cmake_parse_arguments(PARSE_ARGV 1 PCH "" "FROM" "")
  if(PCH_FROM)
    target_precompile_headers(${target} REUSE_FROM ${PCH_FROM})
  else()
    target_precompile_headers(${target} PRIVATE
      <algorithm> <array> <cmath> <functional> <limits> <optional> <span> <string> <vector>
      <Eigen/Core> <Eigen/Geometry> <fmt/format.h> ${PCH_UNPARSED_ARGUMENTS})
  endif()
endfunction()
