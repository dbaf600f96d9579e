#include "io/modbus/modbus_recording.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "io/files/json_value.h"
#include "io/files/utc.h"
#include "io/formats/biip.h"
#include "io/modbus/modbus_link.h"

namespace clsurf::io {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double save_period = 1;      // [s] longest recording time lost if the program is killed
constexpr double stop_latency = 0.05;  // [s] time within which a stop is noticed
constexpr int illegal_function = 1, illegal_address = 2;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

class Recorder {
public:
    Recorder(const ModbusAddress& address, const std::vector<RegisterChannel>& channels, const RecordingRules& rules)
        : address_(address),
          channels_(channels),
          rules_(rules),
          blocks_(blocks_of(channels)),
          link_(address, rules.timeout) {
        recording_.gaps.resize(channels.size());
    }

    Recording run(const std::string& output);

private:
    /// Requests all blocks. False: stopped.
    bool poll();
    void read_block(const RegisterBlock& block);
    void count(const ModbusReply& reply, const RegisterBlock& block);
    /// Throws the error of a first poll without values: wrong address or map.
    void check_first_poll() const;
    void append(BiipWriter& writer, double time);
    /// Waits until `time` of the recording; false: stopped.
    [[nodiscard]] bool wait_until(double time) const;
    [[nodiscard]] bool stopped() const { return rules_.stopped && rules_.stopped(); }
    [[nodiscard]] std::string metadata() const;
    [[nodiscard]] BiipWriter open(const std::string& output) const;

    const ModbusAddress& address_;
    const std::vector<RegisterChannel>& channels_;
    const RecordingRules& rules_;
    std::vector<RegisterBlock> blocks_;
    ModbusLink link_;
    Clock::time_point start_;
    std::array<std::uint16_t, std::size_t{most_registers}> words_{};
    std::vector<double> values_;  ///< time, and the channels
    double last_answer_ = 0;      ///< [s]
    const RegisterBlock* refused_ = nullptr;
    ModbusReply refusal_;
    bool cannot_connect_ = false;  ///< in the present poll
    Recording recording_;
};

bool Recorder::poll() {
    values_.assign(channels_.size() + 1, std::numeric_limits<double>::quiet_NaN());
    cannot_connect_ = false;
    for (const RegisterBlock& block : blocks_) {
        if (&block != blocks_.data() && stopped()) return false;
        read_block(block);
    }
    return true;
}

void Recorder::read_block(const RegisterBlock& block) {
    // One attempt to connect per record: for a device that is off, each attempt costs the timeout.
    if (!link_.connected() && !cannot_connect_) {
        if (std::string why = link_.connect(); !why.empty()) {
            cannot_connect_ = true;
            recording_.reason = std::move(why);
        }
    }
    ++recording_.requests;
    if (cannot_connect_) {
        ++recording_.disconnected;
        return;
    }
    const Clock::time_point asked = Clock::now();
    const ModbusReply reply = link_.read(block, words_);
    if (reply.answer != ModbusAnswer::values) {
        count(reply, block);
        return;
    }
    recording_.longest_answer = std::max(recording_.longest_answer, seconds_since(asked));
    last_answer_ = seconds_since(start_);
    for (const std::size_t c : block.channels) {
        const double value = channels_[c].value(
            std::span(words_).subspan(static_cast<std::size_t>(channels_[c].address - block.address)));
        if (std::isfinite(value)) values_[c + 1] = value;
    }
}

void Recorder::count(const ModbusReply& reply, const RegisterBlock& block) {
    recording_.reason = reply.reason;
    switch (reply.answer) {
        case ModbusAnswer::values: break;
        case ModbusAnswer::late: ++recording_.late; break;
        case ModbusAnswer::damaged: ++recording_.damaged; break;
        case ModbusAnswer::disconnected: ++recording_.disconnected; break;
        case ModbusAnswer::exception:
            ++recording_.exceptions;
            last_answer_ = seconds_since(start_);  // the device has answered
            refused_ = &block;
            refusal_ = reply;
            break;
    }
}

void Recorder::check_first_poll() const {
    if (cannot_connect_) throw SystemError(fmt::format("cannot connect to {}: {}", address_.text, recording_.reason));
    if (refused_ != nullptr && (refusal_.exception == illegal_function || refusal_.exception == illegal_address)) {
        const RegisterChannel& channel = channels_[refused_->channels.front()];
        throw InputError(channel.where,
                         fmt::format("slave {} refuses {} registers {} … {}: exception {}, {}", refused_->slave,
                                     name_of(refused_->function), refused_->address,
                                     refused_->address + refused_->count - 1, refusal_.exception, refusal_.reason),
                         "addresses count from 0: a manual that writes 40001 means holding register 0");
    }
    if (recording_.answered() == 0 && recording_.exceptions == 0) {
        throw SystemError(
            fmt::format("{}: slave {} does not answer: {}", address_.text, blocks_.front().slave, recording_.reason));
    }
}

void Recorder::append(BiipWriter& writer, double time) {
    values_[0] = time;
    for (std::size_t c = 0; c < channels_.size(); ++c) recording_.gaps[c] += std::isnan(values_[c + 1]) ? 1 : 0;
    writer.append(std::as_bytes(std::span(values_)));
    ++recording_.records;
    recording_.duration = time;
}

bool Recorder::wait_until(double time) const {
    for (double left = time - seconds_since(start_); left > 0; left = time - seconds_since(start_)) {
        if (stopped()) return false;
        std::this_thread::sleep_for(std::chrono::duration<double>(std::min(left, stop_latency)));
    }
    return !stopped();
}

std::string Recorder::metadata() const {
    Json registers = Json::array();
    for (const RegisterChannel& c : channels_) {
        Json entry{{"name", c.name},
                   {"slave", c.slave},
                   {"function", name_of(c.function)},
                   {"address", c.address},
                   {"type", name_of(c.type)}};
        if (c.registers() > 1) entry["order"] = name_of(c.order);
        entry["scale"] = c.scale;
        entry["bias"] = c.bias;
        registers.push_back(std::move(entry));
    }
    return dump_compact(
        Json{{"recorded", recording_.started}, {"modbus", Json{{"address", address_.text}, {"registers", registers}}}});
}

BiipWriter Recorder::open(const std::string& output) const {
    std::vector<StoredChannel> stored{{"time", "s", ScalarType::f64, 1.0}};
    for (const RegisterChannel& c : channels_) stored.push_back({c.name, c.unit, ScalarType::f64, 1.0});
    return BiipWriter(output, stored, 1 / rules_.rate, metadata(), Unfinished::stays);
}

Recording Recorder::run(const std::string& output) {
    start_ = Clock::now();
    recording_.started = utc_with_milliseconds(std::chrono::system_clock::now());
    (void)poll();
    check_first_poll();
    BiipWriter writer = open(output);
    append(writer, 0);
    const std::int64_t ticks = rules_.duration
                                   ? static_cast<std::int64_t>(std::ceil(*rules_.duration * rules_.rate - 1e-9))
                                   : std::numeric_limits<std::int64_t>::max();
    double saved = 0;
    for (std::int64_t tick = 1; tick < ticks; ++tick) {
        bool stop = !wait_until(static_cast<double>(tick) / rules_.rate);
        const double time = seconds_since(start_);
        const std::int64_t now = std::clamp(static_cast<std::int64_t>(time * rules_.rate), tick, ticks);
        if (!stop) recording_.missed_records += now - std::exchange(tick, now);
        if (tick == ticks) break;
        stop = stop || !poll();
        if (stop) {
            recording_.end = RecordingEnd::stopped;
            break;
        }
        append(writer, time);
        const double done = seconds_since(start_);
        if (done - saved >= save_period) {
            writer.save();
            saved = done;
        }
        if (rules_.progress && rules_.duration) rules_.progress("recording", time / *rules_.duration);
        if (done - last_answer_ > rules_.patience) {
            recording_.end = RecordingEnd::disconnected;
            break;
        }
    }
    writer.close();
    return std::move(recording_);
}

}  // namespace

std::string_view name_of(RecordingEnd end) {
    switch (end) {
        case RecordingEnd::duration: return "duration";
        case RecordingEnd::stopped: return "stopped";
        case RecordingEnd::disconnected: return "disconnected";
    }
    return "duration";
}

Recording record_modbus(const ModbusAddress& address, const std::vector<RegisterChannel>& channels,
                        const RecordingRules& rules, const std::string& output) {
    return Recorder(address, channels, rules).run(output);
}

}  // namespace clsurf::io
