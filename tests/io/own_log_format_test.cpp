// A log format of another program: a row in the caller's own file, passed with the options.

#include <gtest/gtest.h>

#include <charconv>

#include "core/error.h"
#include "io/formats/log_format.h"
#include "io/formats/owned_columns.h"

namespace clsurf::io::own_log_format_test {
namespace {

/// "TRACE 0.002": the period; then lines of X Y Z in micrometres.
int probe_trace(std::span<const std::byte> head, const LogOptions&) {
    const std::string_view text(reinterpret_cast<const char*>(head.data()), head.size());
    return text.starts_with("TRACE ") ? 90 : 0;
}

Log open_trace(const Source& source, const LogOptions&) {
    std::vector<double> numbers;
    const std::string text(source.text().substr(6));
    for (const char* at = text.data(); at < text.data() + text.size();) {
        double value = 0;
        const auto [end, error] = std::from_chars(at, text.data() + text.size(), value);
        if (error == std::errc()) numbers.push_back(value);
        at = error == std::errc() ? end : at + 1;
    }
    Log log;
    log.name = source.name;
    log.format = "trace";
    log.period = numbers.front();
    log.records = static_cast<PointIndex>((numbers.size() - 1) / 3);
    OwnedColumns columns(log);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::vector<double> values;
        for (std::size_t i = 1 + axis; i < numbers.size(); i += 3) values.push_back(numbers[i]);
        columns.add(std::string("cmd.") + "xyz"[axis], "um", std::move(values));
    }
    return log;
}

constexpr LogFormat own_format{"trace", "a trace of a controller of our own", probe_trace, open_trace};

TEST(OwnLogFormat, IsOneRowThatTheOptionsName) {
    const std::string text = "TRACE 0.002\n0 0 500\n100 0 500\n200 50 500\n";
    const Source source{"run.trace", std::as_bytes(std::span(text)), nullptr};
    EXPECT_THROW((void)open_log(source, {}), InputError);
    LogOptions options;
    options.more_formats = std::span(&own_format, 1);
    ASSERT_EQ(recognise_log(source, options), &own_format);
    const Log log = open_log(source, options);
    EXPECT_EQ(log.format, "trace");
    EXPECT_EQ(log.records, 3);
    EXPECT_EQ(log.period, 0.002);
    EXPECT_NEAR(log.find("cmd.x")->values.at(2), 0.2, 1e-12) << "units are those of the channel's meaning: mm";
    EXPECT_EQ(log.find("cmd.x")->unit, "mm");
}

TEST(OwnLogFormat, IsNamedWhereNoFormatSuits) {
    const std::string text = "something else";
    LogOptions options;
    options.more_formats = std::span(&own_format, 1);
    try {
        (void)open_log(Source{"x", std::as_bytes(std::span(text)), nullptr}, options);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("delimited, trace)"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace clsurf::io::own_log_format_test
