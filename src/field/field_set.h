#pragma once
// FieldSet: the registry of fields. Providers offer them; code that colours, plots or exports gets them by name.
//
// To add a field of positions: one row in field_table.cpp. Other kinds: field_provider.h.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "field/field_provider.h"
#include "field/position_fields.h"

namespace clsurf {

class FieldSet {
public:
    /// An empty set, for a log with `points` points.
    explicit FieldSet(PointIndex points) : points_(points) {}
    /// Positions and channels of a log: PositionFields and ChannelFields. Shares their columns, and keeps no references
    /// to the objects.
    FieldSet(const Log& log, const Trajectory& path, const Passes& passes, Derivation derivation = {});

    /// Fields are in the order in which providers are added. Throws std::logic_error if a name is taken and the provider
    /// has no prefix.
    FieldSet& add(std::shared_ptr<const FieldProvider> provider);

    /// All fields.
    [[nodiscard]] std::vector<FieldInfo> fields() const;
    /// Names of the default fields of a report, if they can be computed, in its order, at most `most`; channels by their
    /// own names.
    [[nodiscard]] std::vector<std::string> report_names(std::size_t most) const;
    /// By its name, a synonym ("velocity"), or a channel as `log.NAME`.
    [[nodiscard]] bool has(std::string_view name) const { return find(name).has_value(); }
    /// Whether a field is known and its inputs are available.
    [[nodiscard]] bool can_compute(std::string_view name) const;
    /// The name that a synonym stands for; the word itself if it is unknown.
    [[nodiscard]] std::string usual_name(std::string_view word) const;

    /// One value per point. Throws UsageError: an unknown field (with a suggestion), or a missing input. O(points),
    /// parallel.
    [[nodiscard]] Field get(std::string_view name) const;
    /// Several at once, in that order: shared intermediate results (above all derivatives) are computed once.
    [[nodiscard]] std::vector<Field> get_all(const std::vector<std::string>& names) const;
    /// The same at points [first, last] only.
    [[nodiscard]] std::vector<Field> get_all(const std::vector<std::string>& names, PointRange points) const;

private:
    struct Entry {
        FieldInfo info;        ///< with its name in listings
        std::string own_name;  ///< its name in its provider
        std::size_t provider = 0;
    };
    struct Found {
        const Entry* entry = nullptr;
        std::string name;  ///< name by which it was found
    };
    [[nodiscard]] const Entry* find_name(std::string_view name) const;
    [[nodiscard]] std::optional<Found> find(std::string_view name) const;
    [[nodiscard]] Found require(std::string_view name) const;

    PointIndex points_ = 0;
    std::vector<std::shared_ptr<const FieldProvider>> providers_;
    std::vector<Entry> entries_;
};

/// Throws UsageError: no field has this name; the nearest is suggested.
[[noreturn]] void unknown_field(std::string_view name, const std::vector<FieldInfo>& fields);

}  // namespace clsurf
