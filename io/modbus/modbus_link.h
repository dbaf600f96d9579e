#pragma once
// ModbusLink: the connection to a device. It reads registers with the functions 3 and 4 and cannot write any.
// Used inside io only.

#include <memory>
#include <span>
#include <string>

#include "io/modbus/modbus_address.h"
#include "io/modbus/register_map.h"

namespace clsurf::io {

/// The result of a request.
enum class ModbusAnswer : std::uint8_t {
    values,
    late,          ///< missing or incomplete within the timeout
    exception,     ///< the device refuses these registers at present
    damaged,       ///< a wrong checksum or length, or the answer to another request
    disconnected,  ///< the connection broke, or there is none
};

struct ModbusReply {
    ModbusAnswer answer = ModbusAnswer::values;
    int exception = 0;   ///< code of the protocol, 1 … 11
    std::string reason;  ///< "Connection refused"; empty with values
};

class ModbusLink {
public:
    /// `timeout` [s]: for an answer and for connecting. Throws UsageError: an invalid address.
    ModbusLink(const ModbusAddress& address, double timeout);
    ModbusLink(const ModbusLink&) = delete;
    ModbusLink& operator=(const ModbusLink&) = delete;
    ~ModbusLink();

    [[nodiscard]] bool connected() const { return connected_; }
    /// Takes up to the timeout. Returns why there is no connection; empty: connected.
    [[nodiscard]] std::string connect();

    /// Reads the registers of a block into the beginning of `words`. Takes up to the timeout; on a serial line after a lost
    /// answer up to twice the timeout. An answer after its timeout is never mistaken for a later one: TCP reconnects; RTU
    /// waits and drops what arrives, which covers answers within twice the timeout.
    [[nodiscard]] ModbusReply read(const RegisterBlock& block, std::span<std::uint16_t> words);

private:
    struct Context;

    void close();
    void recover(ModbusAnswer answer);

    ModbusAddress address_;
    double timeout_;
    std::unique_ptr<Context> context_;
    bool connected_ = false;
};

}  // namespace clsurf::io
