#include "io/modbus/modbus_link.h"

#include <modbus/modbus.h>
#include <netdb.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <thread>

#include "core/error.h"

namespace clsurf::io {
namespace {

/// Empty: the host has an address.
std::string why_unknown(const ModbusAddress& address) {
    addrinfo hints{};
    hints.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    const int error = ::getaddrinfo(address.host.c_str(), address.port.c_str(), &hints, &found);
    if (found != nullptr) ::freeaddrinfo(found);
    return error == 0 ? "" : ::gai_strerror(error);
}

ModbusAnswer answer_of(int error) {
    switch (error) {
        case ETIMEDOUT: return ModbusAnswer::late;
        case EMBBADCRC:
        case EMBBADDATA:
        case EMBBADEXC:
        case EMBUNKEXC:
        case EMBMDATA:
        case EMBBADSLAVE: return ModbusAnswer::damaged;
        default: break;
    }
    if (error > MODBUS_ENOBASE && error < MODBUS_ENOBASE + MODBUS_EXCEPTION_MAX) return ModbusAnswer::exception;
    return ModbusAnswer::disconnected;
}

}  // namespace

struct ModbusLink::Context {
    modbus_t* modbus = nullptr;

    Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;
    ~Context() { modbus_free(modbus); }
};

ModbusLink::ModbusLink(const ModbusAddress& address, double timeout)
    : address_(address), timeout_(timeout), context_(std::make_unique<Context>()) {
    modbus_t*& modbus = context_->modbus;
    modbus = address.serial ? modbus_new_rtu(address.device.c_str(), address.baud, address.parity, 8, address.stop_bits)
                            : modbus_new_tcp_pi(address.host.c_str(), address.port.c_str());
    if (modbus == nullptr) throw UsageError("--modbus: '" + address.text + "': " + modbus_strerror(errno));
    double seconds = 0;
    const double fraction = std::modf(timeout, &seconds);
    modbus_set_response_timeout(modbus, static_cast<std::uint32_t>(seconds),
                                static_cast<std::uint32_t>(fraction * 1e6));
    // The timeout is of the whole answer, not of each of its bytes.
    modbus_set_byte_timeout(modbus, 0, 0);
}

ModbusLink::~ModbusLink() { close(); }

void ModbusLink::close() {
    if (connected_) modbus_close(context_->modbus);
    connected_ = false;
}

std::string ModbusLink::connect() {
    if (connected_) return {};
    if (!address_.serial) {
        if (std::string unknown = why_unknown(address_); !unknown.empty()) return unknown;
    }
    if (modbus_connect(context_->modbus) != 0) return modbus_strerror(errno);
    connected_ = true;
    return {};
}

ModbusReply ModbusLink::read(const RegisterBlock& block, std::span<std::uint16_t> words) {
    if (!connected_) return {ModbusAnswer::disconnected, 0, "no connection"};
    modbus_set_slave(context_->modbus, block.slave);
    const auto read = block.function == RegisterFunction::input ? modbus_read_input_registers : modbus_read_registers;
    if (read(context_->modbus, block.address, block.count, words.data()) == block.count) return {};
    const int error = errno;
    const ModbusAnswer answer = answer_of(error);
    recover(answer);
    return {answer, answer == ModbusAnswer::exception ? error - MODBUS_ENOBASE : 0, modbus_strerror(error)};
}

void ModbusLink::recover(ModbusAnswer answer) {
    if (answer == ModbusAnswer::exception) return;
    if (!address_.serial || answer == ModbusAnswer::disconnected) {
        close();
        return;
    }
    // Frames of a serial line have no number. What comes now was asked for before.
    std::this_thread::sleep_for(std::chrono::duration<double>(timeout_));
    if (modbus_flush(context_->modbus) < 0) close();
}

}  // namespace clsurf::io
