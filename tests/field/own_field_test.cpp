// Fields of another program: a row, and a provider, that clsurf does not contain; and guarantees of the registry.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/units.h"
#include "field/channel_fields.h"
#include "field/field_set.h"

namespace clsurf::own_field_test {
namespace {

constexpr double radius = 20;  // [mm]
constexpr double speed = 50;   // [mm/s]
constexpr double period = 0.001;
constexpr PointIndex points = 3000;

/// A circle at constant speed, with feedback and an additional channel.
struct Circle {
    std::vector<double> columns[8];
    Log log;
    Passes passes;
    Trajectory path;

    Circle() {
        const double step = speed * period / radius;
        for (PointIndex i = 0; i < points; ++i) {
            const double angle = step * static_cast<double>(i);
            for (const std::size_t role : {0U, 3U}) {
                columns[role].push_back(radius * std::cos(angle));
                columns[role + 1].push_back(radius * std::sin(angle));
                columns[role + 2].push_back(1);
            }
            columns[6].push_back(30 * static_cast<double>(i % 7));
            columns[7].push_back(angle * deg_per_rad);
        }
        log.period = period;
        log.records = points;
        const char* names[] = {"cmd.x", "cmd.y", "cmd.z", "fb.x", "fb.y", "fb.z", "speed", "cmd.c"};
        for (std::size_t k = 0; k < 8; ++k)
            log.channels.push_back({names[k], k == 6 ? "A" : "mm", view_of(columns[k])});
        passes.push_back({0, points - 1, PassKind::cut});
        path = reconstruct(log, Role::commanded, Vec3::Zero());
    }
    [[nodiscard]] FieldSet with(std::span<const FieldRow> rows) const {
        FieldSet fields(points);
        fields.add(std::make_shared<const PositionFields>(log, path, passes, Derivation(), rows));
        return fields;
    }
};

// ---- an additional field is one row ----

double power(const FieldBlock::Vector& v, const FieldBlock::Vector& a, std::size_t i) {
    return std::abs(v[0][i] * a[0][i] + v[1][i] * a[1][i] + v[2][i] * a[2][i]) + 7;
}

constexpr FieldRow own_row{.name = "power_per_mass",
                           .label = "Power per mass",
                           .unit = {"W/kg", 1e-6},
                           .needs = needs::velocity | needs::acceleration,
                           .compute = kernel::each<power, needs::velocity, needs::acceleration>,
                           .also = {"power"}};

TEST(OwnField, IsOneRow) {
    const Circle circle;
    FieldSet fields(circle.log, circle.path, circle.passes);
    fields.add(std::make_shared<const PositionFields>(circle.log, circle.path, circle.passes, Derivation(),
                                                      std::span(&own_row, 1)));
    const std::vector<Field> both = fields.get_all({"speed", "power"});
    EXPECT_NEAR(both[0].values[1500], speed, 0.01);
    EXPECT_EQ(both[1].info.name, "power_per_mass");
    EXPECT_EQ(both[1].info.unit.name, "W/kg");
    EXPECT_NEAR(both[1].values[1500], 7, 0.5);  // the acceleration of a circle is across its velocity
    EXPECT_EQ(fields.fields().back().label, "Power per mass");
}

// ---- another kind of field is a provider ----

class PointNumbers : public FieldProvider {
public:
    [[nodiscard]] std::vector<FieldInfo> fields() const override {
        FieldInfo info;
        info.name = "number";
        return {info};
    }
    [[nodiscard]] std::vector<Field> compute(std::span<const std::string_view> names, PointRange range) const override {
        Field field{fields().front(), {}};
        for (PointIndex i = range.first; i <= range.last; ++i) field.values.push_back(static_cast<float>(i));
        return std::vector<Field>(names.size(), field);
    }
};

TEST(OwnField, OfAnotherKindIsAProvider) {
    const Circle circle;
    FieldSet fields(circle.log, circle.path, circle.passes);
    fields.add(std::make_shared<const PointNumbers>());
    EXPECT_EQ(fields.get("number").values[42], 42);
    const std::vector<Field> part = fields.get_all({"number", "speed"}, {100, 199});
    ASSERT_EQ(part[0].values.size(), 100U);
    EXPECT_EQ(part[0].values[0], 100);
    EXPECT_EQ(part[1].values[50], fields.get("speed").values[150]);
    EXPECT_THROW(fields.add(std::make_shared<const PointNumbers>()), std::logic_error) << "the name is taken";
}

TEST(FieldSet, ListsAChannelWithAFieldsNameUnderAPrefix) {
    const Circle circle;
    const FieldSet fields(circle.log, circle.path, circle.passes);
    EXPECT_NEAR(fields.get("speed").values[1500], speed, 0.01);
    EXPECT_EQ(fields.get("log.speed").values[1500], 30 * (1500 % 7));
    EXPECT_EQ(fields.get("log.speed").info.unit.name, "A");
    EXPECT_EQ(fields.get("log.cmd.x").values[0], fields.get("cmd.x").values[0]);
    EXPECT_EQ(fields.usual_name("feedrate"), "speed");
    EXPECT_EQ(fields.usual_name("log.speed"), "log.speed");
    EXPECT_FALSE(fields.has("log.jerk"));
}

TEST(FieldSet, ReportsHaveWhatCanBeComputedInTheirOrder) {
    Circle circle;
    EXPECT_EQ(FieldSet(circle.log, circle.path, circle.passes).report_names(16),
              (std::vector<std::string>{"speed", "acceleration", "tangential_acceleration", "jerk", "following_error",
                                        "contour_error", "speed.x", "speed.y", "speed.z", "acceleration.x",
                                        "acceleration.y", "acceleration.z", "speed.c", "acceleration.c"}));
    std::erase_if(circle.log.channels, [](const Channel& c) { return c.name.starts_with("fb."); });
    EXPECT_EQ(FieldSet(circle.log, circle.path, circle.passes).report_names(3),
              (std::vector<std::string>{"speed", "acceleration", "tangential_acceleration"}));
    EXPECT_EQ(FieldSet(circle.log, circle.path, circle.passes).report_names(16).size(), 12U);
}

// ---- what is shared is computed once ----

std::vector<const double*> seen;  // where the velocities of each block lie

void note_velocity(const FieldBlock& block, float* out) {
    seen.push_back(block.vector(needs::velocity)[0]);
    std::fill_n(out, block.count(), 0.0F);
}

TEST(FieldSet, ComputesDerivativesOnceForSeveralFields) {
    const Circle circle;
    const FieldRow rows[] = {
        {.name = "a", .needs = needs::velocity, .compute = note_velocity},
        {.name = "b", .needs = needs::velocity | needs::jerk, .compute = note_velocity},
    };
    seen.clear();
    (void)circle.with(rows).get_all({"a", "b"}, {0, 99});
    ASSERT_EQ(seen.size(), 2U);
    EXPECT_EQ(seen[0], seen[1]);
}

TEST(FieldSet, GivesTheSameTogetherAsOneByOne) {
    const Circle circle;
    const FieldSet fields(circle.log, circle.path, circle.passes);
    std::vector<std::string> names;
    for (const FieldRow& row : field_table()) {
        const bool there = row.subject == FieldSubject::tip || row.axis == 'c';
        if (there && (row.needs & needs::sigmas) == 0 && row.subject != FieldSubject::tool_axis)
            names.emplace_back(row.name);
    }
    ASSERT_GT(names.size(), 20U);
    const std::vector<Field> together = fields.get_all(names);
    for (std::size_t k = 0; k < names.size(); ++k) {
        const Field alone = fields.get(names[k]);
        EXPECT_EQ(together[k].info.note, alone.info.note);
        for (std::size_t i = 0; i < alone.values.size(); ++i) {
            const float a = together[k].values[i];
            const float b = alone.values[i];
            ASSERT_TRUE(a == b || (a != a && b != b)) << names[k] << " at " << i;
        }
    }
    EXPECT_NEAR(fields.get("speed.c").values[1500], speed / radius, 1e-4);
}

// ---- a kernel never reads what is not there ----

TEST(FieldRow, ThatReadsMoreThanItNeedsIsAnErrorWithItsName) {
    const Circle circle;
    FieldRow row = own_row;
    row.needs = needs::velocity;
    try {
        (void)circle.with(std::span(&row, 1)).get("power_per_mass");
        FAIL();
    } catch (const std::logic_error& error) {
        EXPECT_STREQ(error.what(), "field 'power_per_mass' reads acceleration, which its row does not need");
    }
    // Whatever other rows need.
    const FieldRow rows[] = {row, {.name = "full", .needs = own_row.needs, .compute = own_row.compute}};
    EXPECT_THROW((void)circle.with(rows).get_all({"full", "power_per_mass"}), std::logic_error);
    // An angle has one component, and a component needs an axis.
    row = {.name = "norm",
           .axis = 'c',
           .subject = FieldSubject::rotary_axis,
           .needs = needs::velocity,
           .compute = note_velocity};
    EXPECT_THROW((void)circle.with(std::span(&row, 1)).get("norm"), std::logic_error);
    row = {.name = "which", .needs = needs::velocity, .compute = kernel::component<needs::velocity>};
    EXPECT_THROW((void)circle.with(std::span(&row, 1)).get("which"), std::logic_error);
}

TEST(FieldTable, EachRowReadsAllThatItNeedsAndNothingElse) {
    const Circle circle;
    const std::vector<double> zeros(1000, 1.0);
    std::vector<float> out(1);
    for (const FieldRow& row : field_table()) {
        SCOPED_TRACE(row.name);
        ASSERT_NE(row.compute, nullptr);
        const auto compute = [&](unsigned given) {
            FieldBlock block(row, 1);
            const double* const at = zeros.data() + 500;
            for (unsigned bit = 0; bit < needs::kinds; ++bit) {
                if ((given & (1U << bit)) == 0) continue;
                block.set(1U << bit, row.subject == FieldSubject::rotary_axis ? FieldBlock::Vector{at}
                                                                              : FieldBlock::Vector{at, at, at});
            }
            row.compute(block, out.data());
        };
        EXPECT_NO_THROW(compute(row.needs));
        for (unsigned bit = 0; bit < needs::kinds; ++bit) {
            if ((row.needs & (1U << bit)) != 0) { EXPECT_THROW(compute(row.needs & ~(1U << bit)), std::logic_error); }
        }
    }
}

}  // namespace
}  // namespace clsurf::own_field_test
