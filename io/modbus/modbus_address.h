#pragma once
// The address of a Modbus device: "tcp:HOST:PORT" or "rtu:DEVICE,BAUD".

#include <string>

namespace clsurf::io {

struct ModbusAddress {
    std::string text;     ///< as given by the user
    bool serial = false;  ///< RTU
    std::string host;     ///< for TCP: a name, IPv4 or IPv6
    std::string port = "502";
    std::string device;  ///< for RTU: "/dev/ttyUSB0"
    int baud = 0;
    char parity = 'E';  ///< N, E or O
    int stop_bits = 1;
};

/// "tcp:HOST[:PORT]", "tcp:[IPv6]:PORT", "rtu:DEVICE,BAUD[,8E1]". Throws UsageError.
[[nodiscard]] ModbusAddress parse_modbus_address(const std::string& text);

}  // namespace clsurf::io
