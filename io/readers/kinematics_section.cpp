#include "io/readers/kinematics_section.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/spelling.h"

namespace clsurf::io {
namespace {

constexpr std::array<std::string_view, 3> rotary_letters{"a", "b", "c"};
/// Axes with a smaller angle between them are not a pair; sine of the angle.
constexpr double least_between = 0.01;

/// A vector of [kinematics.offsets]: its key, its symbol in the equations and the types that have it.
struct OffsetKey {
    std::string_view key, symbol;
    Vec3 Kinematics::*vector;
    std::array<bool, 4> of_type;  ///< by KinematicsType
};
constexpr std::array<OffsetKey, 4> offset_keys{{
    {"rotation_centre", "o", &Kinematics::rotation_centre, {false, true, false, true}},
    {"centre_from_tilt", "d", &Kinematics::centre_from_tilt, {false, true, false, false}},
    {"tilt_point", "m", &Kinematics::tilt_point, {false, true, false, false}},
    {"tilt_from_rotation", "b", &Kinematics::tilt_from_rotation, {false, false, true, false}},
}};
constexpr std::string_view length_key = "tool_length", length_symbol = "L";

Vec3 vector_of(const TomlFile& file, const toml::node& node, std::string_view key) {
    const toml::array* numbers = node.as_array();
    Vec3 value = Vec3::Zero();
    bool right = numbers != nullptr && numbers->size() == 3;
    for (std::size_t i = 0; right && i < 3; ++i) {
        right = numbers->get(i)->is_number();
        if (right) value[static_cast<int>(i)] = *numbers->get(i)->value<double>();
    }
    if (!right || !value.allFinite()) file.fail(node, fmt::format("'{}' must be three numbers, [x, y, z]", key));
    return value;
}

/// The axis of a letter; an error at `node` if it is not one of the pair.
RotaryAxis& axis_of(const TomlFile& file, const toml::node& node, std::string_view letter, Kinematics& kinematics) {
    for (RotaryAxis* axis : {&kinematics.tilt, &kinematics.rotation}) {
        if (letter.size() == 1 && axis->letter == letter.front()) return *axis;
    }
    file.fail(node, fmt::format("'{}' is not one of the rotary axes {} and {}", letter, kinematics.tilt.letter,
                                kinematics.rotation.letter));
}

void read_pair(const TomlFile& file, const toml::table& table, Kinematics& kinematics) {
    const toml::node* node = table.get("rotary");
    if (node == nullptr) return;
    const toml::array* letters = node->as_array();
    const auto right = [&](std::size_t i) {
        const std::optional<std::string> letter = letters->get(i)->value<std::string>();
        return letter && std::find(rotary_letters.begin(), rotary_letters.end(), *letter) != rotary_letters.end();
    };
    if (letters == nullptr || letters->size() != 2 || !right(0) || !right(1)) {
        file.fail(*node, "'rotary' must be two of \"a\", \"b\", \"c\": the tilting axis, then the other");
    }
    const auto axis = [&](std::size_t i) {
        const char letter = letters->get(i)->value<std::string>()->front();
        const Vec3 direction = Vec3::Unit(letter - 'a');
        return RotaryAxis{letter, direction, 1};
    };
    kinematics.tilt = axis(0);
    kinematics.rotation = axis(1);
    if (kinematics.tilt.letter == kinematics.rotation.letter) file.fail(*node, "'rotary' names the same axis twice");
}

void read_signs(const TomlFile& file, const toml::table& table, Kinematics& kinematics) {
    const toml::table* signs = file.section(table, "signs");
    if (signs == nullptr) return;
    for (const auto& [key, node] : *signs) {
        RotaryAxis& axis = axis_of(file, node, key.str(), kinematics);
        const double sign = *file.number(*signs, key.str());
        if (sign != 1 && sign != -1)
            file.fail(node, fmt::format("the sign of '{}' is {}, expected 1 or -1", std::string_view(key.str()), sign));
        axis.sign = sign;
    }
}

void read_directions(const TomlFile& file, const toml::table& table, Kinematics& kinematics) {
    if (const toml::table* directions = file.section(table, "directions")) {
        for (const auto& [key, node] : *directions) {
            RotaryAxis& axis = axis_of(file, node, key.str(), kinematics);
            const Vec3 direction = vector_of(file, node, key.str());
            if (!(direction.norm() > 0))
                file.fail(node, fmt::format("the direction of '{}' is zero", std::string_view(key.str())));
            axis.direction = direction.normalized();
        }
    }
    const Vec3& k = kinematics.tool_axis;
    if (kinematics.tilt.direction.cross(kinematics.rotation.direction).norm() < least_between)
        file.fail(table, "the two rotary axes are parallel");
    if (kinematics.tilt.direction.cross(k).norm() < least_between) {
        file.fail(table, fmt::format("the tilting axis {} is parallel to the tool", kinematics.tilt.letter),
                  "'rotary' names the tilting axis first, then the other");
    }
}

void read_offsets(const TomlFile& file, const toml::table& table, Kinematics& kinematics) {
    const toml::table* offsets = file.section(table, "offsets");
    if (offsets == nullptr) return;
    std::vector<std::string_view> known{length_key, length_symbol};
    for (const OffsetKey& offset : offset_keys) known.insert(known.end(), {offset.key, offset.symbol});
    file.allow(*offsets, known);
    const auto given = [&](std::string_view key, std::string_view symbol) {
        const toml::node* by_symbol = offsets->get(symbol);
        if (by_symbol != nullptr && offsets->get(key) != nullptr)
            file.fail(*by_symbol, fmt::format("'{}' is '{}' again", symbol, key));
        return by_symbol != nullptr ? symbol : key;
    };
    for (const OffsetKey& offset : offset_keys) {
        const std::string_view key = given(offset.key, offset.symbol);
        const toml::node* node = offsets->get(key);
        if (node == nullptr) continue;
        if (!offset.of_type[static_cast<std::size_t>(kinematics.type)]) {
            file.fail(*node, fmt::format("'{}' is not an offset of a {} machine", key, name_of(kinematics.type)));
        }
        kinematics.*offset.vector = vector_of(file, *node, key);
    }
    const std::string_view key = given(length_key, length_symbol);
    if (const std::optional<double> length = file.number(*offsets, key)) {
        if (*length < 0) file.fail(*offsets->get(key), fmt::format("'{}' is {}, expected 0 or more", key, *length));
        kinematics.tool_length = *length;
    }
}

}  // namespace

Kinematics read_kinematics(const TomlFile& file, const toml::table& table) {
    Kinematics kinematics;
    std::vector<std::string_view> types;
    for (const KinematicsType type : kinematics_types()) types.push_back(name_of(type));
    if (const std::optional<std::string> type = file.text(table, "type")) {
        const auto found = std::find(types.begin(), types.end(), *type);
        if (found == types.end()) {
            const std::string nearest = did_you_mean(*type, types);
            file.fail(*table.get("type"), fmt::format("'type' is '{}', which is not known", *type),
                      nearest.empty() ? fmt::format("one of: {}", fmt::join(types, ", ")) : nearest);
        }
        kinematics.type = kinematics_types()[static_cast<std::size_t>(found - types.begin())];
    }
    if (!kinematics.has_rotary()) {
        file.allow(table, {"type"});
        return kinematics;
    }
    file.allow(table, {"type", "rotary", "signs", "directions", "offsets", "tool_centre_point", "interpolation",
                       "axis_tolerance"});
    read_pair(file, table, kinematics);
    read_signs(file, table, kinematics);
    read_directions(file, table, kinematics);
    read_offsets(file, table, kinematics);
    if (const std::optional<std::string> when = file.text(table, "tool_centre_point")) {
        if (*when != "program" && *when != "always")
            file.fail(*table.get("tool_centre_point"), "'tool_centre_point' must be \"program\" or \"always\"");
        kinematics.always_tool_centre_point = *when == "always";
    }
    if (const std::optional<std::string> word = file.text(table, "interpolation")) {
        bool known = false;
        for (const ToolAxisInterpolation mode :
             {ToolAxisInterpolation::linear, ToolAxisInterpolation::vector, ToolAxisInterpolation::safe}) {
            if (*word != name_of(mode)) continue;
            kinematics.interpolation = mode;
            known = true;
        }
        if (!known)
            file.fail(*table.get("interpolation"), "'interpolation' must be \"linear\", \"vector\" or \"safe\"");
    }
    if (const std::optional<double> tolerance = file.number(table, "axis_tolerance")) {
        if (!(*tolerance > 0))
            file.fail(*table.get("axis_tolerance"),
                      fmt::format("'axis_tolerance' is {}, expected more than 0", *tolerance));
        kinematics.axis_tolerance = *tolerance * rad_per_deg;
    }
    return kinematics;
}

std::string kinematics_text(const Kinematics& kinematics) {
    std::string text = fmt::format("\n[kinematics]\ntype = \"{}\"\n", name_of(kinematics.type));
    if (!kinematics.has_rotary()) return text;
    const RotaryAxis& t = kinematics.tilt;
    const RotaryAxis& r = kinematics.rotation;
    const auto vector = [](const Vec3& v) { return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z()); };
    text +=
        fmt::format("rotary = [\"{}\", \"{}\"]            # the tilting axis, then the other\n", t.letter, r.letter);
    text += fmt::format("signs = {{ {} = {}, {} = {} }}\n", t.letter, t.sign, r.letter, r.sign);
    text += fmt::format("tool_centre_point = \"{}\"  # program: as its words say\n",
                        kinematics.always_tool_centre_point ? "always" : "program");
    text += fmt::format("interpolation = \"{}\"       # of the tool axis\n", name_of(kinematics.interpolation));
    text += fmt::format("axis_tolerance = {}\n", twelve_digits(kinematics.axis_tolerance * deg_per_rad));
    text += fmt::format("\n[kinematics.directions]\n{} = {}\n{} = {}\n", t.letter, vector(t.direction), r.letter,
                        vector(r.direction));
    text += "\n[kinematics.offsets]\n";
    for (const OffsetKey& offset : offset_keys) {
        if (offset.of_type[static_cast<std::size_t>(kinematics.type)])
            text += fmt::format("{} = {}\n", offset.key, vector(kinematics.*offset.vector));
    }
    return text + fmt::format("tool_length = {}\n", kinematics.tool_length);
}

}  // namespace clsurf::io
