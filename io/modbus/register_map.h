#pragma once
// Maps registers of a Modbus device to channels of a log (docs/howto/record_modbus.md).
//
//     [[channel]]
//     name = "spindle.load"
//     unit = "%"
//     function = "holding"
//     address = 100
//     type = "u16"
//     scale = 0.1

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/place.h"

namespace clsurf::io {

/// The two functions that read registers; values as in the protocol.
enum class RegisterFunction : std::uint8_t { holding = 3, input = 4 };
[[nodiscard]] std::string_view name_of(RegisterFunction function);  ///< "holding"

enum class RegisterType : std::uint8_t { u16, i16, u32, i32, f32 };
[[nodiscard]] std::string_view name_of(RegisterType type);  ///< "u16"

/// The order in which the bytes of a two-register value are transmitted; "a" is the most significant.
enum class ByteOrder : std::uint8_t { abcd, cdab, badc, dcba };
[[nodiscard]] std::string_view name_of(ByteOrder order);  ///< "abcd"

struct RegisterChannel {
    std::string name;
    std::string unit;
    RegisterFunction function = RegisterFunction::holding;
    int address = 0;  ///< address of the first register, from 0, as in the protocol
    RegisterType type = RegisterType::u16;
    ByteOrder order = ByteOrder::abcd;
    double scale = 1.0;
    double bias = 0.0;
    int slave = 1;
    Place where;  ///< in the map

    [[nodiscard]] int registers() const;  ///< 1 or 2
    /// raw · scale + bias.
    [[nodiscard]] double value(std::span<const std::uint16_t> words) const;
};

/// Throws InputError with file and line: unreadable, an unknown key, type or function, a register that does not exist,
/// invalid or duplicate names, and positions, time and lines, which cannot come from Modbus.
[[nodiscard]] std::vector<RegisterChannel> read_register_map(const std::string& path);

/// The most registers in one answer: MODBUS Application Protocol V1.1b3, 6.3.
inline constexpr int most_registers = 125;

/// Adjacent registers of one slave and function, read with one request.
struct RegisterBlock {
    int slave = 1;
    RegisterFunction function = RegisterFunction::holding;
    int address = 0;
    int count = 0;                      ///< ≤ most_registers
    std::vector<std::size_t> channels;  ///< channels in the block
};

/// The requests that read all channels. Registers without a channel are not read: a device may refuse them.
[[nodiscard]] std::vector<RegisterBlock> blocks_of(std::span<const RegisterChannel> channels);

}  // namespace clsurf::io
