#pragma once
// The options of `plot`.

#include <optional>
#include <string>
#include <vector>

#include "cli/options/part.h"
#include "viz/chart.h"

namespace clsurf::cli {

struct PlotOptions {
    PartOptions part;
    std::string output;
    std::vector<std::string> fields;
    bool over_length = false;
    std::optional<double> from, to;  ///< [s], or [mm] for curves over length
    std::optional<LineNumber> line;
    std::vector<PointIndex> points;
    std::optional<long long> defect;  ///< draws its card instead of curves
    viz::ChartLook look;
};

void declare_plot(po::options_description& options);
/// Throws UsageError.
[[nodiscard]] PlotOptions read_plot_options(const po::variables_map& values);

}  // namespace clsurf::cli
