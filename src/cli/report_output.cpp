#include "cli/report_output.h"

#include "cli/options.h"

namespace clsurf::cli {

std::string report_format(const po::variables_map& values) {
    if (values.count("format") > 0) {
        if (values.count("json") > 0) throw UsageError("--json and --format say the same");
        return values["format"].as<std::string>();
    }
    return values.count("json") > 0 ? "json" : "text";
}

ReportOutput::ReportOutput(const po::variables_map& values) {
    if (values.count("output") > 0) file_ = std::make_unique<io::AtomicFile>(values["output"].as<std::string>());
}

void ReportOutput::write(std::string_view text) {
    if (!file_) {
        write_to_stdout(text);
        return;
    }
    file_->write(text);
    file_->commit();
}

}  // namespace clsurf::cli
