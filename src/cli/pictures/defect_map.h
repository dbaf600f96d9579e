#pragma once
// What the defect map of `render --defects` and of `report` shows of the defects of a part.

#include <string>
#include <string_view>
#include <vector>

#include "cli/options/part.h"
#include "predictor/defect.h"
#include "viz/defect_map.h"
#include "viz/map_panel.h"

namespace clsurf::cli {

/// The defects of a report as marks, the strongest first.
[[nodiscard]] viz::DefectMap defect_map_of(const QualityReport& report);

/// Title, subtitle and notes. `subtitle` names the run; the number of defects stands before it.
[[nodiscard]] viz::MapTexts defect_map_texts(const QualityReport& report, const Part& part, std::string_view subtitle);

/// A picture without defects of a run that was not judged would look like one of a good part. `which` says which of two.
void note_judgement(const QualityReport& report, std::string_view which, std::vector<std::string>& notes);

}  // namespace clsurf::cli
