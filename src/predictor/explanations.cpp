#include "predictor/explanations.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/point_count.h"
#include "core/point_ranges.h"

namespace clsurf {
namespace {

constexpr double effect_seconds = 0.020;  ///< an effect may last so much longer than its cause
constexpr int severe = 3;                 ///< a motion reaches this severity by its speed alone

/// Sections that explain the sites inside them.
class Explanations {
public:
    /// `room`: points by which each section is extended.
    explicit Explanations(PointIndex room) : room_(room) {}

    void add(const std::vector<DefectSection>& sections) {
        for (const DefectSection& section : sections)
            sections_.push_back({section.points.first - room_, section.points.last + room_, 0});
        sorted_ = false;
    }

    /// Whether at least half of the sites, in the order of their points, are inside added sections, of one defect or of
    /// several. O(sites log sections), and at the first call O(sections log sections).
    [[nodiscard]] bool explain(CandidateSpan sites) {
        sort();
        if (is_elsewhere(sites)) return false;
        const auto inside = [&](const DefectCandidate* s) {
            const auto section = range_at(sections_, s->point);
            return section != sections_.end() && section->first <= s->point && s->point <= section->farthest;
        };
        return 2 * std::count_if(sites.begin(), sites.end(), inside) >= static_cast<std::ptrdiff_t>(sites.size());
    }

private:
    struct Section {
        PointIndex first, last;
        PointIndex farthest;  ///< last of this one and all before
    };
    /// Quick test: most sites are before or after all sections.
    [[nodiscard]] bool is_elsewhere(CandidateSpan sites) const {
        if (sites.empty()) return false;
        return sections_.empty() || sites.back()->point < sections_.front().first ||
               sections_.back().farthest < sites.front()->point;
    }

    void sort() {
        if (sorted_) return;
        std::sort(sections_.begin(), sections_.end(),
                  [](const Section& a, const Section& b) { return a.first < b.first; });
        PointIndex farthest = 0;
        for (Section& s : sections_) s.farthest = farthest = std::max(farthest, s.last);
        sorted_ = true;
    }

    PointIndex room_;
    std::vector<Section> sections_;
    bool sorted_ = true;
};

/// Whether a height comes from the program, not from the controller.
bool is_programmed(const BuiltDefect& built) {
    return built.listed && !built.expected && built.defect.quantity == Quantity::relief &&
           built.defect.cause != Cause::path_tolerance;
}

/// Whether a height of the program can explain a defect at its place.
bool explains(const Defect& height, const Defect& other) {
    if (other.severity > height.severity) return false;
    return other.severity < severe || other.score <= height.score;
}

}  // namespace

std::vector<BuiltDefect> unexplained(std::span<std::vector<BuiltDefect>> of_family, double period) {
    const PointIndex room = points_in(effect_seconds, period, 0);
    std::vector<BuiltDefect> all;
    std::vector<BuiltDefect> programmed;
    for (std::size_t family = 0; family < of_family.size(); family += 2) {
        Explanations before(room), expected(room);
        for (const BuiltDefect& built : all) {
            before.add(built.defect.sections);
            if (built.expected) expected.add(built.defect.sections);
        }
        for (std::vector<BuiltDefect>& built_there : of_family.subspan(family, 2)) {
            for (BuiltDefect& built : built_there) {
                if (is_programmed(built) && !expected.explain(built.core))
                    programmed.push_back(std::move(built));
                else if (!before.explain(built.core))
                    all.push_back(std::move(built));
            }
        }
    }
    for (BuiltDefect& height : programmed) {
        Explanations program(room);
        program.add(height.defect.sections);
        std::erase_if(all, [&](const BuiltDefect& built) {
            return !built.expected && explains(height.defect, built.defect) && program.explain(built.core);
        });
        all.push_back(std::move(height));
    }
    return all;
}

}  // namespace clsurf
