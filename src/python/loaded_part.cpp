#include "python/loaded_part.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "core/block.h"
#include "core/error.h"
#include "core/spelling.h"
#include "pipeline/part_fields.h"
#include "viz/bands.h"

namespace clsurf::python {

LoadedPart::LoadedPart(PartRequest request)
    : part_(io::read_part(request.files, request.rules)), request_(std::move(request)) {}

template <typename T, typename Make>
SharedColumn<T> LoadedPart::keep(std::map<std::string, SharedColumn<T>>& columns, const std::string& name,
                                 Make&& make) const {
    const std::scoped_lock lock(busy_);
    if (const auto found = columns.find(name); found != columns.end()) return found->second;
    auto made = std::make_shared<const Column<T>>(make());
    columns.emplace(name, made);
    return made;
}

const ClSurface& LoadedPart::surface() const {
    const std::scoped_lock lock(busy_);
    if (!surface_) surface_ = stitch(part_);
    return *surface_;
}

const FieldSet& LoadedPart::fields() const {
    const std::scoped_lock lock(busy_);
    if (!fields_) fields_ = fields_of(part_, surface());
    return *fields_;
}

SharedColumn<double> LoadedPart::time() const {
    return keep(doubles_, "time", [&] {
        Column<double> times(static_cast<std::size_t>(part_.log.records));
        for (std::size_t i = 0; i < times.size(); ++i) times[i] = part_.log.time_of(static_cast<PointIndex>(i));
        return times;
    });
}

SharedColumn<double> LoadedPart::position() const {
    return keep(doubles_, "position", [&] {
        Column<double> xyz(3 * static_cast<std::size_t>(part_.log.records));
        for_each_block(part_.log.records, [&](PointIndex first, PointIndex last) {
            const auto n = static_cast<std::size_t>(last - first);
            std::array<Column<double>, 3> axes{Column<double>(n), Column<double>(n), Column<double>(n)};
            part_.path.read(first, axes[0], axes[1], axes[2]);
            for (std::size_t i = 0; i < n; ++i) {
                for (std::size_t k = 0; k < 3; ++k) xyz[3 * (static_cast<std::size_t>(first) + i) + k] = axes[k][i];
            }
        });
        return xyz;
    });
}

SharedColumn<std::uint32_t> LoadedPart::line() const {
    return keep(counts_, "line", [&] {
        Column<std::uint32_t> lines(static_cast<std::size_t>(part_.log.records));
        part_.lines->read(0, lines);
        std::ranges::replace(lines, no_line, 0U);  // a log without lines and without a program
        return lines;
    });
}

SharedColumn<std::uint32_t> LoadedPart::pass_number() const {
    return keep(counts_, "pass", [&] {
        Column<std::uint32_t> numbers(static_cast<std::size_t>(part_.log.records), 0);
        std::uint32_t number = 0;
        for (const Pass& pass : surface().passes) {
            if (pass.kind == PassKind::cut)
                std::fill(numbers.begin() + pass.first, numbers.begin() + pass.last + 1, ++number);
        }
        return numbers;
    });
}

SharedColumn<std::int64_t> LoadedPart::passes() const {
    return keep(indices_, "passes", [&] {
        Column<std::int64_t> ends;
        for (const Pass& pass : surface().passes) {
            if (pass.kind != PassKind::cut) continue;
            ends.push_back(pass.first);
            ends.push_back(pass.last);
        }
        return ends;
    });
}

SharedColumn<float> LoadedPart::field(const std::string& name) const {
    const std::scoped_lock lock(busy_);
    return keep(floats_, fields().usual_name(name), [&] {
        Field field = fields().get(name);
        if (field.info.unit.per_inside != 1) {
            for (float& v : field.values) v = static_cast<float>(v * field.info.unit.per_inside);
        }
        return std::move(field.values);
    });
}

const Channel& LoadedPart::channel(const std::string& name) const {
    if (const Channel* found = part_.log.find(name)) return *found;
    std::vector<std::string> names;
    for (const Channel& channel : part_.log.channels) names.push_back(channel.name);
    throw UsageError(fmt::format("the log has no channel '{}'", name),
                     fmt::format("it has {}", fmt::join(names, ", ")));
}

SharedColumn<double> LoadedPart::channel_values(const std::string& name) const {
    const ChannelView& view = channel(name).values;
    return keep(doubles_, "channel " + name, [&] {
        Column<double> values(static_cast<std::size_t>(view.count));
        copy_block(view, 0, values);
        return values;
    });
}

SharedColumn<double> LoadedPart::vertices() const {
    return keep(doubles_, "vertices", [&] {
        const Positions& positions = surface().positions;
        Column<double> xyz(3 * static_cast<std::size_t>(positions.size()));
        for (PointIndex i = 0; i < positions.size(); ++i) {
            const Vec3 p = positions.absolute(i);
            for (int k = 0; k < 3; ++k) xyz[static_cast<std::size_t>(3 * i + k)] = p[k];
        }
        return xyz;
    });
}

SharedColumn<std::int64_t> LoadedPart::triangles() const {
    return keep(indices_, "triangles", [&] { return viz::triangles_of(surface()); });
}

}  // namespace clsurf::python
