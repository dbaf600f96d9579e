#pragma once
// The parameters of a run in the metadata of its log: "parameters": {"tool": "D6R3", "wear": "0.05 mm"}.

#include <string>
#include <vector>

#include "history/run_record.h"
#include "io/formats/log_format.h"

namespace clsurf::io {

/// The metadata with these parameters set, others kept. `metadata`: a JSON object or empty.
[[nodiscard]] std::string with_parameters(const std::string& metadata, const std::vector<RunParameter>& parameters);

/// The parameters in the metadata, sorted by name, numbers as text. Values that are neither text nor number are left out.
[[nodiscard]] std::vector<RunParameter> parameters_of_metadata(const std::string& metadata);

/// The parameters of a log, which is opened only if its format can have any. Throws InputError.
[[nodiscard]] std::vector<RunParameter> parameters_of_log(const std::string& path, const LogOptions& options);

/// "tool=D6R3, wear=0.05 mm".
[[nodiscard]] std::string list_of(const std::vector<RunParameter>& parameters);

}  // namespace clsurf::io
