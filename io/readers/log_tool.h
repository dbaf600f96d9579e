#pragma once
// The tool and the machine that a log's metadata name: {"tool": "ball:6"}, in the words of machined/tool.h.

#include <string>

namespace clsurf::io {

/// Empty: they name none.
[[nodiscard]] std::string tool_of_metadata(const std::string& metadata);

/// The machine that they name: {"machine": "mill 3"}, or that of a simulation. Empty: they name none.
[[nodiscard]] std::string machine_of_metadata(const std::string& metadata);

}  // namespace clsurf::io
