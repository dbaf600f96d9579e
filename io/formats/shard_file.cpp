#include "io/formats/shard_file.h"

#include <bit>
#include <cstdint>

#include "core/error.h"
#include "io/files/json_value.h"

namespace clsurf::io {
namespace {

constexpr const char* shard_hint = "clsurf check part.nc run.biip --survey run.survey --shard 1/8 -o shard1.json";

}  // namespace

std::string shard_json(const ShardFindings& findings, const ShardNumber& shard, const SurveyOrigin& origin,
                       const std::string& settings) {
    Json json;
    json["kind"] = "shard";
    json["shard"] = {shard.number, shard.count};
    json["log"] = origin.log_sha256;
    json["program"] = origin.program_sha256;
    json["options"] = origin.options;
    json["settings"] = settings;
    json["points"] = {findings.points.first, findings.points.last};
    json["compared"] = findings.compared;
    json["candidates"] = findings.starts;
    // As their bits: the merged report must not depend on how numbers are written.
    Json scallops = Json::array();
    for (const double height : findings.scallops) scallops.push_back(std::bit_cast<std::uint64_t>(height));
    json["scallop_bits"] = scallops;
    Json report;
    report["schema_version"] = schema_version;
    report.update(json);
    return dump_compact(report) + "\n";
}

ShardFindings read_shard(const std::string& path, const SurveyOrigin& origin, const std::string& settings) {
    const Source source = map_file(path);
    const auto fail = [&](const std::string& what) -> void {
        throw InputError(Place::of_file(path), what, shard_hint);
    };
    // It is ours, and may be large: its keys are few.
    const nlohmann::json json = nlohmann::json::parse(source.text(), nullptr, false);
    if (!json.is_object() || json.value("kind", "") != "shard") fail("is not what clsurf check --shard writes");
    ShardFindings findings;
    try {
        const SurveyOrigin own{json.at("log").get<std::string>(), json.at("program").get<std::string>(),
                               json.at("options").get<std::string>()};
        if (own != origin) fail("is a shard of another log or program, or was judged with other options");
        if (json.at("settings").get<std::string>() != settings)
            fail("was judged with " + json.at("settings").get<std::string>() + ", not with " + settings);
        findings.points = {json.at("points").at(0).get<PointIndex>(), json.at("points").at(1).get<PointIndex>()};
        findings.compared = json.at("compared").get<PointIndex>();
        findings.starts = json.at("candidates").get<std::vector<PointIndex>>();
        for (const auto& bits : json.at("scallop_bits"))
            findings.scallops.push_back(std::bit_cast<double>(bits.get<std::uint64_t>()));
    } catch (const nlohmann::json::exception&) { fail("is cut or damaged"); }
    for (const PointIndex start : findings.starts) {
        if (start < findings.points.first || start > findings.points.last)
            fail("is damaged: a point lies outside of it");
    }
    return findings;
}

}  // namespace clsurf::io
