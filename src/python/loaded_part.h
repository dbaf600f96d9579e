#pragma once
// LoadedPart: a part with all that is computed of it, each once: surface, columns, reports. Several threads may ask.

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "core/column.h"
#include "field/field_set.h"
#include "io/readers/part_file.h"
#include "pipeline/part.h"
#include "pipeline/point_query.h"

namespace clsurf::python {

/// How a part was read, to read it again otherwise.
struct PartRequest {
    io::PartFiles files;
    PartRules rules;
};

/// A column that lives as long as anything refers to it.
template <typename T>
using SharedColumn = std::shared_ptr<const Column<T>>;

/// What a query looks for: the members that are set.
struct Wanted {
    std::optional<PointIndex> point;
    std::optional<LineNumber> line;
    std::string file;            ///< of `line`; empty: the main program
    std::optional<double> time;  ///< [s]
    std::optional<WantedPlace> at;
};

/// Does not move once it is made. Threads that ask for what is not there yet take turns.
class LoadedPart {
public:
    /// Throws what io::read_part() throws.
    explicit LoadedPart(PartRequest request);
    /// A part that comes from no log file. `simulation`: the report of its simulation, a JSON text.
    LoadedPart(Part part, std::string simulation) : part_(std::move(part)), simulation_(std::move(simulation)) {}
    LoadedPart(const LoadedPart&) = delete;
    LoadedPart& operator=(const LoadedPart&) = delete;

    [[nodiscard]] const Part& part() const { return part_; }
    /// Empty: a recorded run.
    [[nodiscard]] const std::string& simulation() const { return simulation_; }
    [[nodiscard]] const ClSurface& surface() const;
    [[nodiscard]] const FieldSet& fields() const;

    [[nodiscard]] SharedColumn<double> time() const;         ///< [s]
    [[nodiscard]] SharedColumn<double> position() const;     ///< x, y, z of each point [mm]
    [[nodiscard]] SharedColumn<std::uint32_t> line() const;  ///< 0: none
    /// Number of the pass from 1; 0: none.
    [[nodiscard]] SharedColumn<std::uint32_t> pass_number() const;
    /// First and last point of each pass that cuts.
    [[nodiscard]] SharedColumn<std::int64_t> passes() const;
    /// In shown units. Throws UsageError: no such field, or it cannot be computed.
    [[nodiscard]] SharedColumn<float> field(const std::string& name) const;
    /// Values of a channel. Throws UsageError: the log has none of that name.
    [[nodiscard]] SharedColumn<double> channel_values(const std::string& name) const;
    [[nodiscard]] const Channel& channel(const std::string& name) const;

    /// Vertices of the surface, x, y, z of each [mm], and 3 of them for each triangle between adjacent passes.
    [[nodiscard]] SharedColumn<double> vertices() const;
    [[nodiscard]] SharedColumn<std::int64_t> triangles() const;

    /// The report of `clsurf check`, as JSON. Computed once.
    [[nodiscard]] const std::string& check() const;
    /// The report of `clsurf query`, as JSON. Throws UsageError: nothing of the log is there.
    [[nodiscard]] std::string query(const Wanted& wanted) const;

private:
    template <typename T, typename Make>
    SharedColumn<T> keep(std::map<std::string, SharedColumn<T>>& columns, const std::string& name, Make&& make) const;
    [[nodiscard]] std::string judged(Part part, std::optional<Role> measured) const;

    Part part_;
    std::optional<PartRequest> request_;
    std::string simulation_;

    mutable std::recursive_mutex busy_;
    mutable std::optional<ClSurface> surface_;
    mutable std::optional<FieldSet> fields_;
    mutable std::unique_ptr<const PointQuery> nearest_, plain_;
    mutable std::optional<std::string> check_;
    mutable std::map<std::string, SharedColumn<float>> floats_;
    mutable std::map<std::string, SharedColumn<double>> doubles_;
    mutable std::map<std::string, SharedColumn<std::uint32_t>> counts_;
    mutable std::map<std::string, SharedColumn<std::int64_t>> indices_;
};

}  // namespace clsurf::python
