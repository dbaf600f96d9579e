#pragma once
// The content of the defect maps of `render --defects` and `report`.

#include <string>
#include <string_view>
#include <vector>

#include "cli/options/part.h"
#include "predictor/defect.h"
#include "viz/defect_map.h"
#include "viz/map_panel.h"

namespace clsurf::cli {

/// The defects of a report as marks, in decreasing order of strength.
[[nodiscard]] viz::DefectMap defect_map_of(const QualityReport& report);

/// Title, subtitle and notes. `subtitle` names the run; the number of defects precedes it.
[[nodiscard]] viz::MapTexts defect_map_texts(const QualityReport& report, const Part& part, std::string_view subtitle);

/// Adds a note if a run was not judged: without it, a picture without defects would suggest a good part. `which`: the panel.
void note_judgement(const QualityReport& report, std::string_view which, std::vector<std::string>& notes);

}  // namespace clsurf::cli
