#include "io/simulated_log.h"

#include <cstring>

#include "core/units.h"
#include "io/json_value.h"

namespace clsurf::io {
namespace {

const std::vector<StoredChannel>& channels() {
    static const std::vector<StoredChannel> list{
        {"cmd.x", "mm", ScalarType::f64, 1.0}, {"cmd.y", "mm", ScalarType::f64, 1.0}, {"cmd.z", "mm", ScalarType::f64, 1.0},
        {"fb.x", "mm", ScalarType::f64, 1.0},  {"fb.y", "mm", ScalarType::f64, 1.0},  {"fb.z", "mm", ScalarType::f64, 1.0},
        {"speed", "mm/min", ScalarType::f64, 1.0}, {"line", "", ScalarType::u32, 1.0}, {"limit", "", ScalarType::u32, 1.0}};
    return list;
}

struct Record {
    double commanded[3], feedback[3], speed;
    std::uint32_t line, limit;
};

Json by_axis(const Vec3& v, double factor) {
    Json json;
    for (std::size_t i = 0; i < axis_names.size(); ++i) json[std::string(axis_names[i])] = number(v[static_cast<int>(i)] * factor);
    return json;
}

}  // namespace

SimulatedLogWriter::SimulatedLogWriter(const std::string& path, const Machine& machine, const std::string& metadata)
    : writer_(path, channels(), machine.controller.period, metadata) {}

void SimulatedLogWriter::append(std::span<const SimulatedPoint> points) {
    static_assert(sizeof(Record) == 7 * 8 + 2 * 4, "packed as the channels are");
    records_.resize(points.size() * sizeof(Record));
    for (std::size_t i = 0; i < points.size(); ++i) {
        const SimulatedPoint& p = points[i];
        const Record record{{p.commanded.x(), p.commanded.y(), p.commanded.z()}, {p.feedback.x(), p.feedback.y(), p.feedback.z()},
                            p.speed * seconds_per_minute, p.line, static_cast<std::uint32_t>(p.limit)};
        std::memcpy(records_.data() + i * sizeof(Record), &record, sizeof(Record));
    }
    writer_.append(std::as_bytes(std::span(records_)));
}

std::string simulation_json(const SimulationSummary& summary, const Diagnostics& diagnostics) {
    Json json{{"duration_s", number(summary.duration)}, {"points", summary.points}};
    json["max"] = Json{{"speed_mm_min", number(summary.max_speed * seconds_per_minute)},
                       {"axis_speed_mm_min", by_axis(summary.max_axis_speed, seconds_per_minute)},
                       {"acceleration_mm_s2", by_axis(summary.max_acceleration, 1)},
                       {"jerk_mm_s3", by_axis(summary.max_jerk, 1)}};
    json["path_deviation_mm"] = number(summary.path_deviation);
    json["limits_ok"] = summary.limits_ok;
    Json ruled;
    for (std::size_t i = 0; i < summary.ruled.size(); ++i) ruled[std::string(name_of(static_cast<Ruling>(i)))] = summary.ruled[i];
    json["points_ruled_by"] = ruled;
    json["diagnostics"] = list(diagnostics);
    return dump(json);
}

}  // namespace clsurf::io
