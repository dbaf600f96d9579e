#pragma once
// The parameters of a run in the metadata of its log: "parameters": {"tool": "D6R3", "wear": "0.05 mm"}.

#include <string>
#include <vector>

#include "history/run_record.h"
#include "io/formats/log_format.h"

namespace clsurf::io {

/// The metadata with these parameters set, others kept. `metadata`: a JSON object or empty.
[[nodiscard]] std::string with_parameters(const std::string& metadata, const std::vector<RunParameter>& parameters);

/// Those of the metadata, numbers as texts, in the order of their names; what is neither text nor number is left out.
[[nodiscard]] std::vector<RunParameter> parameters_of_metadata(const std::string& metadata);

/// The same of a log, which is opened only if its format can name some. Throws InputError.
[[nodiscard]] std::vector<RunParameter> parameters_of_log(const std::string& path, const LogOptions& options);

/// "tool=D6R3, wear=0.05 mm".
[[nodiscard]] std::string list_of(const std::vector<RunParameter>& parameters);

}  // namespace clsurf::io
