#pragma once
// The result of a log that cannot be used, where `check` judges several: its error, in each form of a report.

#include <string>

#include "core/diagnostic.h"

namespace clsurf::io {

struct UnusableLog {
    std::string program, log;  ///< their names
    Diagnostic error;
};

[[nodiscard]] std::string unusable_text(const UnusableLog& log);
/// "error" in the place of "defects", so that no script takes it for a log without any.
[[nodiscard]] std::string unusable_json(const UnusableLog& log);
/// A row with the cause "error".
[[nodiscard]] std::string unusable_csv(const UnusableLog& log);
/// A run that was not successful, with a result on the program.
[[nodiscard]] std::string unusable_sarif(const UnusableLog& log);
/// The case of the verdict, with an error.
[[nodiscard]] std::string unusable_junit(const UnusableLog& log);

}  // namespace clsurf::io
