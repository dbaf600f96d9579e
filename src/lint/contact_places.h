#pragma once
// Where on the part the findings of lint are: the contact points of the tool there.

#include "lint/lint.h"
#include "machined/tool.h"

namespace clsurf {

/// Adds the contact points to the places of a report on `programmed`. Nothing is added if the program turns the tool.
/// O(findings), parallel.
void add_contacts(LintReport& report, const Program& program, const ProgrammedSurface& programmed,
                  const CuttingTool& tool);

}  // namespace clsurf
