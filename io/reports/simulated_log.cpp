#include "io/reports/simulated_log.h"

#include <cstring>

#include "core/units.h"
#include "io/files/json_value.h"
#include "io/reports/fidelity_report.h"

namespace clsurf::io {
namespace {

std::vector<StoredChannel> channels(const Kinematics& kinematics) {
    std::vector<StoredChannel> list;
    for (const char* role : {"cmd.", "fb."}) {
        for (const std::string_view axis : axis_names)
            list.push_back({role + std::string(axis), "mm", ScalarType::f64, 1.0});
        if (!kinematics.has_rotary()) continue;
        for (const char letter : {kinematics.tilt.letter, kinematics.rotation.letter})
            list.push_back({role + std::string(1, letter), "deg", ScalarType::f64, 1.0});
    }
    list.push_back({"speed", "mm/min", ScalarType::f64, 1.0});
    list.push_back({"line", "", ScalarType::u32, 1.0});
    list.push_back({"limit", "", ScalarType::u32, 1.0});
    return list;
}

struct Record {
    double commanded[3], feedback[3], speed;
    std::uint32_t line, limit;
};

struct FiveAxisRecord {
    double commanded[5], feedback[5], speed;
    std::uint32_t line, limit;
};

Json by_axis(const Vec3& v, double factor) {
    Json json;
    for (std::size_t i = 0; i < axis_names.size(); ++i)
        json[std::string(axis_names[i])] = number(v[static_cast<int>(i)] * factor);
    return json;
}

}  // namespace

SimulatedLogWriter::SimulatedLogWriter(const std::string& path, const Machine& machine, const std::string& metadata)
    : kinematics_(machine.kinematics),
      writer_(path, channels(machine.kinematics), machine.controller.period, metadata) {}

void SimulatedLogWriter::append(std::span<const SimulatedPoint> points) {
    static_assert(sizeof(Record) == 7 * 8 + 2 * 4, "packed as the channels are");
    records_.resize(points.size() * sizeof(Record));
    for (std::size_t i = 0; i < points.size(); ++i) {
        const SimulatedPoint& p = points[i];
        const Record record{{p.commanded.x(), p.commanded.y(), p.commanded.z()},
                            {p.feedback.x(), p.feedback.y(), p.feedback.z()},
                            p.speed * seconds_per_minute,
                            p.line,
                            static_cast<std::uint32_t>(p.limit)};
        std::memcpy(records_.data() + i * sizeof(Record), &record, sizeof(Record));
    }
    writer_.append(std::as_bytes(std::span(records_)));
}

void SimulatedLogWriter::append(std::span<const FiveAxisPoint> points) {
    static_assert(sizeof(FiveAxisRecord) == 11 * 8 + 2 * 4, "packed as the channels are");
    records_.resize(points.size() * sizeof(FiveAxisRecord));
    const std::array<double, 5> factors{1, 1, 1, kinematics_.tilt.sign * deg_per_rad,
                                        kinematics_.rotation.sign * deg_per_rad};
    for (std::size_t i = 0; i < points.size(); ++i) {
        const FiveAxisPoint& p = points[i];
        FiveAxisRecord record{{}, {}, p.speed * seconds_per_minute, p.line, static_cast<std::uint32_t>(p.limit)};
        for (std::size_t k = 0; k < 5; ++k) {
            record.commanded[k] = p.commanded[k] * factors[k];
            record.feedback[k] = p.feedback[k] * factors[k];
        }
        std::memcpy(records_.data() + i * sizeof(FiveAxisRecord), &record, sizeof(FiveAxisRecord));
    }
    writer_.append(std::as_bytes(std::span(records_)));
}

namespace {

Json json_of(const SimulationSummary& summary) {
    Json json{{"duration_s", number(summary.duration)}, {"points", summary.points}};
    json["max"] = Json{{"speed_mm_min", number(summary.max_speed * seconds_per_minute)},
                       {"axis_speed_mm_min", by_axis(summary.max_axis_speed, seconds_per_minute)},
                       {"acceleration_mm_s2", by_axis(summary.max_acceleration, 1)},
                       {"jerk_mm_s3", by_axis(summary.max_jerk, 1)},
                       {"normal_acceleration_mm_s2", number(summary.max_normal_acceleration)}};
    json["path_deviation_mm"] = number(summary.path_deviation);
    json["limits_ok"] = summary.limits_ok;
    Json points, shares;
    for (std::size_t i = 0; i < summary.limited_by.size(); ++i) {
        const std::string rule(name_of(static_cast<LimitingFactor>(i)));
        points[rule] = summary.limited_by[i];
        shares[rule] =
            number(100.0 * static_cast<double>(summary.limited_by[i]) / static_cast<double>(summary.points), 3);
    }
    json["points_ruled_by"] = std::move(points);
    json["limit_share"] = std::move(shares);
    return json;
}

}  // namespace

std::string simulation_json(const SimulationSummary& summary, const Diagnostics& diagnostics,
                            const std::optional<Fidelity>& fidelity) {
    Json json = json_of(summary);
    json["fidelity"] = fidelity_json(fidelity);
    json["diagnostics"] = list(diagnostics);
    return dump(json);
}

std::string simulation_json(const FiveAxisSummary& summary, const Kinematics& kinematics,
                            const Diagnostics& diagnostics, const std::optional<Fidelity>& fidelity) {
    Json json = json_of(summary.run);
    const std::array<std::string, 2> letters{std::string(1, kinematics.tilt.letter),
                                             std::string(1, kinematics.rotation.letter)};
    for (std::size_t k = 0; k < 2; ++k) {
        json["max"]["axis_speed_mm_min"][letters[k]] = number(summary.max_speed[k] * seconds_per_minute * deg_per_rad);
        json["max"]["acceleration_mm_s2"][letters[k]] = number(summary.max_acceleration[k] * deg_per_rad);
        json["max"]["jerk_mm_s3"][letters[k]] = number(summary.max_jerk[k] * deg_per_rad);
    }
    json["orientation_error_deg"] = number(summary.orientation_error * deg_per_rad);
    json["rounds"] = summary.rounds;
    json["fidelity"] = fidelity_json(fidelity);
    json["diagnostics"] = list(diagnostics);
    return dump(json);
}

}  // namespace clsurf::io
