#pragma once
// The exceptions that end a run, and the exit codes that cli/main.cpp (the only catch) makes of them.

#include <stdexcept>
#include <string>

#include "core/diagnostic.h"

namespace clsurf {

enum class ExitCode : int {
    done = 0,          ///< done, within budget
    check_failed = 1,  ///< done, but a check or a comparison failed
    usage = 2,         ///< wrong options or arguments
    bad_input = 3,     ///< a file that cannot be used
    system = 4,        ///< system failure: disk, memory, graphics
    not_judged = 5,    ///< done, but the data do not allow a verdict
};

/// An input that cannot be used. The diagnostic says where, what was found and what was expected.
class InputError : public std::runtime_error {
public:
    explicit InputError(Diagnostic diagnostic);
    InputError(Place where, std::string what, std::string hint = {});
    [[nodiscard]] const Diagnostic& diagnostic() const { return diagnostic_; }

private:
    Diagnostic diagnostic_;
};

/// Options or arguments that make no sense.
class UsageError : public std::runtime_error {
public:
    explicit UsageError(const std::string& what, std::string hint = {})
        : std::runtime_error(what), hint_(std::move(hint)) {}
    [[nodiscard]] const std::string& hint() const { return hint_; }

private:
    std::string hint_;
};

/// A system failure: disk full, not writable, no graphics context.
class SystemError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

}  // namespace clsurf
