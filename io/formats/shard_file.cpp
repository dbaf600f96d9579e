#include "io/formats/shard_file.h"

#include <bit>
#include <cstdint>
#include <stdexcept>

#include <fmt/format.h>

#include "core/error.h"
#include "io/files/json_value.h"
#include "io/formats/sealed_json.h"

namespace clsurf::io {
namespace {

constexpr const char* shard_hint = "clsurf check part.nc run.biip --survey run.survey --shard 1/8 -o shard1.json";

Json json_of(const Distribution& sizes) {
    Json numbers = Json::array(), counts = Json::array();
    for (const Distribution::Bin& bin : sizes.bins()) {
        numbers.push_back(bin.number);
        counts.push_back(bin.count);
    }
    return {{"bins", numbers}, {"counts", counts}, {"squares", sizes.squares().digits()}};
}

/// Throws Json::exception, std::out_of_range if it is not a distribution.
Distribution distribution_of(const nlohmann::json& json) {
    const auto& numbers = json.at("bins");
    std::vector<Distribution::Bin> bins;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        bins.push_back({numbers.at(k).get<std::uint32_t>(), json.at("counts").at(k).get<std::uint64_t>()});
        if (bins.back().number >= Distribution::bin_count) throw std::out_of_range("a bin of no float");
    }
    return {bins, SumOfSquares(json.at("squares").get<SumOfSquares::Digits>())};
}

}  // namespace

std::string shard_json(const ShardFindings& findings, const ShardNumber& shard, const SurveyOrigin& origin,
                       const std::string& settings) {
    Json json;
    json["kind"] = "shard";
    json["shard"] = {shard.number, shard.count};
    json.update(json_of(origin));
    json["settings"] = settings;
    json["points"] = {findings.points.first, findings.points.last};
    json["compared"] = {findings.compared.compared, findings.compared.away_from_ends};
    json["candidates"] = findings.starts;
    // Stored as bits, so that the merged report does not depend on the printing of numbers.
    Json scallops = Json::array();
    for (const double height : findings.scallops) scallops.push_back(std::bit_cast<std::uint64_t>(height));
    json["scallop_bits"] = scallops;
    json["speed_differences"] = json_of(findings.motion.mismatch);
    json["jerks"] = json_of(findings.motion.jerk);
    Json report;
    report["schema_version"] = schema_version;
    report.update(json);
    return sealed_json(report);
}

ShardFindings read_shard(const std::string& path, const SurveyOrigin& origin, const std::string& settings) {
    const Source source = map_file(path);
    const auto fail = [&](const std::string& what) -> void {
        throw InputError(Place::of_file(path), what, shard_hint);
    };
    // The file was written by clsurf and may be large: its objects have few keys, so they need no limit.
    const nlohmann::json json = nlohmann::json::parse(source.text(), nullptr, false);
    if (!json.is_object() || json.value("kind", "") != "shard") fail("is not what clsurf check --shard writes");
    if (!is_sealed_json(source.text())) fail("is cut or damaged: its checksum differs");
    ShardFindings findings;
    try {
        if (origin_of(json) != origin) fail("is a shard of another log or program, or was judged with other options");
        if (json.at("settings").get<std::string>() != settings)
            fail("was judged with " + json.at("settings").get<std::string>() + ", not with " + settings);
        findings.points = {json.at("points").at(0).get<PointIndex>(), json.at("points").at(1).get<PointIndex>()};
        findings.compared.compared = json.at("compared").at(0).get<PointIndex>();
        findings.compared.away_from_ends = json.at("compared").at(1).get<PointIndex>();
        findings.starts = json.at("candidates").get<std::vector<PointIndex>>();
        for (const auto& bits : json.at("scallop_bits"))
            findings.scallops.push_back(std::bit_cast<double>(bits.get<std::uint64_t>()));
        findings.motion = {distribution_of(json.at("speed_differences")), distribution_of(json.at("jerks"))};
    } catch (const nlohmann::json::exception&) { fail("is cut or damaged"); } catch (const std::out_of_range&) {
        fail("is damaged");
    }
    for (const PointIndex start : findings.starts) {
        if (start < findings.points.first || start > findings.points.last)
            fail("is damaged: a point lies outside of it");
    }
    return findings;
}

}  // namespace clsurf::io
