#include "io/modbus/modbus_link.h"

#include <modbus/modbus.h>
#include <netdb.h>
#include <sys/socket.h>

#include <array>
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

namespace {

constexpr std::size_t tcp_header = 7;  ///< bytes: number, protocol, length, unit

int word_at(std::span<const std::uint8_t> bytes, std::size_t i) { return bytes[i] << 8 | bytes[i + 1]; }

/// Why an answer over TCP does not match a request, as an errno value of libmodbus; 0: it matches. libmodbus itself accepts
/// the answer of any unit behind a gateway.
int error_of(std::span<const std::uint8_t> answer, const RegisterBlock& block, int function, std::uint16_t number) {
    if (answer.size() < tcp_header + 2 || word_at(answer, 0) != number || word_at(answer, 2) != 0) return EMBBADDATA;
    if (answer[tcp_header - 1] != block.slave) return EMBBADSLAVE;
    if (answer[tcp_header] == (function | 0x80)) return MODBUS_ENOBASE + answer[tcp_header + 1];
    const std::size_t bytes = 2 * static_cast<std::size_t>(block.count);
    const bool whole = answer.size() == tcp_header + 2 + bytes && answer[tcp_header + 1] == bytes;
    return answer[tcp_header] == function && whole ? 0 : EMBBADDATA;
}

/// Reads registers over TCP; −1: failed, with the reason in errno.
int read_over_tcp(modbus_t* modbus, std::uint16_t number, const RegisterBlock& block, std::span<std::uint16_t> words) {
    const int function =
        block.function == RegisterFunction::input ? MODBUS_FC_READ_INPUT_REGISTERS : MODBUS_FC_READ_HOLDING_REGISTERS;
    const auto byte = [](int value) { return static_cast<std::uint8_t>(value & 0xff); };
    // The request is built here because raw requests of libmodbus all have the number 0.
    const std::array<std::uint8_t, 12> request{byte(number >> 8),
                                               byte(number),
                                               0,
                                               0,
                                               0,
                                               6,
                                               byte(block.slave),
                                               byte(function),
                                               byte(block.address >> 8),
                                               byte(block.address),
                                               byte(block.count >> 8),
                                               byte(block.count)};
    const ssize_t sent = ::send(modbus_get_socket(modbus), request.data(), request.size(), MSG_NOSIGNAL);
    if (sent != static_cast<ssize_t>(request.size())) return -1;
    std::array<std::uint8_t, MODBUS_TCP_MAX_ADU_LENGTH> answer{};
    const int length = modbus_receive_confirmation(modbus, answer.data());
    if (length < 0) return -1;
    errno = error_of(std::span(answer).first(static_cast<std::size_t>(length)), block, function, number);
    if (errno != 0) return -1;
    for (std::size_t k = 0; k < static_cast<std::size_t>(block.count); ++k)
        words[k] = static_cast<std::uint16_t>(word_at(answer, tcp_header + 2 + 2 * k));
    return block.count;
}

}  // namespace

struct ModbusLink::Context {
    modbus_t* modbus = nullptr;
    std::uint16_t requests = 0;  ///< sent over TCP: numbers the requests

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
    // The timeout applies to the whole answer, not to each of its bytes.
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
    const int got = address_.serial ? read(context_->modbus, block.address, block.count, words.data())
                                    : read_over_tcp(context_->modbus, ++context_->requests, block, words);
    if (got == block.count) return {};
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
    // Frames on a serial line have no number: what arrives now answers an earlier request.
    std::this_thread::sleep_for(std::chrono::duration<double>(timeout_));
    if (modbus_flush(context_->modbus) < 0) close();
}

}  // namespace clsurf::io
