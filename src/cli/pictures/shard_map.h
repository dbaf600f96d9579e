#pragma once
// ShardMap: the map of a surveyed log, drawn shard by shard.

#include <limits>
#include <optional>
#include <string>

#include "cli/pictures/render_options.h"
#include "cli/pictures/shown_part.h"
#include "field/field_set.h"
#include "field/range.h"
#include "pipeline/shards.h"
#include "surface/surface_part.h"
#include "viz/scene.h"

namespace clsurf::cli {

class ShardMap {
public:
    /// `shown`: the surveyed part, without a field. Throws UsageError: a field whose values or range depend on the whole log.
    ShardMap(const RenderOptions& options, Shown shown, const Survey& survey);
    ShardMap(const ShardMap&) = delete;
    ShardMap& operator=(const ShardMap&) = delete;

    /// The drawn parts of one or several shards, and the range of their values on shown cut passes.
    struct Drawn {
        viz::DrawnParts parts;
        double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;

        /// Adds later shards.
        void add(const Drawn& later);
    };
    /// Reads one shard after another. Domain: 1 ≤ first ≤ last ≤ count.
    [[nodiscard]] Drawn draw(int first, int last, int count);
    /// The picture of all shards.
    [[nodiscard]] viz::Image picture(const Drawn& all) const;

    [[nodiscard]] const Shown& shown() const { return shown_; }
    [[nodiscard]] const ShownRange& range() const { return range_; }
    [[nodiscard]] const viz::Camera& camera() const { return placed_.camera; }

private:
    class Shards;

    /// Sets the field of shown_, without values. Returns its range.
    [[nodiscard]] ShownRange choose_field();

    const RenderOptions& options_;
    Shown shown_;  ///< its field has no values
    const Survey& survey_;
    FieldSet fields_;
    ShownRange range_;
    viz::ColourScale scale_;
    viz::MapPanel whole_;
    viz::PlacedMap placed_;
};

}  // namespace clsurf::cli
