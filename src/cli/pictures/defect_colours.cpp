#include "cli/pictures/defect_colours.h"

#include "pipeline/feed_fields.h"
#include "viz/field_colours.h"

namespace clsurf::cli {

std::vector<double> colour_differences(const QualityReport& report, const Part& part) {
    std::vector<double> differences;
    for (const SpeedShares& shares : speed_shares(report, part))
        differences.push_back(viz::colour_difference_of(feed_share_info(), shares.at_defect, shares.adjacent));
    return differences;
}

}  // namespace clsurf::cli
