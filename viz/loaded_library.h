#pragma once
// Large libraries that few commands need are linked to separate shared libraries next to the program, which are loaded
// on first use: all other commands start without them. Each provides a table of functions.

#include <string>

#include "core/error.h"

namespace clsurf::viz {

/// Calls the function `entry` of the library `file` and returns its result; nullptr: it cannot be loaded.
[[nodiscard]] const void* load_table(const char* file, const char* entry);

/// The same as a struct of function pointers. Throws SystemError.
template <typename Table>
[[nodiscard]] const Table& loaded_table(const char* file, const char* entry) {
    const void* table = load_table(file, entry);
    if (table == nullptr)
        throw SystemError(std::string(file) + " cannot be loaded: the installation of clsurf is incomplete");
    return *static_cast<const Table*>(table);
}

}  // namespace clsurf::viz
