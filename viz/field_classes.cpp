#include "viz/field_classes.h"

#include <algorithm>
#include <array>
#include <map>
#include <span>

#include <fmt/format.h>

#include "core/not_finite.h"

namespace clsurf::viz {
namespace {

/// The "muted" scheme of Paul Tol (Colour Schemes, SRON/EPS/TN/09-002, 2021), safe for colour-blind readers.
constexpr std::array<Rgb, FieldClasses::most_named> palette{{{204, 102, 119},
                                                             {51, 34, 136},
                                                             {221, 204, 119},
                                                             {17, 119, 51},
                                                             {136, 204, 238},
                                                             {136, 34, 85},
                                                             {68, 170, 153},
                                                             {153, 153, 51},
                                                             {170, 68, 153}}};
constexpr Rgb good_colour{226, 226, 226};
constexpr std::array<Rgb, 2> other_colours{{{200, 200, 200}, {176, 176, 176}}};

}  // namespace

ValueCounts count_values(const Column<float>& values, const Passes& passes) {
    ValueCounts counts;
    for (const Pass& pass : passes) {
        if (pass.kind != PassKind::cut) continue;
        for (PointIndex i = pass.first; i <= pass.last;) {
            const float value = values[static_cast<std::size_t>(i)];
            const PointIndex first = i;
            while (i <= pass.last && values[static_cast<std::size_t>(i)] == value) ++i;
            if (value == value)
                counts[value] += i - first;
            else
                ++i;
        }
    }
    return counts;
}

FieldClasses::FieldClasses(const FieldInfo& info, const ValueCounts& counts) {
    double all = 0;
    for (const auto& [value, count] : counts) all += static_cast<double>(count);
    // Known classes have the same colours in all pictures; others are coloured in order of their shares.
    std::vector<std::pair<PointIndex, float>> by_share;
    for (const auto& [value, count] : counts) by_share.emplace_back(-count, value);
    std::sort(by_share.begin(), by_share.end());
    std::map<float, std::size_t> colour_of;
    std::size_t next = 0;
    const auto take = [&](float value, const std::string& name, bool good) {
        const auto found = counts.find(value);
        const double share = found == counts.end() ? 0 : static_cast<double>(found->second) / all;
        const Rgb rgb = good ? good_colour : palette[next++];
        colour_of[value] = colours_.size();
        colours_.push_back(rgb);
        if (share > 0) shown_.push_back({name, value, rgb, share});
    };
    for (const FieldClass& known : info.classes) {
        if (known.good || next < most_named) take(known.value, known.name, known.good);
    }
    for (const auto& [count, value] : by_share) {
        if (colour_of.contains(value) || next >= most_named) continue;
        const double number = static_cast<double>(value) * info.unit.per_inside;
        take(value,
             info.unit.name.empty() ? fmt::format("{} {:.6g}", info.class_word, number)
                                    : fmt::format("{:.4g} {}", number, info.unit.name),
             false);
    }
    ShownClass others{"", missing<float>, other_colours[0], 0};
    std::size_t rest = 0;
    const std::size_t first_grey = colours_.size();
    colours_.insert(colours_.end(), other_colours.begin(), other_colours.end());
    for (const auto& [value, count] : counts) {
        if (colour_of.contains(value)) continue;
        colour_of[value] = first_grey + rest++ % other_colours.size();
        others.share += static_cast<double>(count) / all;
    }
    for (const auto& [value, colour] : colour_of) entries_.push_back({value, colour});
    std::stable_sort(shown_.begin(), shown_.end(),
                     [](const ShownClass& a, const ShownClass& b) { return a.share > b.share; });
    others.name = rest == 1 ? "1 other" : fmt::format("{} others", rest);
    if (rest > 0) shown_.push_back(others);
}

float FieldClasses::place_of(float value) const {
    const auto found = std::lower_bound(entries_.begin(), entries_.end(), value,
                                        [](const Entry& entry, float v) { return entry.value < v; });
    if (found == entries_.end() || found->value != value) return missing<float>;
    return static_cast<float>(found->colour) + 0.5F;
}

Rgb FieldClasses::rgb_of(float value) const {
    const float place = place_of(value);
    return place == place ? colours_[static_cast<std::size_t>(place)] : Rgb{255, 255, 255};
}

ColourScale FieldClasses::scale() const {
    std::vector<ColourStop> stops;
    const auto count = static_cast<double>(colours_.size());
    constexpr double edge = 1e-9;
    for (std::size_t k = 0; k < colours_.size(); ++k) {
        stops.push_back({static_cast<double>(k) / count + (k > 0 ? edge : 0), colours_[k]});
        stops.push_back({static_cast<double>(k + 1) / count, colours_[k]});
    }
    return {ColourMap("classes", std::move(stops)), 0, count, static_cast<int>(colours_.size())};
}

namespace {

/// Adds vertices to a Detail.
class Divider {
public:
    explicit Divider(Detail& detail) : detail_(detail) {}

    void triangles() {
        Column<std::uint32_t> whole;
        std::swap(whole, detail_.geometry.triangles);
        for (std::size_t i = 0; i + 3 <= whole.size(); i += 3) {
            const std::array<std::uint32_t, 3> v{whole[i], whole[i + 1], whole[i + 2]};
            if (same(v[0], v[1]) && same(v[1], v[2])) {
                triangle(v[0], v[1], v[2]);
                continue;
            }
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t corner = v[k];
                const std::uint32_t a = v[(k + 1) % 3];
                const std::uint32_t b = v[(k + 2) % 3];
                const std::uint32_t to_a = mean_of(std::array{corner, a}, corner);
                const std::uint32_t centre = mean_of(v, corner);
                const std::uint32_t to_b = mean_of(std::array{corner, b}, corner);
                triangle(corner, to_a, centre);
                triangle(corner, centre, to_b);
            }
        }
    }

    void segments() {
        Column<std::uint32_t> whole;
        std::swap(whole, detail_.geometry.segments);
        Column<std::uint32_t>& out = detail_.geometry.segments;
        for (std::size_t i = 0; i + 2 <= whole.size(); i += 2) {
            const std::array ends{whole[i], whole[i + 1]};
            if (same(ends[0], ends[1])) {
                for (const std::uint32_t v : ends) out.push_back(v);
                continue;
            }
            for (const std::uint32_t end : ends) {
                out.push_back(end);
                out.push_back(mean_of(ends, end));
            }
        }
    }

private:
    /// Cells without a value are not divided: they are hatched.
    [[nodiscard]] bool same(std::uint32_t a, std::uint32_t b) const {
        const float x = detail_.values[a];
        const float y = detail_.values[b];
        return x == y || !(x == x) || !(y == y);
    }

    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        for (const std::uint32_t v : {a, b, c}) detail_.geometry.triangles.push_back(v);
    }

    /// A vertex in the middle of others, with the class of `corner`.
    std::uint32_t mean_of(std::span<const std::uint32_t> vertices, std::uint32_t corner) {
        Geometry& g = detail_.geometry;
        const auto made = static_cast<std::uint32_t>(g.xyz.size() / 3);
        const auto add = [&](Column<float>& column) {
            for (std::size_t k = 0; k < 3; ++k) {
                float sum = 0;
                for (const std::uint32_t v : vertices) sum += column[3 * static_cast<std::size_t>(v) + k];
                column.push_back(sum / static_cast<float>(vertices.size()));
            }
        };
        add(g.xyz);
        if (!g.normals.empty()) add(g.normals);
        detail_.values.push_back(detail_.values[corner]);
        detail_.points.push_back(detail_.points[corner]);
        return made;
    }

    Detail& detail_;
};

}  // namespace

void divide_by_class(Detail& detail, const Column<float>& values, const FieldClasses& classes) {
    for (std::size_t v = 0; v < detail.values.size(); ++v)
        detail.values[v] = classes.place_of(values[static_cast<std::size_t>(detail.points[v])]);
    Divider divider(detail);
    divider.triangles();
    divider.segments();
}

}  // namespace clsurf::viz
