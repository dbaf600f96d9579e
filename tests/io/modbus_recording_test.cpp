// Recordings from the server of libmodbus and from one that truncates and exchanges frames.

#include "io/modbus/modbus_recording.h"

#include <arpa/inet.h>

#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"
#include "io/formats/log_format.h"
#include "support/modbus_server.h"
#include "support/temporary_folder.h"

namespace clsurf::io::modbus_recording_test {
namespace {

using test::ModbusServer;
using test::Reaction;

const std::set<int> reading{3, 4};

RegisterChannel channel(const std::string& name, RegisterFunction function, int address) {
    RegisterChannel result;
    result.name = name;
    result.function = function;
    result.address = address;
    return result;
}

/// The number of the request, and a register of the other function.
std::vector<RegisterChannel> two_channels() {
    return {channel("count", RegisterFunction::holding, 0), channel("load", RegisterFunction::input, 5)};
}
std::vector<RegisterChannel> one_channel() { return {channel("count", RegisterFunction::holding, 0)}; }

RecordingRules rules(double rate, double duration, double timeout = 0.1) {
    RecordingRules result;
    result.rate = rate;
    result.duration = duration;
    result.timeout = timeout;
    result.patience = 20;
    return result;
}

struct Recorded {
    Recording recording;
    Log log;

    [[nodiscard]] std::vector<double> values(const std::string& name) const {
        std::vector<double> result(static_cast<std::size_t>(log.records));
        copy_block(log.find(name)->values, 0, result);
        return result;
    }
};

class ModbusRecording : public ::testing::Test {
protected:
    Recorded record(const std::string& address, const std::vector<RegisterChannel>& channels,
                    const RecordingRules& how) {
        const std::string path = folder_ / "run.biip";
        Recording recording = record_modbus(parse_modbus_address(address), channels, how, path);
        EXPECT_EQ(folder_.files(), 1u);
        Recorded result{std::move(recording), open_log(path, {})};
        EXPECT_TRUE(result.log.closed);
        EXPECT_EQ(result.log.records, result.recording.records);
        return result;
    }
    test::TemporaryFolder folder_;
};

/// Each record has the number of its own request or none, and the numbers increase: no answer counts for another request.
void expect_rising(const std::vector<double>& counts) {
    double last = 0;
    for (const double count : counts) {
        if (std::isnan(count)) continue;
        EXPECT_GT(count, last);
        last = count;
    }
}

TEST_F(ModbusRecording, HasTheValuesOfTheDeviceOverTcp) {
    ModbusServer server(ModbusServer::Line::tcp);
    server.input()[8] = 0x47F1;  // 123456 as a float
    server.input()[9] = 0x2000;
    server.input()[10] = 0xFFFE;
    server.start();
    std::vector<RegisterChannel> channels = two_channels();
    channels.push_back(channel("force", RegisterFunction::input, 8));
    channels.back().type = RegisterType::f32;
    channels.back().unit = "N";
    channels.push_back(channel("temperature", RegisterFunction::input, 10));
    channels.back().type = RegisterType::i16;
    channels.back().scale = 0.1;
    channels.back().bias = 20;
    const Recorded run = record(server.address(), channels, rules(50, 0.2, 2));
    EXPECT_EQ(run.recording.end, RecordingEnd::duration);
    EXPECT_EQ(run.recording.records + run.recording.missed_records, 10);
    EXPECT_EQ(run.recording.requests, run.recording.answered());
    EXPECT_EQ(run.recording.requests, server.requests());
    EXPECT_EQ(run.log.period, 0.02);
    EXPECT_EQ(run.log.find("force")->unit, "N");
    const std::vector<double> times = run.values("time");
    EXPECT_EQ(times[0], 0);
    for (std::size_t i = 1; i < times.size(); ++i) EXPECT_GT(times[i], times[i - 1]);
    for (const double load : run.values("load")) EXPECT_EQ(load, 1005);
    for (const double force : run.values("force")) EXPECT_EQ(force, 123456);
    for (const double t : run.values("temperature")) EXPECT_DOUBLE_EQ(t, 19.8);
    expect_rising(run.values("count"));
    EXPECT_EQ(server.functions(), reading);
    EXPECT_NE(run.log.metadata.find("\"recorded\":\"" + run.recording.started), std::string::npos);
}

TEST_F(ModbusRecording, HasTheValuesOfTheDeviceOverASerialLine) {
    ModbusServer server(ModbusServer::Line::serial);
    server.start();
    const Recorded run = record(server.address(), two_channels(), rules(20, 0.3, 2));
    EXPECT_EQ(run.recording.requests, run.recording.answered());
    EXPECT_GE(run.recording.records, 2);
    for (const double load : run.values("load")) EXPECT_EQ(load, 1005);
    expect_rising(run.values("count"));
    EXPECT_EQ(server.functions(), reading);
}

TEST_F(ModbusRecording, NeverTakesALateAnswerForALaterOne) {
    for (const auto line : {ModbusServer::Line::tcp, ModbusServer::Line::serial}) {
        ModbusServer server(line, [](int request) { return Reaction{request == 3 ? 0.6 : 0.0}; });
        server.start();
        const test::TemporaryFolder folder;
        const std::string path = folder / "run.biip";
        const Recording recording =
            record_modbus(parse_modbus_address(server.address()), one_channel(), rules(10, 2.2, 0.4), path);
        const Log log = open_log(path, {});
        std::vector<double> counts(static_cast<std::size_t>(log.records));
        copy_block(log.find("count")->values, 0, counts);
        EXPECT_GE(recording.late, 1);
        EXPECT_EQ(recording.gaps[0], recording.late + recording.damaged);
        EXPECT_EQ(std::count(counts.begin(), counts.end(), 3.0), 0);
        EXPECT_GT(counts.back(), 3);
        expect_rising(counts);
    }
}

TEST_F(ModbusRecording, MakesGapsOfExceptionsAndSilence) {
    ModbusServer server(ModbusServer::Line::tcp, [](int request) {
        if (request == 4) return Reaction{0, MODBUS_EXCEPTION_SLAVE_OR_SERVER_BUSY};
        return Reaction{0, 0, request == 6};
    });
    server.start();
    const Recorded run = record(server.address(), one_channel(), rules(20, 1.6, 1));
    EXPECT_EQ(run.recording.exceptions, 1);
    EXPECT_EQ(run.recording.late, 1);
    EXPECT_EQ(run.recording.gaps[0], 2);
    const std::vector<double> counts = run.values("count");
    EXPECT_TRUE(std::isnan(counts[3]));
    EXPECT_EQ(counts[4], 5);
    EXPECT_TRUE(std::isnan(counts[5]));
    EXPECT_EQ(server.functions(), std::set<int>{3});
}

TEST_F(ModbusRecording, ConnectsAgainAfterADisconnection) {
    ModbusServer server(ModbusServer::Line::tcp, [](int request) { return Reaction{0, 0, false, request == 4}; });
    server.start();
    const Recorded run = record(server.address(), one_channel(), rules(20, 0.6, 1));
    EXPECT_EQ(run.recording.disconnected, 1);
    EXPECT_EQ(run.recording.gaps[0], 1);
    EXPECT_TRUE(std::isnan(run.values("count")[3]));
    EXPECT_EQ(run.values("count")[4], 5);
}

TEST_F(ModbusRecording, EndsWithAWholeLogWhenTheDeviceIsGone) {
    ModbusServer server(ModbusServer::Line::tcp);
    server.start();
    RecordingRules how = rules(20, 20, 1);
    how.patience = 1;
    bool gone = false;
    how.progress = [&](std::string_view, double) {
        if (!gone && server.requests() >= 5) server.stop(), gone = true;
    };
    const Recorded run = record(server.address(), one_channel(), how);
    EXPECT_EQ(run.recording.end, RecordingEnd::disconnected);
    EXPECT_FALSE(run.recording.reason.empty());
    EXPECT_GE(run.recording.disconnected, 2);
    EXPECT_GT(run.recording.records, 5);
    EXPECT_LT(run.recording.duration, 15);
}

TEST_F(ModbusRecording, EndsWhenItIsStopped) {
    ModbusServer server(ModbusServer::Line::tcp);
    server.start();
    RecordingRules how = rules(20, 20, 1);
    how.duration.reset();
    how.stopped = [&] { return server.requests() >= 4; };
    const Recorded run = record(server.address(), one_channel(), how);
    EXPECT_EQ(run.recording.end, RecordingEnd::stopped);
    EXPECT_EQ(run.recording.records, 4);
    EXPECT_EQ(run.values("count")[3], 4);
}

/// The files that a recording leaves in its folder if it cannot begin.
TEST_F(ModbusRecording, SaysWhyItDoesNotBegin) {
    const auto error_of = [&](const std::string& address, const std::vector<RegisterChannel>& channels) -> std::string {
        try {
            (void)record_modbus(parse_modbus_address(address), channels, rules(10, 1), folder_ / "run.biip");
        } catch (const std::exception& error) { return error.what(); }
        return "";
    };
    std::string address;
    {
        ModbusServer server(ModbusServer::Line::tcp, [](int request) { return Reaction{0, 0, request > 1}; });
        server.start();
        address = server.address();
        std::vector<RegisterChannel> beyond{channel("a1", RegisterFunction::holding, ModbusServer::registers)};
        beyond[0].where = Place::of_line("registers.toml", 7);
        EXPECT_NE(error_of(address, beyond)
                      .find("registers.toml:7: error: slave 1 refuses holding registers 64 … 64: "
                            "exception 2"),
                  std::string::npos)
            << error_of(address, beyond);
        EXPECT_NE(error_of(address, one_channel()).find("slave 1 does not answer: "), std::string::npos);
    }
    EXPECT_EQ(error_of(address, one_channel()), "cannot connect to " + address + ": Connection refused");
    EXPECT_NE(
        error_of("tcp:no.such.host.invalid:502", one_channel()).find("cannot connect to tcp:no.such.host.invalid"),
        std::string::npos);
    EXPECT_NE(error_of("rtu:" + (folder_ / "tty") + ",9600", one_channel()).find("No such file"), std::string::npos);
    EXPECT_EQ(folder_.files(), 0u);
}

TEST_F(ModbusRecording, DoesNotReplaceAnUnfinishedOne) {
    ModbusServer server(ModbusServer::Line::tcp);
    server.start();
    (void)folder_.write("run.biip.part", "what was recorded before");
    EXPECT_THROW((void)record_modbus(parse_modbus_address(server.address()), one_channel(), rules(20, 0.1, 1),
                                     folder_ / "run.biip"),
                 UsageError);
    EXPECT_EQ(test::read_file(folder_ / "run.biip.part"), "what was recorded before");
    EXPECT_EQ(folder_.files(), 1u);
}

/// A server of one function that builds its own frames: the value is the number of the request.
class RawServer {
public:
    /// `spoil` changes the answer to a request; returns how many bytes are sent at first, the rest follows after 0.5 s.
    explicit RawServer(std::function<std::size_t(int request, std::string& frame)> spoil) : spoil_(std::move(spoil)) {
        listener_ = ::socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in bound{};
        bound.sin_family = AF_INET;
        bound.sin_addr.s_addr = ::htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof bound;
        ::bind(listener_, reinterpret_cast<sockaddr*>(&bound), size);
        ::listen(listener_, 8);
        ::getsockname(listener_, reinterpret_cast<sockaddr*>(&bound), &size);
        address_ = "tcp:127.0.0.1:" + std::to_string(ntohs(bound.sin_port));
        thread_ = std::thread([this] { serve(); });
    }
    ~RawServer() {
        ::shutdown(listener_, SHUT_RDWR);
        thread_.join();
        ::close(listener_);
    }
    [[nodiscard]] const std::string& address() const { return address_; }

private:
    void serve() {
        for (int line = ::accept(listener_, nullptr, nullptr); line >= 0;
             line = ::accept(listener_, nullptr, nullptr)) {
            char query[12];
            while (::recv(line, query, sizeof query, MSG_WAITALL) == static_cast<ssize_t>(sizeof query)) {
                ++request_;
                std::string frame(query, 2);  // transaction
                frame += std::string({0, 0, 0, 5, query[6], query[7], 2, 0, static_cast<char>(request_)});
                const std::size_t first = spoil_(request_, frame);
                ::send(line, frame.data(), first, MSG_NOSIGNAL);
                if (first == frame.size()) continue;
                test::pause(0.5);
                ::send(line, frame.data() + first, frame.size() - first, MSG_NOSIGNAL);
            }
            ::close(line);
        }
    }

    std::function<std::size_t(int, std::string&)> spoil_;
    int listener_ = -1, request_ = 0;
    std::string address_;
    std::thread thread_;
};

TEST_F(ModbusRecording, MakesGapsOfFramesThatAreCut) {
    // Of 11 bytes; the first 6 are the header.
    RawServer server([](int request, std::string& frame) {
        return request == 3 ? std::size_t{4} : request == 5 ? std::size_t{9} : frame.size();
    });
    const Recorded run = record(server.address(), one_channel(), rules(10, 2.5, 0.3));
    EXPECT_GE(run.recording.late, 2);
    EXPECT_EQ(run.recording.gaps[0], run.recording.late + run.recording.damaged);
    const std::vector<double> counts = run.values("count");
    EXPECT_GT(counts.back(), 5);
    EXPECT_EQ(std::count(counts.begin(), counts.end(), 3.0), 0);
    EXPECT_EQ(std::count(counts.begin(), counts.end(), 5.0), 0);
    expect_rising(counts);
}

TEST_F(ModbusRecording, MakesGapsOfAnswersToOtherRequests) {
    RawServer server([](int request, std::string& frame) {
        if (request == 3) ++frame[1];                                   // another transaction
        if (request == 4) frame[7] = 4;                                 // another function
        if (request == 5) frame[8] = 4, frame[5] = 7, frame += "\1\2";  // two registers
        if (request == 6) ++frame[6];                                   // another unit behind a gateway
        return frame.size();
    });
    const Recorded run = record(server.address(), one_channel(), rules(20, 0.8, 1));
    EXPECT_EQ(run.recording.damaged, 4);
    EXPECT_EQ(run.recording.gaps[0], 4);
    const std::vector<double> counts = run.values("count");
    for (std::size_t i = 2; i < 6; ++i) EXPECT_TRUE(std::isnan(counts[i])) << i;
    EXPECT_EQ(counts[6], 7);
}

}  // namespace
}  // namespace clsurf::io::modbus_recording_test
