#pragma once
// The tool and the machine in a log's metadata: {"tool": "ball:6"}, in the notation of machined/tool.h.

#include <string>

namespace clsurf::io {

/// Empty: no tool is given.
[[nodiscard]] std::string tool_of_metadata(const std::string& metadata);

/// The machine: {"machine": "mill 3"}, or that of a simulation. Empty: no machine is given.
[[nodiscard]] std::string machine_of_metadata(const std::string& metadata);

}  // namespace clsurf::io
