#include "io/formats/edge_recording.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.h"
#include "core/not_finite.h"
#include "io/files/json_value.h"

namespace clsurf::io {
namespace {

constexpr std::size_t most_levels = 32;  ///< levels; recordings have six

Place place_of(const Source& source, std::size_t byte) {
    const std::string_view before = source.text().substr(0, byte);
    const auto line = static_cast<std::uint64_t>(std::count(before.begin(), before.end(), '\n')) + 1;
    const std::size_t begin = before.rfind('\n');
    return Place::of_line(
        source.name, line,
        static_cast<std::uint32_t>(before.size() - (begin == std::string_view::npos ? 0 : begin + 1) + 1));
}

/// Handles the parser's events, which are distinguished by the enclosing keys: "Payload/HFData" is a list of rows.
class RecordingReader : public nlohmann::json_sax<Json> {
public:
    explicit RecordingReader(const Source& source) : source_(source) {}

    EdgeRecording read() {
        Json::sax_parse(source_.text(), this);
        if (!seen_payload_ && recording.closed)
            throw InputError(Place::of_file(source_.name), "has no 'Payload', expected a SINUMERIK Edge recording");
        recording.about = dump_compact({{"machine", machine_}, {"started", started_}});
        return std::move(recording);
    }

    bool null() override { return number(missing<double>); }
    bool boolean(bool) override { return true; }
    bool number_integer(number_integer_t value) override { return number(static_cast<double>(value)); }
    bool number_unsigned(number_unsigned_t value) override { return number(static_cast<double>(value)); }
    bool number_float(number_float_t value, const string_t&) override { return number(value); }
    bool binary(binary_t&) override { return true; }

    bool string(string_t& text) override {
        if (in_row_) {
            row_.push_back(missing<double>);
        } else if (in_signal_) {
            if (key_ == "Name")
                recording.signals.back().name = std::move(text);
            else if (key_ == "Axis")
                recording.signals.back().axis = std::move(text);
        } else if (event_depth_ != 0) {
            if (key_ == "Path") recording.events.back().path = std::move(text);
        } else if (key_ == "MachineName") {
            machine_ = std::move(text);
        } else if ((key_ == "Time" && inside("Initial")) || (key_ == "TimeStamp" && started_.empty())) {
            started_ = std::move(text);
        }
        return true;
    }

    bool start_object(std::size_t) override {
        if (below("SignalListHFData")) {
            in_signal_ = true;
            if (!recording.columns.empty())
                throw InputError(Place::of_file(source_.name),
                                 "SignalListHFData continues after the first row of HFData");
            recording.signals.emplace_back();
        } else if (below("HFBlockEvent") || below("HFCallEvent")) {
            event_depth_ = keys_.size() + 1;
            recording.events.emplace_back();
            recording.events.back().call = below("HFCallEvent");
        }
        return push();
    }
    bool end_object() override {
        if (keys_.size() == event_depth_) event_depth_ = 0;
        in_signal_ = false;
        return pop();
    }
    bool key(string_t& text) override {
        key_ = text;
        if (!keys_.empty()) keys_.back() = text;
        return true;
    }
    bool start_array(std::size_t) override {
        if (below("Payload")) seen_payload_ = true;
        // Rows are arrays inside the array HFData.
        if (below("HFData") && in_list_) {
            in_row_ = true;
            row_.clear();
        }
        in_list_ = below("HFData");
        const bool go_on = push();
        if (!keys_.empty()) keys_.back() = keys_.size() > 1 ? keys_[keys_.size() - 2] : std::string();
        return go_on;
    }
    bool end_array() override {
        if (in_row_) {
            in_row_ = false;
            add_row();
            in_list_ = true;
            keys_.pop_back();
            return true;
        }
        in_list_ = false;
        return pop();
    }

    bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& error) override {
        const std::size_t at = std::min(position > 0 ? position - 1 : 0, source_.bytes.size());
        if (position > source_.bytes.size() && seen_payload_ && recording.rows > 0) {
            recording.closed = false;
            recording.diagnostics.add(
                {Severity::warning,
                 "log.unclosed",
                 place_of(source_, at),
                 fmt::format("the recording is incomplete and ends here; {} complete records were read",
                             recording.rows),
                 {}});
            return false;
        }
        // "[json.exception.parse_error.101] parse error at line 3, column 5: syntax error while …"
        std::string what = error.what();
        if (const std::size_t colon = what.find(": "); colon != std::string::npos) what = what.substr(colon + 2);
        throw InputError(place_of(source_, at), "is not valid JSON: " + what.substr(0, 200));
    }

    EdgeRecording recording;

private:
    /// Whether the value that begins now belongs to this key. keys_ has the latest key of each open object,
    /// and for each open array the key that it belongs to.
    [[nodiscard]] bool below(std::string_view key) const { return !keys_.empty() && keys_.back() == key; }

    /// Whether the open object belongs to this key.
    [[nodiscard]] bool inside(std::string_view key) const { return keys_.size() > 1 && keys_[keys_.size() - 2] == key; }

    bool push() {
        if (keys_.size() == most_levels)
            throw InputError(Place::of_file(source_.name),
                             fmt::format("JSON nested deeper than {} levels", most_levels));
        keys_.emplace_back();
        return true;
    }
    bool pop() {
        keys_.pop_back();
        key_ = keys_.empty() ? std::string() : keys_.back();
        return true;
    }

    bool number(double value) {
        if (in_row_) {
            row_.push_back(value);
        } else if (event_depth_ != 0 && keys_.size() == event_depth_) {
            EdgeEvent& event = recording.events.back();
            if (key_ == "HFProbeCounter")
                event.cycle = whole(value);
            else if (key_ == "SeekOffset")
                event.line = whole(value);
            else if (key_ == "CallStackLevel")
                event.level = whole(value);
        } else if (key_ == "CycleTimeMs") {
            recording.cycle_ms = value;
        }
        return true;
    }

    /// −1 if it is not an integer that a double represents exactly.
    static std::int64_t whole(double value) {
        constexpr double most = 9e15;
        return value >= 0 && value <= most ? static_cast<std::int64_t>(value) : -1;
    }

    void add_row() {
        if (recording.signals.empty())
            throw InputError(Place::of_file(source_.name), "HFData come before the header's SignalListHFData");
        recording.columns.resize(recording.signals.size());
        ++rows_seen_;
        if (row_.size() != recording.signals.size()) {
            // The row is left out: which signals are missing is unknown.
            recording.diagnostics.add({Severity::warning,
                                       "log.ragged-row",
                                       Place::of_file(source_.name),
                                       fmt::format("row {} of HFData has {} values, expected {}; it is left out",
                                                   rows_seen_, row_.size(), recording.signals.size()),
                                       {}});
            return;
        }
        for (std::size_t i = 0; i < row_.size(); ++i) recording.columns[i].push_back(row_[i]);
        ++recording.rows;
    }

    const Source& source_;
    std::vector<std::string> keys_;
    std::string key_;
    std::string machine_;  ///< MachineName
    std::string started_;  ///< Initial.Time, otherwise TimeStamp
    std::vector<double> row_;
    std::size_t rows_seen_ = 0;
    std::size_t event_depth_ = 0;  ///< size of keys_ inside the event; 0: not in an event
    bool in_signal_ = false;
    bool in_list_ = false;  ///< the array HFData is open, but none of its rows
    bool in_row_ = false;
    bool seen_payload_ = false;
};

}  // namespace

EdgeRecording read_edge_recording(const Source& source) { return RecordingReader(source).read(); }

}  // namespace clsurf::io
