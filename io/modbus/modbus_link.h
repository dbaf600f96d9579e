#pragma once
// ModbusLink: the connection to a device. It reads registers with the functions 3 and 4, and has no way to write one.
// Used inside io only.

#include <memory>
#include <span>
#include <string>

#include "io/modbus/modbus_address.h"
#include "io/modbus/register_map.h"

namespace clsurf::io {

/// What became of a request.
enum class ModbusAnswer : std::uint8_t {
    values,
    late,          ///< not there, or not whole, within the timeout
    exception,     ///< the device answers that it does not give these registers now
    damaged,       ///< a wrong checksum or length, or the answer of another request
    disconnected,  ///< the connection broke, or there is none
};

struct ModbusReply {
    ModbusAnswer answer = ModbusAnswer::values;
    int exception = 0;   ///< code of the protocol, 1 … 11
    std::string reason;  ///< "Connection refused"; empty with values
};

class ModbusLink {
public:
    /// `timeout` [s] of an answer and of a connection. Throws UsageError: an address that cannot be one.
    ModbusLink(const ModbusAddress& address, double timeout);
    ModbusLink(const ModbusLink&) = delete;
    ModbusLink& operator=(const ModbusLink&) = delete;
    ~ModbusLink();

    [[nodiscard]] bool connected() const { return connected_; }
    /// Takes up to the timeout. Returns why there is no connection; empty: there is one.
    [[nodiscard]] std::string connect();

    /// Reads the registers of a block into the first of `words`. Takes up to the timeout, and on a serial line as long
    /// again after a lost answer. An answer that comes after its timeout is never taken for a later one over TCP, and
    /// over RTU where it comes within twice the timeout: TCP is connected anew, RTU waits and drops what it gets.
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
