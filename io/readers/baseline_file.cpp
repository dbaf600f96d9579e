#include "io/readers/baseline_file.h"

#include "core/error.h"
#include "io/files/json_value.h"
#include "io/files/mapped_file.h"

namespace clsurf::io {
namespace {

/// Values that a report lacks or has in another form are read as missing.
class BaselineReader {
public:
    explicit BaselineReader(std::string path) : path_(std::move(path)) {}

    std::vector<RecordedDefect> read() {
        const Source source = map_file(path_);
        // Reports are written by clsurf and may be large: the keys are not bounded.
        const nlohmann::json json = nlohmann::json::parse(source.text(), nullptr, false);
        if (!json.is_object()) fail();
        if (json.contains("runs") && json["runs"].is_array()) {
            for (const auto& run : json["runs"]) add_sarif(run);
        } else if (json.contains("logs") && json["logs"].is_array()) {
            for (const auto& log : json["logs"]) add_json(log);
        } else {
            add_json(json);
        }
        return std::move(defects_);
    }

private:
    using Value = nlohmann::json;

    [[noreturn]] void fail() const {
        throw InputError(Place::of_file(path_), "is not a report of clsurf check in JSON or SARIF",
                         "clsurf check part.nc run.biip -o baseline.sarif");
    }

    template <typename T>
    static T value_of(const Value& object, const char* key, const T& otherwise) {
        const auto at = object.find(key);
        if (at == object.end()) return otherwise;
        if constexpr (std::is_same_v<T, std::string>) {
            return at->is_string() ? at->template get<std::string>() : otherwise;
        } else if constexpr (std::is_same_v<T, bool>) {
            return at->is_boolean() ? at->template get<bool>() : otherwise;
        } else {
            return at->is_number() ? at->template get<T>() : otherwise;
        }
    }

    static void add_place(const Value& object, RecordedDefect& defect) {
        const auto tip = object.find("tip_mm");
        if (tip == object.end() || !tip->is_array() || tip->size() != 3) return;
        for (std::size_t k = 0; k < 3; ++k)
            defect.tip[static_cast<Eigen::Index>(k)] = (*tip)[k].is_number() ? (*tip)[k].get<double>() : 0;
    }

    static void add_section(const Value& lines, RecordedDefect& defect) {
        if (!lines.is_array() || lines.size() != 2 || !lines[0].is_number_unsigned() || !lines[1].is_number_unsigned())
            return;
        defect.sections.push_back({0, lines[0].get<LineNumber>(), lines[1].get<LineNumber>()});
    }

    [[nodiscard]] RecordedDefect recorded(const Value& of) const {
        RecordedDefect defect;
        defect.cause = value_of<std::string>(of, "cause", "");
        if (defect.cause.empty()) fail();
        defect.severity = value_of(of, "severity", 1);
        defect.score = value_of(of, "score", 0.0);
        defect.systematic = value_of(of, "systematic", false);
        add_place(of, defect);
        const auto lines = of.find("lines");
        if (lines != of.end() && lines->is_array()) {
            for (const Value& pair : *lines) add_section(pair, defect);
        }
        return defect;
    }

    void add_json(const Value& report) {
        const auto list = report.find("defects");
        if (!report.is_object() || list == report.end() || !list->is_array()) fail();
        for (const Value& object : *list) defects_.push_back(recorded(object));
    }

    void add_sarif(const Value& run) {
        const Value* driver =
            run.is_object() && run.contains("tool") && run["tool"].is_object() && run["tool"].contains("driver")
                ? &run["tool"]["driver"]
                : nullptr;
        if (driver == nullptr || value_of<std::string>(*driver, "name", "") != "clsurf" || !run.contains("results") ||
            !run["results"].is_array())
            fail();
        for (const Value& result : run["results"]) {
            const auto properties = result.find("properties");
            // Results without a severity are about limits of the machine, or say that nothing was judged.
            if (properties == result.end() || !properties->is_object() || !properties->contains("severity")) continue;
            defects_.push_back(recorded(*properties));
        }
    }

    std::string path_;
    std::vector<RecordedDefect> defects_;
};

}  // namespace

std::vector<RecordedDefect> read_baseline(const std::string& path) { return BaselineReader(path).read(); }

}  // namespace clsurf::io
