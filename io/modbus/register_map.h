#pragma once
// Which registers of a Modbus device are which channels of a log (docs/howto/record_modbus.md).
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

/// The two functions that read registers. The numbers are those of the protocol.
enum class RegisterFunction : std::uint8_t { holding = 3, input = 4 };
[[nodiscard]] std::string_view name_of(RegisterFunction function);  ///< "holding"

enum class RegisterType : std::uint8_t { u16, i16, u32, i32, f32 };
[[nodiscard]] std::string_view name_of(RegisterType type);  ///< "u16"

/// How two registers make one value: the order in which its bytes come over the line, "a" the most significant.
enum class ByteOrder : std::uint8_t { abcd, cdab, badc, dcba };
[[nodiscard]] std::string_view name_of(ByteOrder order);  ///< "abcd"

struct RegisterChannel {
    std::string name;
    std::string unit;
    RegisterFunction function = RegisterFunction::holding;
    int address = 0;  ///< of the first register, from 0, as the protocol counts
    RegisterType type = RegisterType::u16;
    ByteOrder order = ByteOrder::abcd;
    double scale = 1.0;
    double bias = 0.0;
    int slave = 1;
    Place where;  ///< in the map

    [[nodiscard]] int registers() const;  ///< 1 or 2
    /// raw · scale + bias of its registers.
    [[nodiscard]] double value(std::span<const std::uint16_t> words) const;
};

/// Throws InputError with file and line: unreadable, an unknown key, type or function, a register that does not exist,
/// names that a log cannot have or that are there twice, positions, time and lines: Modbus is no source of them.
[[nodiscard]] std::vector<RegisterChannel> read_register_map(const std::string& path);

/// That an answer can hold: MODBUS Application Protocol V1.1b3, 6.3.
inline constexpr int most_registers = 125;

/// Registers that are read with one request: adjacent ones of one slave and function.
struct RegisterBlock {
    int slave = 1;
    RegisterFunction function = RegisterFunction::holding;
    int address = 0;
    int count = 0;                      ///< ≤ most_registers
    std::vector<std::size_t> channels;  ///< that lie in it
};

/// The requests that read all channels. Registers that no channel names are not read: a device may refuse them.
[[nodiscard]] std::vector<RegisterBlock> blocks_of(std::span<const RegisterChannel> channels);

}  // namespace clsurf::io
