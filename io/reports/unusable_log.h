#pragma once
// The result for a log that cannot be used, if `check` judges several: its error, in each report format.

#include <string>

#include "core/diagnostic.h"

namespace clsurf::io {

struct UnusableLog {
    std::string program, log;  ///< their names
    Diagnostic error;
};

[[nodiscard]] std::string unusable_text(const UnusableLog& log);
/// "error" in place of "defects", so that no script mistakes it for a log without defects.
[[nodiscard]] std::string unusable_json(const UnusableLog& log);
/// A row with the cause "error".
[[nodiscard]] std::string unusable_csv(const UnusableLog& log);
/// An unsuccessful run, with a result at the program.
[[nodiscard]] std::string unusable_sarif(const UnusableLog& log);
/// The case of the verdict, with an error.
[[nodiscard]] std::string unusable_junit(const UnusableLog& log);

}  // namespace clsurf::io
