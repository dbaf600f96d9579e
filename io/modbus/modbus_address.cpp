#include "io/modbus/modbus_address.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include "core/error.h"

namespace clsurf::io {
namespace {

// The rates that libmodbus supports: it silently uses 9600 for any other.
constexpr std::array bauds{300,   600,    1200,   2400,   4800,   9600,   19200,  38400,
                           57600, 115200, 230400, 460800, 500000, 576000, 921600, 1000000};

[[noreturn]] void fail(const std::string& text, const std::string& what) {
    throw UsageError("--modbus: '" + text + "': " + what,
                     "for example tcp:192.168.0.10:502, or rtu:/dev/ttyUSB0,19200,8N1");
}

std::optional<int> whole_number(const std::string& text) {
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

void read_tcp(const std::string& rest, ModbusAddress& address) {
    // An IPv6 address contains colons and is therefore in brackets.
    const std::size_t bracket = rest.starts_with('[') ? rest.find(']') : std::string::npos;
    const std::size_t colon = rest.find(':', bracket == std::string::npos ? 0 : bracket);
    address.host = rest.substr(0, colon);
    if (bracket != std::string::npos) {
        address.host = rest.substr(1, bracket - 1);
        if (std::min(colon, rest.size()) != bracket + 1) fail(address.text, "expected :PORT after ']'");
    }
    if (address.host.empty()) fail(address.text, "no host");
    if (colon == std::string::npos) return;
    address.port = rest.substr(colon + 1);
    const std::optional<int> port = whole_number(address.port);
    if (!port || *port < 1 || *port > 65535) fail(address.text, "a port is a number from 1 to 65535");
}

void read_rtu(const std::string& rest, ModbusAddress& address) {
    const std::size_t comma = rest.find(',');
    address.device = rest.substr(0, comma);
    if (address.device.empty()) fail(address.text, "no device");
    if (comma == std::string::npos) fail(address.text, "no baud rate");
    std::string baud = rest.substr(comma + 1);
    const std::size_t second = baud.find(',');
    const std::string frame = second == std::string::npos ? "8E1" : baud.substr(second + 1);
    baud.resize(std::min(baud.size(), second));
    address.baud = whole_number(baud).value_or(0);
    if (std::find(bauds.begin(), bauds.end(), address.baud) == bauds.end())
        fail(address.text, "'" + baud + "' is not a baud rate of serial lines");
    const bool good = frame.size() == 3 && frame[0] == '8' && std::string("NEO").find(frame[1]) != std::string::npos &&
                      (frame[2] == '1' || frame[2] == '2');
    if (!good) fail(address.text, "'" + frame + "' is not 8N1, 8N2, 8E1 or 8O1");
    address.parity = frame[1];
    address.stop_bits = frame[2] - '0';
}

}  // namespace

ModbusAddress parse_modbus_address(const std::string& text) {
    ModbusAddress address;
    address.text = text;
    address.serial = text.starts_with("rtu:");
    if (address.serial)
        read_rtu(text.substr(4), address);
    else if (text.starts_with("tcp:"))
        read_tcp(text.substr(4), address);
    else
        fail(text, "is neither tcp:HOST:PORT nor rtu:DEVICE,BAUD");
    return address;
}

}  // namespace clsurf::io
