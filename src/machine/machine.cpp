#include "machine/machine.h"

namespace clsurf {

std::string_view name_of(CornerMode mode) { return mode == CornerMode::arc ? "arc" : "stop"; }

}  // namespace clsurf
