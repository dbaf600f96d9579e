#include "cli/defect_colours.h"

#include "pipeline/feed_fields.h"
#include "viz/colour_difference.h"
#include "viz/field_colours.h"

namespace clsurf::cli {

std::vector<double> colour_differences(const QualityReport& report, const Part& part) {
    const FieldInfo shown = feed_share_info();
    const viz::ColourScale scale = viz::scale_of(shown, shown.unit.per_inside * shown.usual_range->low,
                                                 shown.unit.per_inside * shown.usual_range->high);
    std::vector<double> differences;
    for (const Defect& defect : report.defects) {
        const double programmed = programmed_feed_at(part, defect.point);
        const double feed = programmed > 0 ? programmed : static_cast<double>(report.thresholds.usual_speed);
        const auto look = [&](double mm_s) { return viz::lab_of(scale.colour(mm_s / feed * shown.unit.per_inside)); };
        differences.push_back(viz::delta_e00(look(defect.speed), look(defect.speed_beside)));
    }
    return differences;
}

}  // namespace clsurf::cli
