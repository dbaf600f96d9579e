#include "pipeline/part_fields.h"

#include <utility>

#include "field/channel_fields.h"
#include "intervals/interval_fields.h"
#include "pipeline/cause_fields.h"
#include "pipeline/channel_classes.h"
#include "pipeline/feed_fields.h"
#include "pipeline/limits_of.h"
#include "pipeline/program_fields.h"
#include "pipeline/scallop_fields.h"
#include "pipeline/signals_of.h"
#include "predictor/quality_fields.h"

namespace clsurf {
namespace {

Signals signals_alone(const Part& part, const ClSurface& surface) {
    return std::move(signals_of(part, surface).signals);
}

void add_path_fields(FieldSet& fields, const Part& part, const ClSurface& surface) {
    const auto positions = std::make_shared<const PositionFields>(part.log, part.path, surface.passes,
                                                                  Derivation{estimate_motion(part, surface.passes), 0});
    fields.add(positions);
    fields.add(std::make_shared<const FeedFields>(part.program, part.lines, positions));
    fields.add(std::make_shared<const ProgramFields>(part.program, part.lines));
}

}  // namespace

FieldSet path_fields_of(const Part& part, const ClSurface& surface) {
    FieldSet fields(part.log.records);
    add_path_fields(fields, part, surface);
    fields.add(std::make_shared<const ChannelFields>(part.log, channel_classes()));
    return fields;
}

FieldSet fields_of(const Part& part, const ClSurface& surface,
                   const std::vector<std::shared_ptr<const FieldProvider>>& more) {
    FieldSet fields(part.log.records);
    add_path_fields(fields, part, surface);
    fields.add(std::make_shared<const QualityFields>(surface, [&] { return signals_alone(part, surface); }));
    fields.add(std::make_shared<const CauseFields>(part, surface));
    fields.add(
        std::make_shared<const IntervalFields>(part.program, part.lines, part.machine ? *part.machine : Machine{}));
    fields.add(limit_fields(part));
    fields.add(std::make_shared<const ScallopFields>(surface, part.tool));
    for (const auto& provider : more) fields.add(provider);
    fields.add(std::make_shared<const ChannelFields>(part.log, channel_classes()));
    return fields;
}

}  // namespace clsurf
