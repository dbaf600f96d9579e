#include "io/modbus/register_map.h"

#include <array>

#include <gtest/gtest.h>

#include "core/error.h"
#include "io/modbus/modbus_address.h"
#include "support/temporary_folder.h"

namespace clsurf::io::register_map_test {
namespace {

double value(RegisterType type, ByteOrder order, std::array<std::uint16_t, 2> words, double scale = 1,
             double bias = 0) {
    RegisterChannel channel;
    channel.type = type;
    channel.order = order;
    channel.scale = scale;
    channel.bias = bias;
    return channel.value(words);
}

// 123456 = 1.8837890625 · 2^16: sign 0, exponent 143, fraction 0x712000: bytes 47 F1 20 00.
TEST(RegisterMap, ReadsNumbersInEveryOrderOfTheirBytes) {
    EXPECT_EQ(value(RegisterType::f32, ByteOrder::abcd, {0x47F1, 0x2000}), 123456);
    EXPECT_EQ(value(RegisterType::f32, ByteOrder::cdab, {0x2000, 0x47F1}), 123456);
    EXPECT_EQ(value(RegisterType::f32, ByteOrder::badc, {0xF147, 0x0020}), 123456);
    EXPECT_EQ(value(RegisterType::f32, ByteOrder::dcba, {0x0020, 0xF147}), 123456);
    EXPECT_EQ(value(RegisterType::u32, ByteOrder::abcd, {0xFFFF, 0xFFFE}), 4294967294.0);
    EXPECT_EQ(value(RegisterType::i32, ByteOrder::abcd, {0xFFFF, 0xFFFE}), -2);
    EXPECT_EQ(value(RegisterType::i32, ByteOrder::cdab, {0xFFFE, 0xFFFF}), -2);
    EXPECT_EQ(value(RegisterType::u16, ByteOrder::abcd, {0xFFFE, 0}), 65534);
    EXPECT_EQ(value(RegisterType::i16, ByteOrder::abcd, {0xFFFE, 0}), -2);
    EXPECT_EQ(value(RegisterType::i16, ByteOrder::abcd, {0xFFFE, 0}, 0.5, 20), 19);
}

std::string channel(const std::string& name, const std::string& rest) {
    return "[[channel]]\nname = \"" + name + "\"\n" + rest + "\n";
}
const std::string holding = "function = \"holding\"\ntype = \"u16\"\naddress = ";

std::vector<RegisterChannel> read(const std::string& text) {
    const test::TemporaryFolder folder;
    return read_register_map(folder.write("registers.toml", text));
}

std::string error_of(const std::string& text) {
    try {
        (void)read(text);
    } catch (const InputError& error) {
        return "line " + std::to_string(error.diagnostic().where.number) + ": " + error.diagnostic().text;
    }
    return "";
}

TEST(RegisterMap, ReadsEveryKey) {
    const std::vector<RegisterChannel> channels =
        read("slave = 3\n" + channel("spindle.load", "unit = \"%\"\n" + holding + "100\nscale = 0.1\nbias = -4") +
             channel("temperature", "function = \"input\"\ntype = \"f32\"\norder = \"cdab\"\naddress = 7\nslave = 9"));
    ASSERT_EQ(channels.size(), 2u);
    EXPECT_EQ(channels[0].name, "spindle.load");
    EXPECT_EQ(channels[0].unit, "%");
    EXPECT_EQ(channels[0].function, RegisterFunction::holding);
    EXPECT_EQ(channels[0].address, 100);
    EXPECT_EQ(channels[0].scale, 0.1);
    EXPECT_EQ(channels[0].bias, -4);
    EXPECT_EQ(channels[0].slave, 3);
    EXPECT_EQ(channels[1].function, RegisterFunction::input);
    EXPECT_EQ(channels[1].type, RegisterType::f32);
    EXPECT_EQ(channels[1].order, ByteOrder::cdab);
    EXPECT_EQ(channels[1].slave, 9);
}

TEST(RegisterMap, RefusesWhatItCannotMeanWithItsLine) {
    const std::string good = channel("a1", holding + "5");
    EXPECT_EQ(error_of(good), "");
    EXPECT_NE(error_of("").find("no [[channel]]"), std::string::npos);
    EXPECT_EQ(error_of(good + channel("a1", holding + "6")), "line 6: channel 'a1' appears twice");
    EXPECT_EQ(error_of(channel("a1", "function = \"coil\"\ntype = \"u16\"\naddress = 1")),
              "line 3: 'function' is 'coil', not one of holding, input");
    EXPECT_EQ(error_of(channel("a1", "function = \"holding\"\ntype = \"u8\"\naddress = 1")),
              "line 4: 'type' is 'u8', not one of u16, i16, u32, i32, f32");
    EXPECT_NE(error_of(channel("a1", "function = \"holding\"\ntype = \"u16\"")).find("without 'address'"),
              std::string::npos);
    EXPECT_NE(error_of(channel("a1", holding + "70000")), "");
    EXPECT_NE(error_of(channel("a1", "function = \"holding\"\ntype = \"u32\"\naddress = 65535")), "");
    EXPECT_NE(error_of(channel("a1", holding + "1\norder = \"cdab\"")), "");
    EXPECT_NE(error_of(channel("a1", holding + "1\nslave = 250")), "");
    EXPECT_NE(error_of(channel("a1", holding + "1\noffset = 2")).find("unknown key 'offset'"), std::string::npos);
    EXPECT_NE(error_of(channel("a name that is longer than 23", holding + "1")), "");
    EXPECT_NE(error_of(channel("a1", "unit = \"a long unit\"\n" + holding + "1")), "");
    for (const std::string name : {"time", "line", "cmd.x", "act.c", "X"})
        EXPECT_NE(error_of(channel(name, holding + "1")).find("cannot come from Modbus"), std::string::npos) << name;
}

TEST(RegisterMap, AsksForAdjacentRegistersTogether) {
    const auto blocks = blocks_of(
        read(channel("a1", holding + "10") + channel("b1", "function = \"holding\"\ntype = \"f32\"\naddress = 8") +
             channel("c1", holding + "12") + channel("d1", "function = \"input\"\ntype = \"u16\"\naddress = 11") +
             channel("e1", holding + "10\nslave = 2")));
    ASSERT_EQ(blocks.size(), 4u);
    EXPECT_EQ(blocks[0].address, 8);  // b1 and a1; register 11 belongs to nobody
    EXPECT_EQ(blocks[0].count, 3);
    EXPECT_EQ(blocks[0].channels, (std::vector<std::size_t>{1, 0}));
    EXPECT_EQ(blocks[1].address, 12);
    EXPECT_EQ(blocks[2].function, RegisterFunction::input);
    EXPECT_EQ(blocks[3].slave, 2);
}

TEST(RegisterMap, AsksForNoMoreThanAnAnswerHolds) {
    std::string text;
    for (int k = 0; k < 130; ++k) text += channel("r" + std::to_string(k), holding + std::to_string(k));
    const auto blocks = blocks_of(read(text));
    ASSERT_EQ(blocks.size(), 2u);
    EXPECT_EQ(blocks[0].count, 125);
    EXPECT_EQ(blocks[1].address, 125);
    EXPECT_EQ(blocks[1].count, 5);
}

TEST(ModbusAddress, HasTheFormsOfItsPage) {
    const ModbusAddress tcp = parse_modbus_address("tcp:plc.local:1502");
    EXPECT_FALSE(tcp.serial);
    EXPECT_EQ(tcp.host, "plc.local");
    EXPECT_EQ(tcp.port, "1502");
    EXPECT_EQ(parse_modbus_address("tcp:10.0.0.1").port, "502");
    const ModbusAddress six = parse_modbus_address("tcp:[::1]:1502");
    EXPECT_EQ(six.host, "::1");
    EXPECT_EQ(six.port, "1502");
    EXPECT_EQ(parse_modbus_address("tcp:[::1]").port, "502");
    const ModbusAddress rtu = parse_modbus_address("rtu:/dev/ttyUSB0,9600");
    EXPECT_TRUE(rtu.serial);
    EXPECT_EQ(rtu.device, "/dev/ttyUSB0");
    EXPECT_EQ(rtu.baud, 9600);
    EXPECT_EQ(rtu.parity, 'E');
    EXPECT_EQ(rtu.stop_bits, 1);
    EXPECT_EQ(parse_modbus_address("rtu:COM,9600,8N2").stop_bits, 2);
    for (const char* wrong : {"plc", "udp:plc:502", "tcp:", "tcp::502", "tcp:plc:0", "tcp:plc:x", "tcp:[::1]502",
                              "rtu:", "rtu:/dev/x", "rtu:/dev/x,9601", "rtu:/dev/x,9600,7E1", "rtu:/dev/x,9600,8X1"})
        EXPECT_THROW((void)parse_modbus_address(wrong), UsageError) << wrong;
}

}  // namespace
}  // namespace clsurf::io::register_map_test
