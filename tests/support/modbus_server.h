#pragma once
// A Modbus device for tests: the server of libmodbus in a thread, over loopback TCP at a free port, or over a
// pseudo-terminal. Holding and input register k have the value 1000 + k; holding register 0 has the number of the request.

#include <modbus/modbus.h>
#include <netinet/in.h>
#include <poll.h>
#include <pty.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <thread>

namespace clsurf::test {

/// The reaction of the device to a request.
struct Reaction {
    double delay = 0;     ///< [s]
    int exception = 0;    ///< instead of an answer
    bool silent = false;  ///< no answer
    bool hangs_up = false;
};

inline void pause(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

class ModbusServer {
public:
    using Rule = std::function<Reaction(int request)>;
    enum class Line { tcp, serial };
    static constexpr int registers = 64, slave = 1;

    explicit ModbusServer(
        Line line, Rule rule = [](int) { return Reaction{}; })
        : rule_(std::move(rule)) {
        mapping_ = modbus_mapping_new(0, 0, registers, registers);
        for (int k = 0; k < registers; ++k)
            mapping_->tab_registers[k] = mapping_->tab_input_registers[k] = static_cast<std::uint16_t>(1000 + k);
        if (line == Line::tcp)
            listen_on_loopback();
        else
            open_terminal();
    }
    ModbusServer(const ModbusServer&) = delete;
    ModbusServer& operator=(const ModbusServer&) = delete;
    ~ModbusServer() {
        stop();
        modbus_mapping_free(mapping_);
    }

    /// Serves until stop(). Registers must be set before.
    void start() {
        thread_ = std::thread([this] { listener_ >= 0 ? serve_tcp() : serve_open_line(); });
    }
    /// Closes the connection and stops answering.
    void stop() {
        ends_ = true;
        if (thread_.joinable()) thread_.join();
        if (modbus_ != nullptr) modbus_free(modbus_);
        modbus_ = nullptr;
        for (int* descriptor : {&listener_, &master_, &terminal_}) {
            if (*descriptor >= 0) ::close(*descriptor);
            *descriptor = -1;
        }
    }

    [[nodiscard]] const std::string& address() const { return address_; }
    [[nodiscard]] std::uint16_t* holding() { return mapping_->tab_registers; }
    [[nodiscard]] std::uint16_t* input() { return mapping_->tab_input_registers; }
    [[nodiscard]] int requests() const { return requests_; }
    /// The codes of all requested functions.
    [[nodiscard]] std::set<int> functions() {
        const std::lock_guard lock(mutex_);
        return functions_;
    }

private:
    void listen_on_loopback() {
        modbus_ = modbus_new_tcp("127.0.0.1", 0);
        listener_ = modbus_tcp_listen(modbus_, 8);
        sockaddr_in bound{};
        socklen_t size = sizeof bound;
        ::getsockname(listener_, reinterpret_cast<sockaddr*>(&bound), &size);
        address_ = "tcp:127.0.0.1:" + std::to_string(ntohs(bound.sin_port));
    }
    void open_terminal() {
        char name[128];
        ::openpty(&master_, &terminal_, name, nullptr, nullptr);
        termios raw{};
        ::tcgetattr(terminal_, &raw);
        ::cfmakeraw(&raw);
        ::tcsetattr(terminal_, TCSANOW, &raw);
        address_ = std::string("rtu:") + name + ",19200,8N1";
        modbus_ = modbus_new_rtu(name, 19200, 'N', 8, 1);
        modbus_set_slave(modbus_, slave);
        modbus_set_socket(modbus_, master_);
    }

    /// False: the server ends.
    bool wait_for_input(int descriptor) const {
        while (!ends_) {
            pollfd wanted{descriptor, POLLIN, 0};
            if (::poll(&wanted, 1, 20) > 0) return true;
        }
        return false;
    }
    void serve_tcp() {
        while (wait_for_input(listener_)) {
            if (modbus_tcp_accept(modbus_, &listener_) < 0) continue;
            serve_open_line();
            modbus_close(modbus_);
        }
    }
    void serve_open_line() {
        std::uint8_t query[MODBUS_TCP_MAX_ADU_LENGTH];
        while (wait_for_input(modbus_get_socket(modbus_))) {
            const int size = modbus_receive(modbus_, query);
            if (size < 0 && listener_ >= 0) return;
            if (size > 0 && !answer(query, size)) return;
        }
    }
    /// False: the connection is closed.
    bool answer(const std::uint8_t* query, int size) {
        {
            const std::lock_guard lock(mutex_);
            functions_.insert(query[modbus_get_header_length(modbus_)]);
        }
        const int request = ++requests_;
        mapping_->tab_registers[0] = static_cast<std::uint16_t>(request);
        const Reaction reaction = rule_(request);
        if (reaction.delay > 0) pause(reaction.delay);
        if (reaction.hangs_up) return false;
        if (reaction.silent) return true;
        if (reaction.exception != 0)
            modbus_reply_exception(modbus_, query, static_cast<unsigned>(reaction.exception));
        else
            modbus_reply(modbus_, query, size, mapping_);
        return true;
    }

    Rule rule_;
    modbus_t* modbus_ = nullptr;
    modbus_mapping_t* mapping_ = nullptr;
    std::string address_;
    int listener_ = -1, master_ = -1, terminal_ = -1;
    std::thread thread_;
    std::atomic<bool> ends_{false};
    std::atomic<int> requests_{0};
    std::mutex mutex_;
    std::set<int> functions_;
};

}  // namespace clsurf::test
